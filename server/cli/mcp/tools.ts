/** What an assistant can do, as tools of the Model Context Protocol. Everything on a plotter goes through a running server. */
import { McpServer } from "@modelcontextprotocol/sdk/server/mcp.js";
import type { CallToolResult } from "@modelcontextprotocol/sdk/types.js";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join, resolve } from "node:path";
import { z } from "zod";
import { serverClient, type ServerAccess } from "../../../host/handle/server-client.js";
import { parseWith } from "../../../host/parse-with.js";
import { settingsOfPlotter, settingsWith } from "../../../host/plotter/settings-of-plotter.js";
import { PlotwrightError } from "../../../src/index.js";
import {
  ENDED_STATES,
  givenSettingsSchema,
  OPERATIONS,
  type Job,
  type PlotSettings,
} from "../../../src/schema/index.js";
import { readBytes } from "../../planning/read-drawing.js";
import { machinesOf, plotterOf, storedOf } from "../client/served-plotter.js";
import { addJob, serverState, type ServerState } from "../client/server-client.js";
import type { PlanReport } from "../plan/plan.js";
import { runPlanInThread } from "../plan/plan-thread.js";
import { NOTHING_STORED } from "../stored-plotter.js";
import { pictureOf, type StrokesOnPaper } from "./picture.js";

/** Ended jobs that `state` shows. */
const ENDED_COUNT = 5;
/** As `plotwright plan` has by default. */
const FIRMWARE = "3.0.3";

const DRAWING = {
  file: z.string().optional().describe("path of the drawing on this computer: SVG, DXF, HPGL or JSON"),
  text: z.string().min(1).optional().describe("the drawing itself, instead of a file: usually SVG text"),
  name: z.string().max(200).optional().describe("name of a drawing given as text, such as fern.svg"),
  settings: z
    .looseObject({})
    .optional()
    .describe(
      'any part of a job\'s settings, laid over the plotter\'s, such as {"prepare":{"paper":{"widthMm":148,"heightMm":210},"hatch":{"spacingMm":0.5}},"pen":{"downPct":25},"motion":{"draw":{"speedMmPerS":40}}}',
    ),
  plotter: z.string().optional().describe("name or id of the plotter; default: the first one"),
};
type GivenDrawing = z.infer<z.ZodObject<typeof DRAWING>>;

const JOB = { id: z.string().describe("the job's id, from `state` or `queue`") };

/** The tools that act on a job are rows of the table of operations; whether they move the plotter is said here. */
const JOB_TOOLS = {
  start: "The plotter begins to draw: ask the user first whether pen and paper are ready.",
  pause: "The job can be resumed.",
  resume: "The plotter continues to draw.",
  cancel: "What is drawn stays on the paper.",
} as const;

export function mcpServer(access: () => ServerAccess, version: string): McpServer {
  const server = new McpServer({ name: "plotwright", title: "plotwright, pen plotter", version });
  const reads = { readOnlyHint: true, openWorldHint: false } as const;

  server.registerTool(
    "state",
    {
      description: "Shows the plotters, the jobs in the queue and the last ended jobs",
      annotations: reads,
    },
    async () => said(shownState(await serverState(access()))),
  );
  server.registerTool(
    "plan",
    {
      description:
        "Plans a drawing without plotting it: size on the paper, duration, lengths, layers, and warnings about what is not drawn. Lengths are in mm, times in s. Works without a server.",
      inputSchema: DRAWING,
      annotations: reads,
    },
    async (given) => {
      const { report, note } = await planned(given, access());
      return said({ ...report, ...(note === null ? {} : { note }) });
    },
  );
  server.registerTool(
    "preview",
    {
      description:
        "Makes a picture of what would be on the paper: fitted, clipped and hatched as it would be plotted. Works without a server.",
      inputSchema: DRAWING,
      annotations: reads,
    },
    async (given) => {
      const { report, strokes } = await planned(given, access());
      const { size, paper, strokes: strokeCount, durationS, warnings } = report;
      const { content } = said({ size, paper, strokeCount, durationS, warnings });
      const data = pictureOf(strokes).toString("base64");
      return { content: [{ type: "image", mimeType: "image/png", data }, ...content] };
    },
  );
  server.registerTool(
    "queue",
    {
      description: "Adds a drawing to the queue as a job, without starting it",
      inputSchema: { ...DRAWING, copies: z.int().min(1).max(100).optional() },
      annotations: { readOnlyHint: false, destructiveHint: false, openWorldHint: false },
    },
    ({ copies, ...given }) =>
      withDrawing(given, async (path) => {
        const state = await serverState(access());
        const settings = parseWith(givenSettingsSchema, given.settings ?? {});
        const name = given.text === undefined ? basename(path) : (given.name ?? "drawing.svg");
        const plotterId = plotterOf(state.plotters, given.plotter)?.id;
        const job = { name, settings, ...(plotterId === undefined ? {} : { plotterId }) };
        const added = await addJob(
          access(),
          { ...job, ...(copies === undefined ? {} : { copies }) },
          readBytes(path),
        );
        return said({ ...shownJob(added), stats: added.stats });
      }),
  );
  for (const [name, more] of Object.entries(JOB_TOOLS)) {
    const action = name as keyof typeof JOB_TOOLS;
    server.registerTool(
      name,
      {
        description: `${OPERATIONS.jobs[action].about}. ${more}`,
        inputSchema: JOB,
        annotations: { readOnlyHint: false, destructiveHint: action !== "pause", openWorldHint: false },
      },
      async ({ id }) => said(shownJob(await serverClient(access()).jobs[action](id))),
    );
  }
  return server;
}

