/**
 * Every way in draws with the settings of its plotter: model and heights, judged by the commands that reach the board. A
 * caller's settings are laid over them field by field.
 */
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { PlotwrightServer } from "../../server/index.js";
import { machineById } from "../../src/index.js";
import type { EbbController } from "../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, type GivenSettings, type Job } from "../../src/schema/index.js";
import { cli } from "../cli/support.js";
import { IS_FULL } from "../support/full-run.js";
import { introduce, send, SharedDatabase, stateOf } from "./support/shared-servers.js";

const LIMIT_MS = 180_000;
const PATIENCE_MS = 60_000;
/** One stroke, far enough from home that the pen lifts to its full height. */
const SVG =
  '<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 297 210"><path d="M60 60h9" stroke="black"/></svg>';

interface Heights {
  readonly upPct: number;
  readonly downPct: number;
}
const USUAL: Heights = { upPct: DEFAULT_PLOT_SETTINGS.pen.upPct, downPct: DEFAULT_PLOT_SETTINGS.pen.downPct };
const STORED: Heights = { upPct: 71, downPct: 44 };

/** The last one is a model with motors of its own for each axis. */
const MODELS = ["axidraw-v3", "nextdraw-8511", "watercolorbot"] as const;
const ALL = MODELS.flatMap((model) => [[model, USUAL] as const, [model, STORED] as const]);
const CASES = IS_FULL ? ALL : ALL.filter((_, i) => i === 0 || i === 3);

/** The servo commands for these heights, in the board's numbers. */
function servoLines(model: string, { upPct, downPct }: Heights): string[] {
  const { servoPosAt0Pct, servoPosAt100Pct, servoPin } = machineById(model).controller as EbbController;
  const pos = (pct: number): number =>
    Math.round(servoPosAt0Pct + ((servoPosAt100Pct - servoPosAt0Pct) * pct) / 100);
  return servoPin === 4
    ? [`SC,4,${pos(upPct)}`, `SC,5,${pos(downPct)}`]
    : [`S2,${pos(upPct)},5`, `S2,${pos(downPct)},5`];
}

/** The different servo commands in a log. */
const servoLinesIn = (log: string): string[] => [
  ...new Set([...log.matchAll(/\b(SC,[45],\d+|S2,\d+,\d+)/g)].map(([line]) => line)),
];

let database: SharedDatabase;
beforeAll(async () => {
  database = await SharedDatabase.open();
}, LIMIT_MS);
afterAll(() => database.close());

