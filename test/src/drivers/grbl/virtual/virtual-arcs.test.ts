/** How the virtual Grbl performs arcs of any sender, and refuses wrong ones, as Grbl's own reference describes it. */
import { describe, expect, it } from "vitest";
import { FACES, type FaceName } from "../../../../../src/drivers/grbl/virtual/faces.js";
import { VirtualGrbl } from "../../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import { asciiBytes } from "../../../../../src/drivers/line-splitter.js";
import type { MachineProfile } from "../../../../../src/index.js";
import { ManualClock } from "../../../../support/clocks/manual-clock.js";
import { GRBL } from "../../../../support/machines/machine.js";

async function typedAt(face: FaceName = "1.1", settings = {}, machine: MachineProfile = GRBL) {
  const world = new ManualClock();
  const board = new VirtualGrbl({ clock: world, speed: 1, machine }, { face, settings });
  const line = board.transport();
  let received = "";
  line.onData((bytes) => (received += new TextDecoder().decode(bytes)));
  /** Returns what it answers meanwhile. */
  const type = async (text: string, forS = 0.01): Promise<string> => {
    received = "";
    await line.write(asciiBytes(text));
    await world.advance(forS);
    return received;
  };
  return { world, board, type };
}

/** What it has drawn since it was at X10 Y20. */
function drawnBy(board: VirtualGrbl): [x: number, y: number][] {
  const points = board
    .drawn()
    .flatMap(({ xy }) =>
      Array.from({ length: xy.length / 2 }, (_, i): [number, number] => [xy[2 * i], xy[2 * i + 1]]),
    );
  return points.slice(points.findIndex(([x, y]) => x === 10 && y === 20));
}

const lengthMm = (points: readonly [x: number, y: number][]): number =>
  points.slice(1).reduce((mm, [x, y], i) => mm + Math.hypot(x - points[i][0], y - points[i][1]), 0);

const ARCS: readonly [line: string, centre: [number, number], turn: number][] = [
  ["G3X0Y30I-10J0", [0, 20], 1 / 4],
  ["G2X0Y30I-10", [0, 20], 3 / 4],
  ["G3X0Y30R10", [0, 20], 1 / 4],
  ["G2X0Y30R-10", [0, 20], 3 / 4],
  ["G2X0Y30R10", [10, 30], 1 / 4],
  ["G3X0Y30R-10", [10, 30], 3 / 4],
  ["G3X10Y20I-10J0", [0, 20], 1],
  ["G2X10I0J10", [10, 30], 1],
];

describe.each(FACES.filter((face) => face !== "DrawCore"))("a virtual %s", (face) => {
  it.each(ARCS)("draws %s around its centre, and says ok once", async (line, [centreX, centreY], turn) => {
    const { board, type } = await typedAt(face);
    await type("G0X10Y20\n", 1);
    expect(await type(`G17${line}F3000\n`, 4)).toBe("ok\r\n");
    const points = drawnBy(board);
    const [, x, y] = /X(\d+)(?:Y(\d+))?/.exec(line)!;
    expect(board.state()).toMatchObject({ state: "Idle", xMm: Number(x), yMm: Number(y ?? 20) });
    for (const [px, py] of points) expect(Math.hypot(px - centreX, py - centreY)).toBeCloseTo(10, 2);
    expect(lengthMm(points)).toBeCloseTo(2 * Math.PI * 10 * turn, 1);
    board.close();
  });

  it.each([
    ["G3X0Y30", 35],
    ["G3Z1I-10", 32],
    ["G3I-10", 26],
    ["G3X0Y30I-9.9J0", 33],
    ["G3X0Y30I-9J0", 33],
    ["G3X10Y20R10", 33],
    ["G3X0Y30R7", 34],
  ])("refuses %s with error:%i, and stays where it is", async (line, code) => {
    const { board, type } = await typedAt(face);
    await type("G0X10Y20\n", 1);
    const words = face === "0.9" ? `error: Invalid gcode ID:${code}` : `error:${code}`;
    expect(await type(`${line}F3000\n`, 1)).toBe(`${words}\r\n`);
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 10, yMm: 20 });
    // After an empty line, which a grblHAL wants. The refused line has set neither motion nor feed.
    await type("\n");
    expect(await type("$G\n")).toContain("G0 G54 G17 G21 G90 G94 M5 M9 T0 F0");
    board.close();
  });
});

