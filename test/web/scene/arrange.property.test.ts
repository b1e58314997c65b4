/** Drawings on a sheet: frames, aligning, grids and free places. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { compose, mapAround, rotation, scaling, translation, type Box } from "../../../src/internal.js";
import {
  ALIGNMENTS,
  aligned,
  asAdded,
  boxOf,
  boxOfAll,
  fittedInto,
  frameOf,
  gridOf,
  inFrame,
  matrixOf,
  movedOnto,
  type FileExtent,
  type Placed,
} from "../../../web/scene/arrange.js";
import { cases } from "../../support/runs/full-run.js";

const RUNS = { numRuns: cases(1_000, 200) };
const INSIDE: Box = { x0: 15, y0: 15, x1: 282, y1: 195 };
const size = fc.double({ min: 0, max: 200, noNaN: true }).map((mm) => (mm < 0.5 ? 0 : mm));
const extent: fc.Arbitrary<FileExtent> = fc
  .record({
    x: fc.integer({ min: -20, max: 20 }),
    y: fc.integer({ min: -20, max: 20 }),
    width: size,
    height: size,
  })
  .map(({ x, y, width, height }) => {
    const content = { x0: x, y0: y, x1: x + width, y1: y + height };
    return { widthMm: 100, heightMm: 100, content, onPage: content };
  });
const placed: fc.Arbitrary<Placed> = fc
  .record({
    extent,
    scale: fc.integer({ min: 1, max: 40 }),
    deg: fc.integer({ min: -179, max: 180 }),
    x: fc.integer({ min: -100, max: 400 }),
    y: fc.integer({ min: -100, max: 300 }),
    mirror: fc.constantFrom(1, -1),
  })
  .map(({ extent: of, scale, deg, x, y, mirror }) => ({
    extent: of,
    isCropped: false,
    map: compose(
      translation(x, y),
      compose(rotation((deg * Math.PI) / 180), scaling((mirror * scale) / 10, scale / 10)),
    ),
  }));

const near = (found: number, wanted: number): void => expect(Math.abs(found - wanted)).toBeLessThan(1e-6);
const sameMap = (a: Placed, b: Placed): void => {
  for (const key of ["a", "b", "c", "d", "e", "f"] as const) near(a.map[key], b.map[key]);
};

describe("a drawing's frame on the sheet", () => {
  it("leads back to where the drawing lies, also if it is mirrored, turned or only a line", () => {
    fc.assert(
      fc.property(placed, (one) => sameMap(inFrame(one, frameOf(one)), one)),
      RUNS,
    );
  });

  it("turns about its middle and keeps its size", () => {
    fc.assert(
      fc.property(placed, fc.integer({ min: -180, max: 180 }), (one, by) => {
        const before = frameOf(one);
        const { x0, y0, x1, y1 } = boxOf(one);
        const turn = mapAround((x0 + x1) / 2, (y0 + y1) / 2, rotation((by * Math.PI) / 180));
        const wanted = { ...one, map: compose(turn, one.map) };
        sameMap(inFrame(one, { ...before, turnDeg: before.turnDeg + by }), wanted);
      }),
      RUNS,
    );
  });

  it("is stored with digits enough for 0.1 µm on any sheet", () => {
    fc.assert(
      fc.property(placed, ({ map }) => {
        for (const [k, value] of matrixOf(map).entries())
          expect(Math.abs(value - [map.a, map.b, map.c, map.d, map.e, map.f][k])).toBeLessThan(1e-7);
      }),
      RUNS,
    );
  });
});

describe("arranging drawings", () => {
  it("aligns one axis and leaves the other", () => {
    fc.assert(
      fc.property(placed, fc.constantFrom(...ALIGNMENTS), (one, how) => {
        const before = boxOf(one);
        const after = boxOf(aligned(one, how, INSIDE));
        const isAcross = ["left", "centre", "right"].includes(how);
        near(isAcross ? after.y0 : after.x0, isAcross ? before.y0 : before.x0);
        const [low, high, from, to] = isAcross
          ? [INSIDE.x0, INSIDE.x1, after.x0, after.x1]
          : [INSIDE.y0, INSIDE.y1, after.y0, after.y1];
        if (["left", "top"].includes(how)) near(from, low);
        else if (["right", "bottom"].includes(how)) near(to, high);
        else near(from + to, low + high);
      }),
      RUNS,
    );
  });

  it("makes a grid of equal copies with the gap between them, in the middle of the margins", () => {
    const wish = fc.record({
      columns: fc.integer({ min: 1, max: 6 }),
      rows: fc.integer({ min: 1, max: 6 }),
      gapMm: fc.integer({ min: 0, max: 20 }),
      fills: fc.boolean(),
    });
    fc.assert(
      fc.property(placed, wish, (one, grid) => {
        const { columns, rows, gapMm, fills } = grid;
        const copies = gridOf(one, grid, INSIDE).map(boxOf);
        expect(copies).toHaveLength(columns * rows);
        const [first] = copies;
        const [width, height] = [first.x1 - first.x0, first.y1 - first.y0];
        copies.forEach((box, k) => {
          near(box.x0, first.x0 + (k % columns) * (width + gapMm));
          near(box.y0, first.y0 + Math.floor(k / columns) * (height + gapMm));
          near(box.x1 - box.x0, width);
        });
        const all = boxOfAll(gridOf(one, grid, INSIDE));
        near(all.x0 + all.x1, INSIDE.x0 + INSIDE.x1);
        near(all.y0 + all.y1, INSIDE.y0 + INSIDE.y1);
        if (fills && width + height > 0) {
          const [roomX, roomY] = [INSIDE.x1 - INSIDE.x0, INSIDE.y1 - INSIDE.y0];
          const spare = Math.min(roomX - (all.x1 - all.x0), roomY - (all.y1 - all.y0));
          near(spare, 0);
        } else if (!fills)
          sameMap({ ...one, map: { ...one.map, e: 0, f: 0 } }, noPlace(gridOf(one, grid, INSIDE)[0]));
      }),
      RUNS,
    );
  });

  it("fits all together and keeps how they lie to each other", () => {
    fc.assert(
      fc.property(fc.array(placed, { minLength: 1, maxLength: 4 }), (all) => {
        const before = boxOfAll(all);
        fc.pre(before.x1 - before.x0 > 1 && before.y1 - before.y0 > 1);
        const fitted = fittedInto(all, INSIDE);
        const after = boxOfAll(fitted);
        const factor = (after.x1 - after.x0) / (before.x1 - before.x0);
        near((after.y1 - after.y0) / (before.y1 - before.y0), factor);
        near(
          Math.min(
            INSIDE.x1 - INSIDE.x0 - (after.x1 - after.x0),
            INSIDE.y1 - INSIDE.y0 - (after.y1 - after.y0),
          ),
          0,
        );
        fitted.forEach((one, k) => near(boxOf(one).x0 - after.x0, factor * (boxOf(all[k]).x0 - before.x0)));
      }),
      RUNS,
    );
  });

  it("moves what leaves the paper back onto it if it fits, and nothing else", () => {
    const paper = { x0: 0, y0: 0, x1: 297, y1: 210 };
    fc.assert(
      fc.property(placed, (one) => {
        const before = boxOf(one);
        const after = boxOf(movedOnto(one, paper));
        if (before.x1 - before.x0 <= 297) {
          expect(after.x0).toBeGreaterThan(-1e-6);
          expect(after.x1).toBeLessThan(297 + 1e-6);
        } else near(after.x0, before.x0);
        if (before.x0 >= 0 && before.x1 <= 297) near(after.x0, before.x0);
      }),
      RUNS,
    );
  });

  it("adds files inside the margins without covering others while there is room", () => {
    const small = { widthMm: 50, heightMm: 40, content: { x0: 0, y0: 0, x1: 50, y1: 40 }, onPage: INSIDE };
    const all: Placed[] = [];
    for (let k = 0; k < 16; k++) all.push(asAdded(small, all, INSIDE));
    const boxes = all.map(boxOf);
    for (const [k, box] of boxes.entries()) {
      expect(box.x0).toBeGreaterThan(15 - 1e-6);
      expect(box.x1).toBeLessThan(282 + 1e-6);
      for (const other of boxes.slice(0, k)) {
        const covers = box.x0 < other.x1 && other.x0 < box.x1 && box.y0 < other.y1 && other.y0 < box.y1;
        expect(covers).toBe(false);
      }
    }
    const huge = { ...small, content: { x0: 0, y0: 0, x1: 5_000, y1: 100 } };
    const { x0, x1 } = boxOf(asAdded(huge, [], INSIDE));
    near(x0, 15);
    near(x1, 282);
  });
});

const noPlace = (one: Placed): Placed => ({ ...one, map: { ...one.map, e: 0, f: 0 } });