describe.each(CASES)("a plotter that is a %s with heights %o", (model, heights) => {
  let dataDir: string;
  let server: PlotwrightServer;
  const watchDir = (): string => join(dataDir, "watched");
  /** For the shared queue, which all cases use. */
  const name = `${model} ${heights.upPct}`;

  beforeAll(async () => {
    dataDir = mkdtempSync(join(tmpdir(), "plotwright-matrix-"));
    mkdirSync(watchDir());
    server = await database.serve(dataDir, { virtualSpeed: 200, watchDir: watchDir() });
    await introduce(server, name, model);
    if (heights === USUAL) return;
    const own = { pen: { ...DEFAULT_PLOT_SETTINGS.pen, ...heights }, pens: [], presets: [] };
    expect((await send(server.url, "PUT", "/plotters/main/settings", own)).status).toBe(200);
  }, LIMIT_MS);
  afterAll(async () => {
    await server.close();
    rmSync(dataDir, { recursive: true, force: true });
  }, LIMIT_MS);

  const log = async (): Promise<string> => (await send(server.url, "GET", "/plotters/main/log")).text();
  /** The servo commands of what `act` does. Other heights come before, so that all heights are sent again. */
  async function sentBy(act: () => Promise<unknown>): Promise<string[]> {
    const settings = { pen: { upPct: 99, downPct: 1 } };
    const spoilt = await send(server.url, "POST", "/plotters/main/cycle-pen", { settings });
    expect(await spoilt.text()).toContain('"idle"');
    const before = (await log()).length;
    await act();
    return servoLinesIn((await log()).slice(before));
  }

  async function plotted(answer: Response | Promise<Response>): Promise<void> {
    const added = await answer;
    const text = await added.text();
    expect([added.status, text]).toEqual([201, expect.any(String)]);
    await plot((JSON.parse(text) as Job).id);
  }
  async function plot(id: string): Promise<void> {
    expect((await send(server.url, "POST", `/jobs/${id}/start`)).status).toBe(200);
    const stateOfJob = async (): Promise<Job | undefined> =>
      (await stateOf(server)).jobs.find((job) => job.id === id);
    await expect.poll(stateOfJob, { timeout: PATIENCE_MS }).toMatchObject({ state: "done", warnings: [] });
  }
  const queued = async (wanted: string): Promise<string> => {
    const find = async (): Promise<string | undefined> =>
      (await stateOf(server)).jobs.find((job) => job.name === wanted)?.id;
    await expect.poll(find, { timeout: PATIENCE_MS }).toBeDefined();
    return (await find())!;
  };

  const json = (settings?: GivenSettings): Promise<void> =>
    plotted(send(server.url, "POST", "/jobs", { name: "j.svg", drawing: SVG, settings }));
  const raw = (settings?: GivenSettings): Promise<void> => {
    const query = settings === undefined ? "" : `&settings=${encodeURIComponent(JSON.stringify(settings))}`;
    return plotted(fetch(`${server.url}/api/v1/jobs?name=r.svg${query}`, { method: "POST", body: SVG }));
  };
  const added = async (...options: string[]): Promise<void> => {
    const file = join(dataDir, "a.svg");
    writeFileSync(file, SVG);
    const { code, out, err } = await cli("add", file, "--url", server.url, ...options);
    expect([code, err]).toEqual([0, expect.not.stringContaining("note:")]);
    await plot(out.split("\t")[0]);
  };
  const watched = async (file: string, settings?: GivenSettings): Promise<void> => {
    if (settings) writeFileSync(join(watchDir(), `${file}.settings.json`), JSON.stringify(settings));
    writeFileSync(join(watchDir(), `${file}.svg`), SVG.replace("M60", file === "w" ? "M61" : "M62"));
    await plot(await queued(`${file}.svg`));
  };
  const shared = async (job: string, settings?: GivenSettings): Promise<void> => {
    const target = { plotter: name };
    const body = { name: job, drawing: SVG, settings, target };
    expect((await send(server.url, "POST", "/shared-jobs", body)).status).toBe(201);
    await plot(await queued(job));
  };
  const byHand = async (move: string, body: object = {}): Promise<void> => {
    const answer = await send(server.url, "POST", `/plotters/main/${move}`, body);
    expect([answer.status, await answer.text()]).toEqual([200, expect.any(String)]);
  };
  const penBoth = async (settings?: GivenSettings): Promise<void> => {
    await byHand("pen", { up: false, settings });
    await byHand("pen", { up: true, settings });
  };

  it(
    "draws with these, whatever the way in",
    async () => {
      const expected = servoLines(model, heights).sort();
      for (const [way, act] of [
        ["API", json],
        ["API with other settings", () => json({ motion: { draw: { speedMmPerS: 33 } } })],
        ["raw", raw],
        ["raw with other settings", () => raw({ prepare: { marginMm: 20 } })],
        ["add", added],
        ["add with other settings", () => added("--speed", "33")],
        ["watched folder", () => watched("w")],
        ["shared queue", () => shared("s")],
        ["pen", penBoth],
        ["cycle-pen", () => byHand("cycle-pen")],
        ["test line", () => byHand("test-line")],
      ] as const) {
        expect([way, ...(await sentBy(act)).sort()]).toEqual([way, ...expected]);
      }
      // Moves with the pen up.
      for (const [move, body] of [
        ["walk", { xMm: 30, yMm: 30 }],
        ["jog", { dxMm: 5, dyMm: 5 }],
        ["home", {}],
      ] as const) {
        const lines = await sentBy(() => byHand(move, body));
        expect([move, expected]).toEqual([move, expect.arrayContaining(lines)]);
      }
    },
    LIMIT_MS,
  );

  it(
    "keeps the plotter's up height where a caller gives only the down height",
    async () => {
      const given = { pen: { downPct: 25 } };
      const expected = servoLines(model, { ...heights, downPct: 25 }).sort();
      for (const [way, act] of [
        ["API", () => json(given)],
        ["raw", () => raw(given)],
        ["add", () => added("--pen-down", "25")],
        ["watched folder", () => watched("x", given)],
        ["shared queue", () => shared("t", given)],
        ["pen", () => penBoth(given)],
        ["cycle-pen", () => byHand("cycle-pen", { settings: given })],
      ] as const) {
        expect([way, ...(await sentBy(act)).sort()]).toEqual([way, ...expected]);
      }
    },
    LIMIT_MS,
  );

  it(
    "stays that model for a job of another one, says so, and does not leave its own reach",
    async () => {
      const huge = { ...machineById("nextdraw-2234"), id: "huge", widthMm: 3_000, heightMm: 3_000 };
      const other = { machine: "huge", customMachine: huge };
      const answer = await send(server.url, "POST", "/jobs", { name: "o", drawing: SVG, settings: other });
      const job = (await answer.json()) as Job;
      expect([job.settings.machine, job.warnings]).toEqual([model, [expect.stringContaining(huge.name)]]);
      // A plotter with a job takes none from the shared queue.
      await send(server.url, "DELETE", `/jobs/${job.id}`);
      const own = { ...huge, id: model };
      const far = { paper: { widthMm: 900, heightMm: 900 }, place: { xMm: 800, yMm: 800 } };
      for (const settings of [other, { machine: model, customMachine: own }]) {
        const body = { name: "far", drawing: SVG, settings: { ...settings, prepare: far } };
        const refusal = await send(server.url, "POST", "/jobs", body);
        expect([refusal.status, await refusal.text()]).toEqual([
          422,
          expect.stringContaining("out-of-bounds"),
        ]);
        const walk = await send(server.url, "POST", "/plotters/main/walk", { xMm: 800, yMm: 800, settings });
        expect([walk.status, await walk.text()]).toEqual([
          422,
          expect.stringContaining(machineById(model).name),
        ]);
      }
      const target = { plotter: name };
      const peers = { name: "peer", drawing: SVG, target, settings: { ...other, prepare: far } };
      await send(server.url, "POST", "/shared-jobs", peers);
      const notices = async (): Promise<string> => JSON.stringify((await stateOf(server)).serverNotices);
      await expect.poll(notices, { timeout: PATIENCE_MS }).toContain("can only go");
    },
    LIMIT_MS,
  );
});
