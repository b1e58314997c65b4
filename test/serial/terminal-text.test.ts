/** What `plotwright plot` leaves on a terminal, line by line: messages and the progress bar never mix. */
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { spawn } from "@lydell/node-pty";
import xterm from "@xterm/headless";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";
import { folderOfTest } from "../support/processes/folders.js";

const LIMIT_MS = 60_000;
const CTRL_C = "\u0003";
const ENTER = "\r";
const layer = (name: string, y: number): string =>
  `<g inkscape:groupmode="layer" inkscape:label="${name}"><path d="M10 ${y}h120"/></g>`;
const SVG =
  '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" ' +
  'width="150mm" height="100mm" viewBox="0 0 150 100" stroke="black">' +
  `${layer("1", 10)}${layer("!2", 20)}</svg>`;

let dir: string;
let end: () => void;
beforeEach(() => {
  dir = folderOfTest();
  writeFileSync(join(dir, "a.svg"), SVG);
});
afterEach(() => {
  end();
});

/** A terminal of this size with a plot on it. */
class PlotAtTerminal {
  readonly exitCode: Promise<number>;
  private readonly screen;
  private readonly process;

  constructor(cols: number, rows: number) {
    this.screen = new xterm.Terminal({ cols, rows, allowProposedApi: true, scrollback: 1_000 });
    const args = ["plot", join(dir, "a.svg"), "--no-fit", "--device", "virtual", "--virtual-speed", "2"];
    this.process = spawn(process.execPath, [join(ROOT, "dist/server/main.js"), ...args, "--data", dir], {
      cols,
      rows,
      cwd: ROOT,
    });
    this.process.onData((text) => this.screen.write(text));
    this.exitCode = new Promise((resolve) => this.process.onExit(({ exitCode }) => resolve(exitCode)));
    end = () => this.process.kill("SIGKILL");
  }

  type(text: string): void {
    this.process.write(text);
  }

  /** All lines that the user sees or can scroll back to, without empty ones; wrapped lines are one. */
  lines(): string[] {
    const { active } = this.screen.buffer;
    const lines: string[] = [];
    for (let y = 0; y < active.length; y++) {
      const row = active.getLine(y);
      const text = row?.translateToString(true) ?? "";
      if (row?.isWrapped === true) lines.push(`${lines.pop() ?? ""}${text}`);
      else lines.push(text);
    }
    return lines.filter((line) => line !== "");
  }

  async shows(words: RegExp): Promise<void> {
    await expect
      .poll(() => this.lines(), { timeout: LIMIT_MS / 2 })
      .toEqual(expect.arrayContaining([expect.stringMatching(words)]));
  }
}

describe("plotwright plot at a terminal", () => {
  it.each([
    [100, 30],
    [60, 5],
  ])(
    "plot writes whole lines at %i columns and %i rows through pauses, a pen stop and a cancel",
    async (cols, rows) => {
      const plot = new PlotAtTerminal(cols, rows);
      await plot.shows(/█+░+ +\d+ % +00:00:0\d so far/);
      plot.type(CTRL_C);
      await plot.shows(/^Paused\. /);
      plot.type(ENTER);
      await plot.shows(/Put in the pen for "2"/);
      plot.type(ENTER);
      await plot.shows(/█+░+ +[6-9]\d % /);
      plot.type(CTRL_C);
      await expect.poll(() => plot.lines().filter((line) => line.startsWith("Paused.")).length).toBe(2);
      plot.type(CTRL_C);
      expect(await plot.exitCode).toBe(5);
      // What the person types is echoed at the beginning of a line.
      const lines = plot.lines().map((line) => line.replace(/^(\^C)+/, ""));
      expect(lines.filter((line) => line !== "" && !/^█*░* +\d+ % /.test(line))).toEqual([
        "a.svg: drawn 120 × 10 mm, 100 %",
        "Plotting a.svg.",
        "Paused. Enter resumes, Ctrl-C again cancels.",
        'Put in the pen for "2". Enter resumes, Ctrl-C cancels.',
        "Paused. Enter resumes, Ctrl-C again cancels.",
        "Cancelling: the pen lifts and goes home.",
        "plotwright: the plot was cancelled.",
      ]);
    },
    LIMIT_MS,
  );
});
