/**
 * `plotwright plot` at a terminal whose connection is dropped, or that is asked to end, over a real pseudo-terminal to
 * a board in another process. PLOTWRIGHT_FAULTS=20, or the full run: 20 instants for each signal and firmware.
 */
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { spawn as spawnAtTerminal } from "@lydell/node-pty";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";
import type { StrokeSet } from "../../src/index.js";
import { compareDrawn } from "../support/drawings/drawn-truth.js";
import { FAULT_DRAWING, waitS } from "../support/plots/faulty-plots.js";
import { countFor } from "../support/runs/full-run.js";
import { seeded } from "../support/plots/live-plot.js";
import { strokesOf } from "../support/plots/local-planner.js";
import { PtyBoard } from "../support/processes/pty-board.js";

const COUNT = countFor("PLOTWRIGHT_FAULTS", 20, 1);
const FIRMWARES = COUNT > 1 ? ["2.8.1", "3.0.3"] : ["2.8.1"];
const LIMIT_MS = 120_000;
/** How long the plot draws. */
const LATEST_S = 8;
/** Rounding to steps, and the accuracy of a place. */
const TOLERANCE_MM = 0.3;
/** Plots at the same time. */
const LANES = 4;
const MAIN = join(ROOT, "dist/server/main.js");

/** Ways in which the process is asked to end. */
const ENDS = {
  /** The terminal disappears, as when an ssh connection is dropped: the process gets SIGHUP. */
  "a dropped connection": (at: AtTerminal) => at.drop(),
  SIGTERM: (at: AtTerminal) => at.signal("SIGTERM"),
} as const;

/** A board, the folder for a drawing and the data, and the commands that use them. */
class Desk {
  readonly dir = mkdtempSync(join(tmpdir(), "plotwright-ended-"));
  private readonly running: AtTerminal[] = [];

  private constructor(
    readonly board: PtyBoard,
    private readonly speed: number,
  ) {}

  static async open(options: { firmware?: string; speed?: number } = {}): Promise<Desk> {
    return new Desk(await PtyBoard.open({ ...options, wakeful: true }), options.speed ?? 1);
  }

  async close(): Promise<void> {
    this.running.forEach((one) => one.signal("SIGKILL"));
    await this.board.close();
    rmSync(this.dir, { recursive: true, force: true });
  }

  run(...args: string[]): AtTerminal {
    const device = ["--device", this.board.path, "--virtual-speed", String(this.speed)];
    const started = new AtTerminal([...args, ...device, "--data", this.dir]);
    this.running.push(started);
    return started;
  }

  plot(svg: string, ...args: string[]): AtTerminal {
    const file = join(this.dir, "drawing.svg");
    writeFileSync(file, svg);
    return this.run("plot", file, "--no-fit", "--margin", "0", ...args);
  }

  /** Resumes the plot and lets it end. */
  async resume(): Promise<void> {
    const resumed = this.run("plot", "--resume");
    await resumed.saying(/The board still knows its position\. Enter resumes/);
    resumed.type("\r");
    await resumed.endsWith(0);
    expect(readdirSync(join(this.dir, "command-line"))).toEqual([]);
  }

  async untilDrawn(mm: number): Promise<void> {
    const drawnMm = async (): Promise<number> => (await this.board.report()).statistics.drawnMm;
    await expect.poll(drawnMm, { timeout: LIMIT_MS }).toBeGreaterThan(mm);
  }

  /** The pen is up and the carriage at rest, as soon as the board has done what it was sent. */
  async expectLifted(): Promise<void> {
    const lifted = async (): Promise<object> => {
      const { penUp, isBusy } = (await this.board.report()).state;
      return { penUp, isBusy };
    };
    await expect.poll(lifted, { timeout: LIMIT_MS }).toEqual({ penUp: true, isBusy: false });
  }

  /** So too, and the motors hold the carriage there. */
  async expectHeld(): Promise<void> {
    await this.expectLifted();
    expect((await this.board.report()).state.motorsOn).toBe(true);
  }

  /** Everything is drawn `times` times, and nothing else. */
  async expectDrawn(times: number, strokes: StrokeSet = FAULT_DRAWING): Promise<void> {
    const { gapMm, overlapMm, awayMm } = compareDrawn(strokes, (await this.board.report()).drawn);
    expect(gapMm).toBeLessThan(TOLERANCE_MM);
    expect(Math.abs(overlapMm - (times - 1) * lengthOf(strokes))).toBeLessThan(TOLERANCE_MM);
    expect(awayMm).toBeLessThan(TOLERANCE_MM);
  }
}

/** A command at a terminal of its own. */
class AtTerminal {
  said = "";
  readonly ended: Promise<{ exitCode: number; signal?: number }>;
  private readonly terminal;

  constructor(args: readonly string[]) {
    this.terminal = spawnAtTerminal(process.execPath, [MAIN, ...args], { cwd: ROOT });
    this.terminal.onData((text) => (this.said += text));
    this.ended = new Promise((resolve) => this.terminal.onExit(resolve));
  }

  type(text: string): void {
    this.terminal.write(text);
  }

  /** Closes the other end of the terminal. The type lacks this method. */
  drop(): void {
    (this.terminal as unknown as { destroy(): void }).destroy();
  }

  signal(name: "SIGTERM" | "SIGHUP" | "SIGKILL"): void {
    try {
      process.kill(this.terminal.pid, name);
    } catch {
      // It has ended.
    }
  }

  /** What it said is in the message of a failure. */
  async endsWith(exitCode: number): Promise<void> {
    expect({ ...(await this.ended), said: this.said }).toEqual({ exitCode, signal: 0, said: this.said });
  }