describe("an arc", () => {
  it("whose radii differ by 0.004 mm is accepted, and ends where the line says", async () => {
    const { board, type } = await typedAt();
    await type("G0X10Y20\n", 1);
    expect(await type("G3X0Y30.004I-10J0F3000\n", 2)).toBe("ok\r\n");
    expect(board.state()).toMatchObject({ xMm: 0, yMm: 30.004 });
  });

  it("whose radii differ by 0.1 mm is accepted if that is less than 0.1 % of it", async () => {
    const { type } = await typedAt();
    expect(await type("G3X-200Y200.1I-200J0F9000\n", 10)).toBe("ok\r\n");
    expect(await type("G3X0Y0I0J-200.3\n")).toMatch(/^error:33/);
  });

  it("begins where the last line ended as written, although whole steps are far from there", async () => {
    const coarse = { ...GRBL, stepsPerMm: 10 };
    const { board, type } = await typedAt("1.1", {}, coarse);
    await type("G0X10.049Y20\n", 1);
    expect(await type("G3X0.049Y30I-10J0F3000\n", 2)).toBe("ok\r\n");
    expect(board.state()).toMatchObject({ xMm: 0, yMm: 30 });
  });

  it("is answered when all of its moves are in the queue, and stays interruptible", async () => {
    const { world, board, type } = await typedAt();
    await type("G0X10Y20\n", 1);
    expect(await type("G3X10Y20I-10J0F3000\n", 1)).toBe("");
    expect(await type("?")).toMatch(/^<Run\|.*Bf:0,/);
    await type("!", 0.2);
    const { state, xMm, yMm } = board.state();
    expect(state).toBe("Hold:0");
    expect(Math.hypot(xMm, yMm - 20)).toBeCloseTo(10, 1);
    expect(await type("~", 3)).toBe("ok\r\n");
    await world.advance(1);
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 10, yMm: 20 });
  });

  it("is forgotten at a reset, and the next one begins where the carriage stands", async () => {
    const { board, type } = await typedAt();
    await type("G0X10Y20\n", 1);
    await type("G3X10Y20I-10J0F3000\n", 0.3);
    await type("!", 0.2);
    await type("\x18");
    const { xMm, yMm } = board.state();
    expect(await type(`G3X${(xMm + 2).toFixed(3)}Y${yMm.toFixed(3)}I1F600\n`, 4)).toBe("ok\r\n");
    expect(board.state().xMm).toBeCloseTo(xMm + 2, 2);
    expect(board.state().yMm).toBeCloseTo(yMm, 2);
  });

  it("takes the time of its moves by the planner's model, and is cut by $12", async () => {
    const countOf = async (tolerance: number): Promise<number> => {
      const { board, type } = await typedAt("1.1", { 12: tolerance });
      await type("G0X10Y20\n", 1);
      await type("G3X0Y30I-10J0F3000\n", 2);
      return drawnBy(board).length - 1;
    };
    expect(await countOf(0.002)).toBe(39);
    expect(await countOf(0.02)).toBe(12);
    expect(await countOf(0)).toBe(1);
  });

  it("stops with an alarm where it leaves the soft limits", async () => {
    const { board, type } = await typedAt("1.1", { 20: 1 });
    await type("G0X-10Y-5\n", 1);
    expect(await type("G2X-20Y-5I-5J0F600\n", 3)).toContain("ok");
    expect(await type("G2X-10Y-5I5J5F600\n", 9)).toMatch(/ALARM:2/);
    expect(board.state().state).toBe("Alarm");
  });

  it("is not known to a DrawCore", async () => {
    const { board, type } = await typedAt("DrawCore");
    await type("G0X10Y20\n", 1);
    expect(await type("G3X0Y30I-10J0F3000\n", 1)).toBe("error:20\r\n");
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 10, yMm: 20 });
  });

  it("lasts as a mode, so that the next line needs no G", async () => {
    const { board, type } = await typedAt();
    await type("G0X10Y20\nG3X0Y30I-10J0F3000\n", 2);
    expect(await type("X-10Y20I0J-10\n", 2)).toBe("ok\r\n");
    expect(board.state()).toMatchObject({ xMm: -10, yMm: 20 });
    expect(await type("$G\n")).toContain("[GC:G3 ");
  });
});