const said = (value: unknown): CallToolResult => ({
  content: [{ type: "text", text: JSON.stringify(value, null, 1) }],
});

function shownState({ plotters, jobs }: ServerState): object {
  const isEnded = ({ state }: Job): boolean => ENDED_STATES.includes(state);
  const shown = [
    ...jobs.filter((job) => !isEnded(job)),
    ...jobs.filter((job) => isEnded(job)).slice(0, ENDED_COUNT),
  ];
  return { plotters, jobs: shown.map(shownJob) };
}

/** Without the settings, which are long. */
const shownJob = (job: Job): object => ({
  id: job.id,
  name: job.name,
  plotterId: job.plotterId,
  state: job.state,
  progress: job.progress,
  remainingS: job.remainingS ?? job.expectedS,
  message: job.message,
  wait: job.wait,
  warnings: job.warnings,
});

interface PlanOfDrawing {
  readonly report: PlanReport;
  readonly strokes: StrokesOnPaper;
  /** That the settings named another machine than the plotter's. */
  readonly note: string | null;
}

/** As the server would plan it, in a thread with the same limits. */
const planned = (given: GivenDrawing, access: ServerAccess): Promise<PlanOfDrawing> =>
  withDrawing(given, async (file) => {
    const { settings, note } = await settingsFor(given, access);
    return inFolder(async (folder) => {
      const strokes = join(folder, "strokes.json");
      const options = { json: true, strokes, firmware: FIRMWARE, copies: 1 };
      let text = "";
      await runPlanInThread(
        { file, settings, options },
        { out: (part) => (text += part), err: () => undefined },
      );
      return {
        report: JSON.parse(text) as PlanReport,
        strokes: JSON.parse(readFileSync(strokes, "utf8")) as StrokesOnPaper,
        note,
      };
    });
  });

async function settingsFor(
  { settings = {}, plotter: wanted }: GivenDrawing,
  access: ServerAccess,
): Promise<{ readonly settings: PlotSettings; readonly note: string | null }> {
  const state = await serverState(access).catch((error: unknown) => {
    if (wanted === undefined && error instanceof PlotwrightError && error.code === "disconnected")
      return null;
    throw error;
  });
  const given = parseWith(givenSettingsSchema, settings);
  const plotter = state === null ? undefined : plotterOf(state.plotters, wanted);
  const withMachine = state === null ? (same: PlotSettings) => same : machinesOf(state);
  const stored =
    state === null ? { ...NOTHING_STORED, machine: given.machine ?? null } : storedOf(state, plotter);
  return settingsWith(settingsOfPlotter(stored, withMachine), given, withMachine);
}

/** The drawing as a file. */
function withDrawing<T>({ file, text, name }: GivenDrawing, use: (path: string) => Promise<T>): Promise<T> {
  if ((file === undefined) === (text === undefined)) {
    throw new PlotwrightError("bad-setting", "Give either the path of a drawing as `file`, or its `text`.");
  }
  if (file !== undefined) return use(resolve(file));
  return inFolder((folder) => {
    const path = join(folder, basename(name ?? "drawing.svg"));
    writeFileSync(path, text ?? "");
    return use(path);
  });
}

async function inFolder<T>(use: (folder: string) => Promise<T>): Promise<T> {
  const folder = mkdtempSync(join(tmpdir(), "plotwright-mcp-"));
  try {
    return await use(folder);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
