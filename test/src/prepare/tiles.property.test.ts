/** A drawing spread over several sheets: put together, they show the whole drawing, and the marks fit. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_PREPARE, prepare, PlotwrightError, type PrepareSettings } from "../../../src/index.js";
import {
  boxOfPoints,
  combine,
  compose,
  prepareJob,
  rotation,
  sheetSize,
  tilesOf,
  tileWindows,
  translation,
} from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { machineById } from "../../../src/index.js";
import { drawingOf } from "../../support/drawings/drawings.js";
import { cases } from "../../support/runs/full-run.js";

const RUNS = { numRuns: cases(500, 60) };

type Ends = readonly [x0: number, y0: number, x1: number, y1: number];

const tiling = fc.record({
  tileColumns: fc.integer({ min: 1, max: 4 }),
  tileRows: fc.integer({ min: 1, max: 3 }),
  tileOverlapMm: fc.integer({ min: 0, max: 30 }),
  marginMm: fc.integer({ min: 0, max: 30 }),
  landscape: fc.boolean(),
});
const point = fc.tuple(fc.integer({ min: 0, max: 500 }), fc.integer({ min: 0, max: 400 }));
const lines = fc.array(fc.tuple(point, point), { minLength: 1, maxLength: 8 });

const settingsOf = (given: Partial<PrepareSettings>): PrepareSettings => ({
  ...DEFAULT_PREPARE,
  fit: true,
  joinMm: 0,
  order: "none",
  tileMarks: false,
  ...given,
});
const drawn = (given: readonly (readonly [[number, number], [number, number]])[]) =>
  drawingOf(given.map(([[x0, y0], [x1, y1]]) => `M${x0} ${y0}L${x1} ${y1}`));

/** The segments of all strokes, without dots. */
const strokesOf = (...of: Parameters<typeof prepare>): Ends[] => {
  const { xy, offsets } = prepare(...of).strokes;
  const all: Ends[] = [];
  for (let i = 0; i + 1 < offsets.length; i++) {
    for (let p = offsets[i]; p + 1 < offsets[i + 1]; p++) {
      all.push([xy[2 * p], xy[2 * p + 1], xy[2 * p + 2], xy[2 * p + 3]]);
    }
  }
  return all.filter(([x0, y0, x1, y1]) => Math.hypot(x1 - x0, y1 - y0) > 1e-6);
};

