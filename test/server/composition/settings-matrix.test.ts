/**
 * Every way in draws with the settings of its plotter: model and heights, judged by the commands that reach the board. A
 * caller's settings are laid over them field by field.
 */
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { PlotwrightServer } from "../../../server/index.js";
import { machineById } from "../../../src/index.js";
import type { EbbController } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, type GivenSettings, type Job } from "../../../src/schema/index.js";
import { cli } from "../../support/processes/command-line.js";
import { IS_FULL } from "../../support/runs/full-run.js";
import { introduce, send, SharedDatabase, stateOf } from "../../support/servers/shared-servers.js";

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

/** How long each move in a log takes, in ticks of the board. */
const timesIn = (log: string): string[] => [...log.matchAll(/> LT,(\d+)/g)].map(([, ticks]) => ticks);

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

  const log = async (plotter: string): Promise<string> =>
    (await send(server.url, "GET", `/plotters/${plotter}/log`)).text();
  /** What `act` sends to the board. Other heights come before, so that all heights are sent again. */
  async function logOf(act: () => Promise<unknown>, plotter = "main"): Promise<string> {
    const settings = { pen: { upPct: 99, downPct: 1 } };
    const spoilt = await send(server.url, "POST", `/plotters/${plotter}/cycle-pen`, { settings });
    expect(await spoilt.text()).toContain('"idle"');
    const before = (await log(plotter)).length;
    await act();
    return (await log(plotter)).slice(before);
  }
  const sentBy = async (act: () => Promise<unknown>, plotter?: string): Promise<string[]> =>
    servoLinesIn(await logOf(act, plotter));

  async function jobOf(answer: Response | Promise<Response>, status = 201): Promise<Job> {
    const response = await answer;
    const text = await response.text();
    expect([response.status, text]).toEqual([status, expect.any(String)]);
    return JSON.parse(text) as Job;
  }
  const newJob = (body: object = {}): Promise<Job> =>
    jobOf(send(server.url, "POST", "/jobs", { name: "j.svg", drawing: SVG, ...body }));
  const plotted = async (answer: Promise<Response>): Promise<void> => plot((await jobOf(answer)).id);
  const becomes = (id: string, wanted: object): Promise<void> =>
    expect
      .poll(async () => (await stateOf(server)).jobs.find((job) => job.id === id), { timeout: PATIENCE_MS })
      .toMatchObject(wanted);
  async function plot(id: string, warnings: unknown[] = []): Promise<void> {
    await jobOf(send(server.url, "POST", `/jobs/${id}/start`), 200);
    await becomes(id, { state: "done", warnings });
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
  const added = (...options: string[]): Promise<void> => addedAs(SVG, ...options);
  const addedAs = async (svg: string, ...options: string[]): Promise<void> => {
    const file = join(dataDir, "a.svg");
    writeFileSync(file, svg);
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
        ["move-to", { xMm: 30, yMm: 30 }],
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
    "plots on the model that it has when a job starts, with the heights that it had when the job was added",
    async () => {
      const other = model === "nextdraw-8511" ? "axidraw-v3" : "nextdraw-8511";
      const setModel = async (machine: string): Promise<void> =>
        expect((await send(server.url, "PATCH", "/plotters/main", { machine })).status).toBe(200);
      const { id } = await newJob();
      await setModel(other);
      try {
        const sent = await sentBy(() => plot(id, [expect.stringContaining(machineById(other).name)]));
        expect(sent.sort()).toEqual(servoLines(other, heights).sort());
      } finally {
        await setModel(model);
      }
    },
    LIMIT_MS,
  );

  it(
    "gives a job from another plotter its own model and heights, but not those that the job was given",
    async () => {
      const added = await send(server.url, "POST", "/plotters", {
        name: `${name} 2`,
        device: "virtual",
        machine: "nextdraw-2234",
      });
      const { id: second } = (await added.json()) as { id: string };
      const pen = { ...DEFAULT_PLOT_SETTINGS.pen, upPct: 66, downPct: 33 };
      await send(server.url, "PUT", `/plotters/${second}/settings`, { pen, pens: [], presets: [] });
      for (const [given, wanted] of [
        [{}, pen],
        [{ pen: { downPct: 25 } }, { ...pen, downPct: 25 }],
      ] as const) {
        const { id } = await newJob({ settings: given });
        const expected = servoLines("nextdraw-2234", wanted).sort();
        const sent = await sentBy(async () => {
          await jobOf(send(server.url, "PATCH", `/jobs/${id}`, { plotterId: second }), 200);
          const warnings = [expect.stringContaining("NextDraw 2234")];
          await plot(id, warnings);
        }, second);
        expect(sent.sort()).toEqual(expected);
      }
      expect((await send(server.url, "DELETE", `/plotters/${second}`)).status).toBe(200);
    },
    LIMIT_MS,
  );

  it(
    "changes one height of a running plot, and keeps the other",
    async () => {
      // It waits with the pen up until it is resumed.
      const { id } = await newJob({ from: { strokeIndex: 0, alongMm: 0 } });
      const sent = await sentBy(async () => {
        await jobOf(send(server.url, "POST", `/jobs/${id}/start`), 200);
        await becomes(id, { state: "paused" });
        const change = { pen: { downPct: 25 } };
        const changed = await jobOf(send(server.url, "POST", `/jobs/${id}/change`, change), 200);
        expect(changed.settings.pen).toMatchObject({ ...heights, downPct: 25 });
        await jobOf(send(server.url, "POST", `/jobs/${id}/resume`), 200);
        await becomes(id, { state: "done" });
      });
      const [up, down] = servoLines(model, { ...heights, downPct: 25 });
      expect(sent).toEqual(expect.arrayContaining([up, down]));
      const [, before] = servoLines(model, heights);
      // At most the old height was set at the beginning, and the new one came last.
      expect([up, down, before]).toEqual(expect.arrayContaining(sent));
      expect(sent.indexOf(before)).toBeLessThan(sent.indexOf(down));
    },
    LIMIT_MS,
  );

  it(
    "draws a layer with the pen that --pen names: its line is shifted by the pen's offset",
    async () => {
      const red = { id: "r", name: "Red", color: null, widthMm: 0.5, offsetXMm: 10, offsetYMm: 0 };
      const own = { pen: { ...DEFAULT_PLOT_SETTINGS.pen, ...heights }, pens: [red], presets: [] };
      expect((await send(server.url, "PUT", "/plotters/main/settings", own)).status).toBe(200);
      const drawing = SVG.replace("<path", '<g id="sky"><path').replace("</svg>", "</g></svg>");
      const timesOf = async (svg: string, ...options: string[]): Promise<string[]> =>
        timesIn(await logOf(() => addedAs(svg, ...options)));
      const shifted = await timesOf(drawing, "--pen", "sky=Red");
      expect(shifted.length).toBeGreaterThan(3);
      // From home to the line, along it, and back: no other way takes as long.
      expect(shifted).toEqual(await timesOf(drawing.replace("M60", "M50")));
      expect(shifted).not.toEqual(await timesOf(drawing));
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
      const far = { paper: { widthMm: 900, heightMm: 900 }, layout: { xMm: 800, yMm: 800 } };
      for (const settings of [other, { machine: model, customMachine: own }]) {
        const body = { name: "far", drawing: SVG, settings: { ...settings, prepare: far } };
        const refusal = await send(server.url, "POST", "/jobs", body);
        expect([refusal.status, await refusal.text()]).toEqual([
          422,
          expect.stringContaining("out-of-bounds"),
        ]);
        const move = await send(server.url, "POST", "/plotters/main/move-to", {
          xMm: 800,
          yMm: 800,
          settings,
        });
        expect([move.status, await move.text()]).toEqual([
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

describe("a drawing of the shared queue", () => {
  it(
    "keeps its true size, and is refused if it leaves the paper, until the sender chooses",
    async () => {
      const dataDir = mkdtempSync(join(tmpdir(), "plotwright-matrix-"));
      const server = await database.serve(dataDir, { virtualSpeed: 200 });
      await introduce(server, "paper");
      const share = async (job: string, drawing: string, settings?: GivenSettings): Promise<void> => {
        const body = { name: job, drawing, settings, target: { plotter: "paper" } };
        expect((await send(server.url, "POST", "/shared-jobs", body)).status).toBe(201);
      };
      const jobNamed = async (job: string): Promise<Job | undefined> =>
        (await stateOf(server)).jobs.find(({ name }) => name === job);
      try {
        await share("true", SVG.replaceAll("297", "100").replaceAll("210", "80"));
        await expect
          .poll(() => jobNamed("true"), { timeout: PATIENCE_MS })
          .toMatchObject({ stats: { size: { widthMm: 9, scaleX: 1, scaleY: 1 } } });
        await send(server.url, "DELETE", `/jobs/${(await jobNamed("true"))!.id}`);
        const wide = SVG.replace("M60 60h9", "M10 20H330");
        await share("wide", wide);
        const notices = async (): Promise<string> => JSON.stringify((await stateOf(server)).serverNotices);
        await expect.poll(notices, { timeout: PATIENCE_MS }).toMatch(/33 mm over its right edge/);
        expect(await jobNamed("wide")).toBeUndefined();
        await share("cut", wide, { prepare: { outside: "cut" } });
        await expect
          .poll(() => jobNamed("cut"), { timeout: PATIENCE_MS })
          .toMatchObject({ stats: { size: { widthMm: 287.5, scaleX: 1 } } });
      } finally {
        await server.close();
        rmSync(dataDir, { recursive: true, force: true });
      }
    },
    LIMIT_MS,
  );
});

describe("a plotter whose model is not set", () => {
  it(
    "is the default model for every job, whatever machine the job names, and says how to set it",
    async () => {
      const dataDir = mkdtempSync(join(tmpdir(), "plotwright-matrix-"));
      const server = await database.serve(dataDir, { virtualSpeed: 200 });
      await introduce(server, "unset");
      const post = (path: string, body: object): Promise<Response> => send(server.url, "POST", path, body);
      const other = { machine: "nextdraw-8511" };
      const job = { name: "unset.svg", drawing: SVG, settings: other };
      try {
        await post("/jobs", job);
        await post("/shared-jobs", { ...job, target: { plotter: "unset" } });
        const jobs = async (): Promise<Job[]> => (await stateOf(server)).jobs;
        const { id } = (await jobs())[0];
        await post(`/jobs/${id}/start`, {});
        // The plot of the first makes room for the shared one.
        await expect.poll(async () => (await jobs()).length, { timeout: PATIENCE_MS }).toBe(2);
        const shared = (await jobs()).find((one) => one.id !== id)!;
        await post(`/jobs/${shared.id}/start`, {});
        const states = async (): Promise<string[]> => (await jobs()).map(({ state }) => state);
        await expect.poll(states, { timeout: PATIENCE_MS }).toEqual(["done", "done"]);
        for (const { settings, warnings } of await jobs()) {
          expect([settings.machine, warnings]).toEqual([
            "axidraw-v3",
            [expect.stringMatching(/^Its settings are for the NextDraw 8511\..*model is not set\. Choose/)],
          ]);
        }
        const log = await (await send(server.url, "GET", "/plotters/main/log")).text();
        expect(servoLinesIn(log).sort()).toEqual(servoLines("axidraw-v3", USUAL).sort());
        const far = { paper: { widthMm: 850, heightMm: 590 }, layout: { xMm: 500, yMm: 300 } };
        const refusal = await post("/jobs", { ...job, settings: { machine: "nextdraw-2234", prepare: far } });
        expect([refusal.status, await refusal.text()]).toEqual([422, expect.stringContaining("AxiDraw V3")]);
        expect((await post("/plotters/main/move-to", { xMm: 500, yMm: 30, settings: other })).status).toBe(
          422,
        );
      } finally {
        await server.close();
        rmSync(dataDir, { recursive: true, force: true });
      }
    },
    LIMIT_MS,
  );
});
