/** Moves by hand from the command line, one command after the other on the same board behind a pseudo-terminal. */
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { machineById } from "../../../src/index.js";
import { PtyBoard } from "../../support/processes/pty-board.js";
import { CaughtIo, cli, cliWith } from "../../support/processes/command-line.js";

const MINE = { ...machineById("axidraw-v3"), id: "mine", name: "Mine", widthMm: 600 };
const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100" stroke="black"><path d="M10 20H90M10 40H90"/></svg>`;
const SPEED = 20;

let board: PtyBoard;
let folder: string;
beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "plotwright-cli-moves-"));
  board = await PtyBoard.open({ speed: SPEED });
});
afterAll(async () => {
  await board.close();
  rmSync(folder, { recursive: true, force: true });
});
const onBoard = (...args: string[]) =>
  cli(...args, "--device", board.path, "--virtual-speed", String(SPEED), "--data", folder);
const done = { code: 0, out: "", err: "" };
const place = async () => {
  const { xMm, yMm, penUp, motorsOn } = (await board.report()).state;
  return { xMm, yMm, penUp, motorsOn };
};

describe("moves by hand from the command line", () => {
  it("end exactly where requested, and know the position from the command before", async () => {
    expect(await onBoard("jog", "20", "10.5")).toEqual(done);
    expect(await onBoard("jog", "-5", "-0.5", "--travel-speed", "50")).toEqual(done);
    expect(await place()).toEqual({ xMm: 15, yMm: 10, penUp: true, motorsOn: true });
    expect(await onBoard("move-to", "40", "30")).toEqual(done);
    expect(await place()).toMatchObject({ xMm: 40, yMm: 30 });
    expect(await onBoard("cycle-pen")).toEqual(done);
    expect(await onBoard("test-patch")).toEqual(done);
    expect(await place()).toMatchObject({ xMm: 40, yMm: 30, penUp: true });
    expect(await onBoard("set-home")).toEqual(done);
    expect(await onBoard("move-to", "10", "0")).toEqual(done);
    expect(await onBoard("home")).toEqual(done);
    expect((await onBoard("info")).out).toMatch(/position {2}0\.00, 0\.00 mm/);
    expect(await onBoard("align")).toEqual(done);
    expect(await place()).toMatchObject({ motorsOn: false });
  });

  it("tell users of an older firmware what it can miss, and so does a plot", async () => {
    const sentence = /\bnote:? +Before firmware 3\.0\.0, this board can miss a motor supply failure of less/g;
    expect((await onBoard("info")).out.match(sentence)).toHaveLength(1);
    const file = join(folder, "short.svg");
    writeFileSync(file, SVG.replace("H90M10 40H90", "H11"));
    expect((await onBoard("plot", file)).err.match(sentence)).toHaveLength(1);
    const newer = await PtyBoard.open({ speed: SPEED, firmware: "3.0.3" });
    try {
      const { out } = await cli("info", "--device", newer.path, "--virtual-speed", String(SPEED));
      expect(out).toMatch(/firmware {2}3\.0\.3\n/);
      expect(out).not.toContain("note");
    } finally {
      await newer.close();
    }
  });

  it("go around a drawing with the pen up", async () => {
    const file = join(folder, "lines.svg");
    writeFileSync(file, SVG);
    const before = (await board.report()).statistics;
    expect(await onBoard("frame", file, "--no-fit", "--no-clip")).toEqual(done);
    const after = (await board.report()).statistics;
    expect(after.drawnMm).toBe(before.drawnMm);
    // From its position to the corner at 10, 20, around 80 × 20 mm, and back.
    expect(after.travelMm - before.travelMm).toBeCloseTo(200 + 2 * Math.hypot(10, 20), 0);
  });

  it("stay within the machine: exit code 3 and one line", async () => {
    expect(await onBoard("move-to", "400", "0")).toMatchObject({
      code: 3,
      err: expect.stringMatching(/^plotwright: 400, 0 mm is beyond the AxiDraw V3[^\n]*\n$/) as string,
    });
    expect(await onBoard("move-to", "x", "0")).toMatchObject({ code: 2 });
    expect(await onBoard("jog", "10")).toMatchObject({ code: 2 });
  });
});

describe("Ctrl-C during a move by hand", () => {
  it("stops it at once and lifts the pen, and is needed only once", async () => {
    const slow = await PtyBoard.open();
    try {
      const io = new CaughtIo();
      const where = ["--device", slow.path, "--virtual-speed", "1", "--data", folder];
      const drawing = cliWith(io, "test-patch", "--speed", "5", ...where);
      const drawnMm = async (): Promise<number> => (await slow.report()).statistics.drawnMm;
      await expect.poll(drawnMm, { timeout: 10_000 }).toBeGreaterThan(1);
      io.interrupt();
      // While the pen is being lifted, the process still listens, so that a second Ctrl-C does not end it.
      expect(io.listens).toBe(true);
      io.interrupt();
      expect(await drawing).toEqual({ code: 5, out: "", err: "plotwright: The command was stopped.\n" });
      expect(io.listens).toBe(false);
      const { state, statistics } = await slow.report();
      expect(state.penUp).toBe(true);
      // The first side of its square is 12 mm long.
      expect(statistics.drawnMm).toBeLessThan(12);
    } finally {
      await slow.close();
    }
  });
});

describe("a custom machine", () => {
  it("is taken from a file", async () => {
    const file = join(folder, "mine.json");
    writeFileSync(file, JSON.stringify(MINE));
    expect(await onBoard("move-to", "400", "0", "--machine-file", file)).toEqual(done);
    expect(await place()).toMatchObject({ xMm: 400, yMm: 0 });
    writeFileSync(file, JSON.stringify({ ...MINE, widthMm: -1 }));
    expect(await cli("plan", "x.svg", "--machine-file", file)).toMatchObject({
      code: 2,
      err: expect.stringMatching(/--machine-file .*widthMm/) as string,
    });
  });

  it("is listed with the others", async () => {
    const { code, out, err } = await cli("machines", "--data", folder);
    expect([code, err]).toEqual([0, ""]);
    expect(out).toMatch(/^axidraw-v3\tAxiDraw V3\t300 × 218 mm\n/);
  });
});
