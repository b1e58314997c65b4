/**
 * The command line and a server on virtual Grbls in other processes, over real pseudo-terminals: what is drawn, also when
 * the plotting process is killed or the cable pulled. How long it takes is measured on a virtual clock
 * (grbl-samples.test.ts), because this computer may be busy. In the full run all samples on all Grbls.
 */
import { fork } from "node:child_process";
import { once } from "node:events";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";
import type { JournalEntry } from "../../host/plotter/plotter-port.js";
import type { VirtualGrblOptions } from "../../src/drivers/grbl/virtual/virtual-settings.js";
import { toJson } from "../../src/internal.js";
import { compareDrawn } from "../support/drawings/drawn-truth.js";
import { gridOf, pointsOf } from "../support/drawings/polylines.js";
import { farthest } from "../support/drawings/segment-grid.js";
import { GRBL } from "../support/machines/machine.js";
import { FAULT_DRAWING, untilIdle, untilUnderWay, waitS } from "../support/plots/faulty-plots.js";
import { SETTINGS } from "../support/plots/grbl-plotter.js";
import { seeded } from "../support/plots/live-plot.js";
import { LocalPlanner, strokesOf } from "../support/plots/local-planner.js";
import { NodePlotter } from "../support/plots/node-plotter.js";
import { cli } from "../support/processes/command-line.js";
import { folderOfTest } from "../support/processes/folders.js";
import { PtyGrbl } from "../support/processes/pty-grbl.js";
import { startServerProcess } from "../support/processes/server-process.js";
import { send, stateOf } from "../support/servers/shared-servers.js";
import { countFor, IS_FULL } from "../support/runs/full-run.js";
import { startAfter } from "../support/plots/start-after.js";

const SPEED = 150;
/** For faults at a certain moment. */
const FAULT_SPEED = 2;
const COUNT = countFor("PLOTWRIGHT_FAULTS", 5, 1);
const MOST_MM = 0.05;
const SAMPLES = IS_FULL
  ? ["flower-meadow", "harmonograph", "hello-paper", "moonrise", "three-colour-hills", "whirling-triangles"]
  : ["three-colour-hills"];
const GRBLS: readonly VirtualGrblOptions[] = IS_FULL
  ? [{ face: "1.1", rxBytes: 127 }, { face: "grblHAL" }, { face: "FluidNC" }, { face: "DrawCore" }]
  : [{ face: "1.1", rxBytes: 127 }, { face: "FluidNC" }];

let dir: string;
let profile: string;
const open: { close(): Promise<void> }[] = [];
beforeEach(() => {
  dir = folderOfTest();
  profile = join(dir, "my-grbl.json");
  writeFileSync(profile, JSON.stringify(GRBL));
});
afterEach(async () => {
  for (const thing of open.splice(0).reverse()) await thing.close();
});

async function grbl(options: VirtualGrblOptions, speed: number): Promise<PtyGrbl> {
  const board = await PtyGrbl.open({ ...options, machine: GRBL, speed });
  open.push(board);
  return board;
}

describe.each(GRBLS)("plot on a $face behind a pseudo-terminal", (options) => {
  it.each(SAMPLES)("draws %s within 0.05 mm", { timeout: 300_000 }, async (name) => {
    const board = await grbl(options, SPEED);
    const device = ["--device", board.path, "--virtual-speed", String(SPEED)];
    await plotSample(name, device);
    // Its motors are off in the end.
    expect((await board.report()).state.state).toBe("Sleep");
    await expectDrawn(board);
  });

  it.each(SAMPLES)("draws %s within 0.05 mm through a server", { timeout: 300_000 }, async (name) => {
    const board = await grbl(options, SPEED);
    const args = ["--device", board.path];
    const server = await startServerProcess({ dataDir: dir, virtualSpeed: SPEED, args });
    open.push({ close: () => server.stop() });
    await send(server.url, "PUT", `/machines/${GRBL.id}`, GRBL);
    await send(server.url, "PATCH", "/plotters/main", { machine: GRBL.id });
    // The server asks again with the new model, which takes some seconds.
    await expect
      .poll(async () => (await stateOf(server)).plotters[0]?.connection, { timeout: 60_000 })
      .toBe("idle");
    await plotSample(name, []);
    await expectDrawn(board);
  });
});