const isBetween = ([x0, y0, x1, y1]: Ends, x: number, y: number): boolean => {
  const length = Math.hypot(x1 - x0, y1 - y0);
  const across = Math.abs((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) / length;
  const along = ((x1 - x0) * (x - x0) + (y1 - y0) * (y - y0)) / length;
  return across < 1e-6 && along > -1e-6 && along < length + 1e-6;
};

/** From the paper of each sheet to the poster. */
const toPoster = (settings: PrepareSettings, tile: number, [x0, y0, x1, y1]: Ends): Ends => {
  const window = tileWindows(settings)[tile - 1];
  const [dx, dy] = [window.x0 - settings.marginMm, window.y0 - settings.marginMm];
  return [x0 + dx, y0 + dy, x1 + dx, y1 + dy];
};

describe("the sheets of a tiled drawing", () => {
  it("show the whole drawing when they are put together, and nothing else", () => {
    fc.assert(
      fc.property(tiling, lines, (given, shapes) => {
        const settings = settingsOf(given);
        fc.pre(settings.tileColumns * settings.tileRows > 1);
        const drawing = drawn(shapes);
        const whole = strokesOf(drawing, settings);
        const parts = tilesOf(settings).flatMap((one) =>
          strokesOf(drawing, one).map((stroke) => toPoster(settings, one.tile, stroke)),
        );
        for (const part of parts) {
          const [x0, y0, x1, y1] = part;
          expect(whole.some((line) => isBetween(line, x0, y0) && isBetween(line, x1, y1))).toBe(true);
        }
        for (const [x0, y0, x1, y1] of whole) {
          for (let k = 0; k <= 50; k++) {
            const [x, y] = [x0 + ((x1 - x0) * k) / 50, y0 + ((y1 - y0) * k) / 50];
            expect(parts.some((part) => isBetween(part, x, y))).toBe(true);
          }
        }
      }),
      RUNS,
    );
  });

  it("lie inside the margins of their paper, and share the overlap with their neighbours", () => {
    fc.assert(
      fc.property(tiling, lines, (given, shapes) => {
        const settings = settingsOf(given);
        fc.pre(settings.tileColumns * settings.tileRows > 1);
        const { marginMm: m, tileOverlapMm, tileColumns } = settings;
        const [width, height] = settings.landscape ? [297, 210] : [210, 297];
        for (const one of tilesOf(settings)) {
          const { paperWidthMm, paperHeightMm } = prepare(drawn(shapes), one);
          expect([paperWidthMm, paperHeightMm]).toEqual([width, height]);
          for (const ends of strokesOf(drawn(shapes), one)) {
            for (const [k, mm] of ends.entries()) {
              expect(mm).toBeGreaterThan(m - 1e-6);
              expect(mm).toBeLessThan((k % 2 === 0 ? width : height) - m + 1e-6);
            }
          }
        }
        const windows = tileWindows(settings);
        windows.forEach((window, k) => {
          if ((k + 1) % tileColumns > 0) expect(window.x1 - windows[k + 1].x0).toBeCloseTo(tileOverlapMm, 9);
          const below = windows[k + tileColumns];
          if (below) expect(window.y1 - below.y0).toBeCloseTo(tileOverlapMm, 9);
        });
        const last = windows[windows.length - 1];
        expect(sheetSize(settings)).toEqual({ widthMm: last.x1, heightMm: last.y1 });
      }),
      RUNS,
    );
  });

  it("have their marks in the margins, on neighbours at the same places of the drawing", () => {
    fc.assert(
      fc.property(tiling, (given) => {
        const settings = settingsOf({ ...given, marginMm: given.marginMm + 3, tileMarks: true });
        fc.pre(settings.tileColumns * settings.tileRows > 1);
        // Without lines there are only marks.
        const dot = drawingOf(["M250 200L250 200"]);
        const [width, height] = settings.landscape ? [297, 210] : [210, 297];
        const { marginMm: m, tileColumns: columns, tileRows: rows } = settings;
        const places = new Map<string, number>();
        for (const one of tilesOf(settings)) {
          const marks = strokesOf(dot, one);
          const [column, row] = [(one.tile - 1) % columns, Math.floor((one.tile - 1) / columns)];
          const cuts =
            Number(column > 0) + Number(column < columns - 1) + Number(row > 0) + Number(row < rows - 1);
          expect(marks).toHaveLength(2 * cuts);
          for (const mark of marks) {
            const [x0, y0, x1, y1] = mark;
            const isInside =
              [x0, x1].every((x) => x > m && x < width - m) && [y0, y1].every((y) => y > m && y < height - m);
            expect(isInside).toBe(false);
            expect(Math.min(x0, x1, y0, y1)).toBeGreaterThan(0);
            expect(Math.max(x0, x1)).toBeLessThan(width);
            expect(Math.max(y0, y1)).toBeLessThan(height);
            const place = toPoster(settings, one.tile, mark)
              .map((mm) => mm.toFixed(4))
              .join(" ");
            places.set(place, (places.get(place) ?? 0) + 1);
          }
        }
        // Each mark is drawn on both sheets that meet there.
        expect([...places.values()].every((count) => count === 2)).toBe(true);
      }),
      RUNS,
    );
  });

  it("of several drawings that lie anywhere stay on their paper, or are refused with the choices that help", () => {
    const item = fc.record({
      source: fc.nat(1),
      xMm: fc.integer({ min: -60, max: 800 }),
      yMm: fc.integer({ min: -60, max: 600 }),
      turnDeg: fc.constantFrom(0, 30, 90),
    });
    const outside = fc.constantFrom("refuse" as const, "cut" as const, "move" as const, "fit" as const);
    const counts = { plotted: 0, refused: 0 };
    const run = (
      given: Parameters<typeof settingsOf>[0],
      shapes: Parameters<typeof drawn>[0],
      items: readonly { source: number; xMm: number; yMm: number; turnDeg: number }[],
      tileMarks: boolean,
    ): void => {
      const whole = settingsOf({ ...given, fit: "auto", tileMarks });
      fc.pre(whole.tileColumns * whole.tileRows > 1);
      const sources = [
        drawn(shapes),
        drawn([
          [
            [0, 0],
            [40, 25],
          ],
        ]),
      ].map((one, index) => ({
        drawing: one,
        name: "",
        layerPrefix: `${index}/`,
      }));
      const placed = items.map(({ source, xMm, yMm, turnDeg }) => ({
        source,
        map: compose(translation(xMm, yMm), rotation((turnDeg * Math.PI) / 180)),
      }));
      const sheet = combine(sources, placed, sheetSize(whole));
      for (const settings of tilesOf(whole)) {
        try {
          const { strokes, paperWidthMm, paperHeightMm } = prepareJob(
            sheet,
            { ...DEFAULT_PLOT_SETTINGS, prepare: settings },
            { ...machineById("axidraw-v3"), widthMm: 10_000, heightMm: 10_000 },
          ).prepared;
          counts.plotted++;
          const { x0, y0, x1, y1 } = boxOfPoints(strokes.xy);
          expect(Math.min(x0, y0)).toBeGreaterThan(-0.02);
          expect(Math.max(x1 - paperWidthMm, y1 - paperHeightMm)).toBeLessThan(0.51);
        } catch (error) {
          if (!(error instanceof PlotwrightError)) throw error;
          counts.refused++;
          expect(error.message).toMatch(/leaves the paper .* --outside|nothing|Nothing|no lines/);
        }
      }
    };
    fc.assert(
      fc.property(
        tiling.chain((given) => outside.map((mode) => ({ ...given, outside: mode }))),
        lines,
        fc.array(item, { minLength: 1, maxLength: 4 }),
        fc.boolean(),
        run,
      ),
      RUNS,
    );
    expect(Math.min(counts.plotted, counts.refused)).toBeGreaterThan(0);
  });

  it("hatch and hide as on the whole drawing, so that neighbours show the same where they overlap", () => {
    const square = drawingOf([{ d: "M0 0L200 0L200 150L0 150Z", stroke: null, fill: "#000000" }], {
      widthMm: 200,
      heightMm: 150,
    });
    const settings = settingsOf({
      tileColumns: 2,
      tileOverlapMm: 20,
      hatch: { spacingMm: 3.7, angleDeg: 30, cross: false },
      outlineFills: false,
    });
    const [left, right] = tileWindows(settings);
    const inOverlap = (tile: number): string[] =>
      strokesOf(square, { ...settings, tile })
        .map((ends) => toPoster(settings, tile, ends))
        .flatMap(([x0, y0, x1, y1]) => {
          const x = (right.x0 + left.x1) / 2;
          const at = (x - x0) / (x1 - x0);
          return at >= 0 && at < 1 ? [(y0 + at * (y1 - y0)).toFixed(4)] : [];
        })
        .sort();
    expect(inOverlap(1).length).toBeGreaterThan(10);
    expect(inOverlap(1)).toEqual(inOverlap(2));
  });
});

describe("what is asked of the sheets", () => {
  const drawing = drawingOf(["M0 0L100 100"]);
  const settings = settingsOf({ tileColumns: 2, tileRows: 2 });
  const faultOf = (work: () => unknown): PlotwrightError => {
    try {
      work();
    } catch (error) {
      return error as PlotwrightError;
    }
    throw new Error("it was accepted");
  };
  const job = (more: Partial<PrepareSettings>) =>
    prepareJob(
      drawing,
      { ...DEFAULT_PLOT_SETTINGS, prepare: { ...settings, ...more } },
      machineById("axidraw-v3"),
    );

  it("a job plots one of them: without a choice it is refused, with the choices", () => {
    expect(faultOf(() => job({})).message).toContain("1 to 4");
    expect(job({ tile: 3 }).prepared.strokes.offsets.length).toBeGreaterThan(1);
  });

  it("a sheet that does not exist and an overlap without room are refused with the figures", () => {
    expect(faultOf(() => prepare(drawing, { ...settings, tile: 5 })).message).toContain("no sheet 5");
    expect(faultOf(() => prepare(drawing, { ...settings, tileOverlapMm: 200 })).code).toBe("bad-setting");
  });

  it("a drawing beside the poster is refused on the sheet where it leaves it", () => {
    const outside = { fit: false, layout: { xMm: -20, yMm: 10, widthMm: 50, heightMm: null } } as const;
    expect(faultOf(() => job({ ...outside, tile: 1 })).code).toBe("out-of-bounds");
  });

  it("margins too narrow for marks are reported", () => {
    const { warnings } = prepare(drawing, { ...settings, tile: 1, tileMarks: true, marginMm: 2 });
    expect(warnings.join()).toContain("no room for the marks");
  });
});
