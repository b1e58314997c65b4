/** kill -9 of `plotwright plot` over a real pseudo-terminal, while it draws a line that crosses itself many times. */
import { fork, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import { readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";
import { drawnMm } from "../support/plots/live-plot.js";
import { PtyBoard } from "../support/processes/pty-board.js";
import { folderOfTest } from "../support/processes/folders.js";

const LIMIT_MS = 120_000;
/** Loops of about 25 mm, each overlapping the one before. */
const LOOPS = Array.from({ length: 600 }, (_, i) => {
  const [x, y] = [30 + 0.012 * i + 4 * Math.cos(i / 9), 30 + 0.015 * i + 4 * Math.sin(i / 9)];
  return `${x.toFixed(3)} ${y.toFixed(3)}`;
});
const SVG =
  '<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="90mm" viewBox="0 0 90 90" fill="none">' +
  `<path stroke="black" d="M${LOOPS.join("L")}"/></svg>`;
/** The line is drawn up to here before the process is killed. */
const KILLED_AT_MM = 60;
/** Missing or doubled: rounding to steps, and the place within the tolerance of a crossing. */
const TOLERANCE_MM = 0.5;

let dir: string;
let board: PtyBoard;
const children: ChildProcess[] = [];
beforeEach(async () => {
  dir = folderOfTest();
  writeFileSync(join(dir, "loops.svg"), SVG);
  board = await PtyBoard.open({ wakeful: true });
});
afterEach(async () => {
  for (const child of children.splice(0)) child.kill("SIGKILL");
  await board.close();
});

/** `plotwright plot ARGS`, with what it prints. */
function plot(...args: string[]): { child: ChildProcess; err: () => string; ended: Promise<unknown> } {
  const main = join(ROOT, "dist/server/main.js");
  const all = ["plot", ...args, "--device", board.path, "--data", dir];
  const child = fork(main, all, { execArgv: [], stdio: "pipe" });
  children.push(child);
  let text = "";
  child.stderr?.on("data", (data: Buffer) => (text += data.toString()));
  return { child, err: () => text, ended: once(child, "exit").then(([code]) => code as unknown) };
}
const plotLoops = () => plot(join(dir, "loops.svg"), "--no-fit", "--margin", "0");

async function penDownMm(): Promise<number> {
  const { drawn } = await board.report();
  return drawnMm({
    drawn: () => drawn.map(({ penDown, xy }) => ({ penDown, xy: Float64Array.from(xy) })),
  });
}

describe("plotwright plot that is killed in the middle of a line", () => {
  it("is resumed where the board stopped, by plot --resume", async () => {
    const whole = plotLoops();
    expect([await whole.ended, whole.err()]).toEqual([0, expect.stringMatching(/Done: loops\.svg/)]);
    const wholeMm = await penDownMm();

    const killed = plotLoops();
    await expect.poll(penDownMm, { timeout: LIMIT_MS }).toBeGreaterThan(wholeMm + KILLED_AT_MM);
    killed.child.kill("SIGKILL");
    await killed.ended;

    const again = plotLoops();
    expect(await again.ended).toBe(5);
    expect(again.err()).toMatch(/loops\.svg was interrupted at \d+ %\. .*--resume .*--restart/);

    const resumed = plot("--resume");
    expect([await resumed.ended, resumed.err()]).toEqual([0, expect.stringMatching(/Resuming loops\.svg/)]);
    expect(Math.abs((await penDownMm()) - 2 * wholeMm)).toBeLessThan(TOLERANCE_MM);
    expect(readdirSync(join(dir, "command-line"))).toEqual([]);
  });
});