async function plotSample(name: string, device: readonly string[]): Promise<void> {
  const file = join(ROOT, "samples", `${name}.svg`);
  const own = ["--machine-file", profile];
  expect(await cli("plan", file, ...own, "--strokes", join(dir, "strokes.json"))).toMatchObject({ code: 0 });
  const { code, err } = await cli("plot", file, ...own, ...device, "--data", dir);
  expect([code, err]).toEqual([0, expect.stringContaining(`Done: ${name}.svg`)]);
}

/** Compares what the Grbl has drawn with the planned strokes. */
async function expectDrawn(board: PtyGrbl): Promise<void> {
  const { state, drawn } = await board.report();
  expect(state).toMatchObject({ penUp: true, xMm: 0, yMm: 0, lostCount: 0, earlyCount: 0 });
  const asked = polylinesOf(readFileSync(join(dir, "strokes.json"), "utf8"));
  const lines = drawn.flatMap(({ penDown, xy }) => (penDown && xy.length > 2 ? [xy] : []));
  expect(farthest(pointsOf(lines), gridOf(asked))).toBeLessThan(MOST_MM);
  expect(farthest(pointsOf(asked), gridOf(lines))).toBeLessThan(MOST_MM);
}

const polylinesOf = (text: string): number[][] =>
  (JSON.parse(text) as ReturnType<typeof toJson>).layers.flatMap(({ strokesMm }) =>
    strokesMm.map((line) => [...line]),
  );

describe("a plot on a Grbl that keeps its place", () => {
  it("goes on where the Grbl stopped, after its process was killed", { timeout: 300_000 }, async () => {
    const random = seeded(5);
    for (let i = 0; i < COUNT; i++) {
      const board = await grbl({}, FAULT_SPEED);
      const file = join(dir, "drawing.json");
      writeFileSync(file, JSON.stringify(toJson(FAULT_DRAWING, GRBL)));
      const main = join(ROOT, "dist/server/main.js");
      const device = ["--device", board.path, "--virtual-speed", String(FAULT_SPEED), "--data", dir];
      const own = ["--machine-file", profile];
      const strokes = join(dir, "strokes.json");
      expect(await cli("plan", file, ...own, "--strokes", strokes)).toMatchObject({ code: 0 });
      const asked = strokesOf(...polylinesOf(readFileSync(strokes, "utf8")));
      const plot = (...args: string[]) =>
        fork(main, ["plot", ...args, ...device], { execArgv: [], stdio: "pipe" });
      const killed = plot(file, ...own);
      await expect
        .poll(async () => (await board.report()).drawn.length, { timeout: 60_000 })
        .toBeGreaterThan(2);
      await waitS(3 * random());
      killed.kill("SIGKILL");
      await once(killed, "exit");
      const resumed = plot("--resume");
      const [code] = (await once(resumed, "exit")) as [number];
      expect(code).toBe(0);
      const { drawn, state } = await board.report();
      expect(state).toMatchObject({ penUp: true, lostCount: 0 });
      const { gapMm, overlapMm } = compareDrawn(asked, drawn);
      expect({ gapMm, overlapMm }).toEqual({ gapMm: belowMost(), overlapMm: belowMost() });
    }
  });

  it("goes on where the Grbl stopped, after the cable was pulled", { timeout: 300_000 }, async () => {
    const random = seeded(6);
    for (let i = 0; i < COUNT; i++) {
      const board = await grbl({}, FAULT_SPEED);
      const plotter = new NodePlotter({ device: board.path, settings: SETTINGS, virtualSpeed: FAULT_SPEED });
      open.push(plotter);
      await plotter.start();
      const journal: JournalEntry[] = [];
      const record = (entry: JournalEntry): void => void journal.push(entry);
      const run = await plotter.plot(new LocalPlanner(FAULT_DRAWING), SETTINGS, { journal: { record } });
      await untilUnderWay(run);
      await waitS(0.3 + 3 * random());
      board.tell("unplug");
      await expect(run.finished).rejects.toThrow();
      board.tell("replug");
      await untilIdle(plotter);
      const again = await plotter.plot(new LocalPlanner(FAULT_DRAWING), SETTINGS, startAfter(journal.at(-1)));
      await again.resume();
      expect(await again.finished).toEqual({ kind: "done" });
      const { gapMm, overlapMm } = compareDrawn(FAULT_DRAWING, (await board.report()).drawn);
      expect({ gapMm, overlapMm }).toEqual({ gapMm: belowMost(), overlapMm: belowMost() });
    }
  });
});

const belowMost = (): number => expect.toSatisfy((mm: number) => mm < MOST_MM) as number;
