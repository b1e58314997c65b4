/** `plotwright live` over a real pseudo-terminal: the end of its input, and all ways in which its process ends. */
import { fork, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";
import { strokesOf, type Line } from "../../src/index.js";
import { compareDrawn } from "../support/drawings/drawn-truth.js";
import { PtyBoard } from "../support/processes/pty-board.js";
import { folderOfTest } from "../support/processes/folders.js";

const LIMIT_MS = 120_000;
/** Missing or doubled: rounding to steps, and the accuracy of a place. */
const TOLERANCE_MM = 0.5;
const LINE: Line = Array.from({ length: 121 }, (_, i) => [20 + i, 40 + 6 * Math.sin(i / 5)] as const);
const REST: Line = [
  [20, 70],
  [60, 70],
];
const textOf = (line: Line): string => line.map(([x, y]) => `${x} ${y}\n`).join("");

let dir: string;
let board: PtyBoard;
const children: ChildProcess[] = [];
beforeEach(async () => {
  dir = folderOfTest();
  board = await PtyBoard.open({ wakeful: true });
});
afterEach(async () => {
  for (const child of children.splice(0)) child.kill("SIGKILL");
  await board.close();
});

function live(...args: string[]) {
  const all = ["live", ...args, "--device", board.path, "--data", dir];
  const child = fork(join(ROOT, "dist/server/main.js"), all, { execArgv: [], stdio: "pipe" });
  children.push(child);
  let text = "";
  child.stderr?.on("data", (data: Buffer) => (text += data.toString()));
  return {
    child,
    input: child.stdin!,
    err: () => text,
    ended: once(child, "exit").then(([code]) => code as unknown),
  };
}

const drawnTo = async (): Promise<number> => {
  const { drawn } = await board.report();
  return Math.max(
    0,
    ...drawn.filter(({ penDown }) => penDown).map(({ xy }) => Math.max(...xy.filter((_, i) => i % 2 === 0))),
  );
};

async function mustBeDrawn(lines: readonly Line[]): Promise<void> {
  const { drawn, state } = await board.report();
  const { gapMm, overlapMm, awayMm } = compareDrawn(strokesOf(lines), drawn);
  expect(Math.max(gapMm, overlapMm)).toBeLessThan(TOLERANCE_MM);
  expect(awayMm).toBeLessThan(0.2);
  expect(state).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
}

describe("plotwright live", () => {
  it(
    "draws the points and strokes of its input, leaves out what it can't draw, and goes home at the end",
    async () => {
      const { input, ended, err } = live();
      input.write(textOf(LINE));
      input.write(`up\n-5 10\nnonsense\n${JSON.stringify(REST)}\n`);
      input.end();
      expect([await ended, err()]).toEqual([
        3,
        expect.stringMatching(/line 123: .*-5.*\nline 124: "nonsense" is no point/),
      ]);
      await mustBeDrawn([LINE, REST]);
      expect(readdirSync(join(dir, "live"))).toEqual([]);
    },
    LIMIT_MS,
  );

  it.each(["SIGTERM", "SIGHUP", "SIGKILL"] as const)(
    "lifts the pen after %s, at once or at the next start, which draws what was left",
    async (signal) => {
      const first = live();
      first.input.write(textOf(LINE));
      await expect.poll(drawnTo, { timeout: LIMIT_MS }).toBeGreaterThan(50);
      first.child.kill(signal);
      expect(await first.ended).toBe(signal === "SIGKILL" ? null : 5);
      if (signal !== "SIGKILL") expect((await board.report()).state.penUp).toBe(true);
      const second = live();
      second.input.end(`${JSON.stringify(REST)}\n`);
      expect([await second.ended, second.err()]).toEqual([
        0,
        expect.stringMatching(/was interrupted: what it left/),
      ]);
      await mustBeDrawn([LINE, REST]);
    },
    LIMIT_MS,
  );
});