  async saying(words: RegExp): Promise<void> {
    await expect.poll(() => words.test(this.said), { timeout: LIMIT_MS }).toBe(true);
  }
}

const svgOf = ({ xy, offsets }: StrokeSet): string => {
  const lines = Array.from({ length: offsets.length - 1 }, (_, i) =>
    Array.from(xy.subarray(2 * offsets[i], 2 * offsets[i + 1])).join(" "),
  );
  return (
    '<svg xmlns="http://www.w3.org/2000/svg" width="110mm" height="60mm" viewBox="0 0 110 60" fill="none" stroke="black">' +
    `${lines.map((line) => `<polyline points="${line}"/>`).join("")}</svg>`
  );
};

const SVG = svgOf(FAULT_DRAWING);

function lengthOf({ xy, offsets }: StrokeSet): number {
  let mm = 0;
  for (let s = 0; s + 1 < offsets.length; s++) {
    for (let i = offsets[s] + 1; i < offsets[s + 1]; i++) {
      mm += Math.hypot(xy[2 * i] - xy[2 * i - 2], xy[2 * i + 1] - xy[2 * i - 1]);
    }
  }
  return mm;
}

describe.each(FIRMWARES)("plotwright plot on firmware %s", (firmware) => {
  it.each(Object.entries(ENDS))(
    "ended by %s at any instant lifts the pen, and is resumed where it stopped",
    async (way, end) => {
      const random = seeded(way.length);
      const instantsS = Array.from({ length: COUNT }, () => LATEST_S * random());
      const endedAt = async (afterS: number): Promise<void> => {
        const desk = await Desk.open({ firmware });
        try {
          const plotted = desk.plot(SVG);
          await desk.untilDrawn(0);
          await waitS(afterS);
          end(plotted);
          await plotted.endsWith(5);
          await desk.expectHeld();
          await desk.resume();
          await desk.expectDrawn(1);
        } finally {
          await desk.close();
        }
      };
      // Several at a time, since they mostly wait.
      const lanes = Array.from({ length: LANES }, async () => {
        for (let afterS = instantsS.pop(); afterS !== undefined; afterS = instantsS.pop())
          await endedAt(afterS);
      });
      await Promise.all(lanes);
    },
    LIMIT_MS + 45_000 * COUNT,
  );
});

describe.each(Object.entries(ENDS).slice(0, COUNT))("plotwright plot that is ended by %s", (_, end) => {
  let desk: Desk;
  beforeEach(async () => {
    desk = await Desk.open({ speed: 3 });
  });
  afterEach(() => desk.close());

  it("plot stays where it is if it is ended during a pause, and is resumed", async () => {
    const plotted = desk.plot(SVG);
    await desk.untilDrawn(0);
    plotted.type("\u0003");
    await plotted.saying(/Paused/);
    end(plotted);
    await plotted.endsWith(5);
    await desk.expectHeld();
    await desk.resume();
    await desk.expectDrawn(1);
  });

  it("plot is resumed with the pen for which it waited when it was ended", async () => {
    const layer = (name: string, d: string): string =>
      `<g inkscape:groupmode="layer" inkscape:label="${name}"><path d="${d}"/></g>`;
    const plotted = desk.plot(
      '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" ' +
        'width="60mm" height="60mm" viewBox="0 0 60 60" stroke="black">' +
        `${layer("1", "M10 10h20")}${layer("!2", "M10 20h20")}</svg>`,
    );
    await plotted.saying(/Put in the pen for "2"/);
    end(plotted);
    await plotted.endsWith(5);
    await desk.expectDrawn(1, strokesOf([10, 10, 30, 10]));
    await desk.resume();
    await desk.expectDrawn(1, strokesOf([10, 10, 30, 10], [10, 20, 30, 20]));
  });

  it("plot is resumed in its second copy if it was ended there, and begins no third", async () => {
    const line = strokesOf([10, 10, 100, 10, 100, 20, 10, 20, 10, 30, 100, 30, 100, 40, 10, 40]);
    const plotted = desk.plot(svgOf(line), "--copies", "3", "--paper-s", "0");
    await desk.untilDrawn(lengthOf(line) + 5);
    end(plotted);
    await plotted.endsWith(5);
    await desk.expectHeld();
    await desk.resume();
    await desk.expectDrawn(2, line);
  });

  it("is not ended in the middle of a stroke by more signals", async () => {
    const plotted = desk.plot(SVG);
    await desk.untilDrawn(0);
    end(plotted);
    for (const name of ["SIGHUP", "SIGTERM", "SIGTERM"] as const) {
      await waitS(0.03);
      plotted.signal(name);
    }
    await plotted.endsWith(5);
    await desk.expectHeld();
    await desk.resume();
    await desk.expectDrawn(1);
  });
});

describe("at a terminal that disappears", () => {
  let desk: Desk;
  beforeEach(async () => {
    desk = await Desk.open();
  });
  afterEach(() => desk.close());

  it.each([["jog", "150", "0"], ["test-patch"]])(
    "%s stops its move with the pen up, and ends without a crash",
    async (...args) => {
      const command = desk.run(...args);
      const moveCount = async (): Promise<number> => (await desk.board.report()).statistics.moveCount;
      await expect.poll(moveCount, { timeout: LIMIT_MS }).toBeGreaterThan(0);
      command.drop();
      await command.endsWith(5);
      await desk.expectLifted();
    },
  );

  it("serve ends without a crash", async () => {
    const server = desk.run("serve", "--port", "0");
    await server.saying(/plotwright is at/);
    server.drop();
    await server.endsWith(0);
  });
});
