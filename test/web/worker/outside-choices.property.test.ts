/** What the page offers for lines that leave the paper helps, for any drawing, alone or on a sheet, on any paper. */
import fc from "fast-check";
import { expect, it } from "vitest";
import {
  combine,
  layOutDrawing,
  machineOf,
  sheetSize,
  type SheetItem,
  type SheetSource,
} from "../../../src/internal.js";
import { prepare, type Drawing } from "../../../src/index.js";
import { checkBounds } from "../../../src/prepare/on-paper.js";
import { boxOfPoints } from "../../../src/geometry/box.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../src/schema/index.js";
import {
  compose,
  IDENTITY,
  mapAround,
  rotation,
  scaling,
  translation,
} from "../../../src/geometry/affine.js";
import { fittedTo, movedBack } from "../../../web/drawing/outside-paper.js";
import { fittedInto, movedOnto, type Placed } from "../../../web/scene/arrange.js";
import { roomOf } from "../../../web/state/sheet-edits.js";
import { sheetSettings } from "../../../web/state/sheet-settings.js";
import { extentOf, outsideChoices } from "../../../web/worker/outside-choices.js";
import { drawingOf } from "../../support/drawings/drawings.js";
import { cases } from "../../support/runs/full-run.js";

type Prepare = PlotSettings["prepare"];

const mm = fc.integer({ min: -80, max: 380 });
const drawing = fc
  .record({
    lines: fc.array(fc.tuple(mm, mm, mm, mm), { minLength: 1, maxLength: 4 }),
    widthMm: fc.constantFrom(50, 148, 210, 297),
    heightMm: fc.constantFrom(50, 148, 210, 297),
  })
  .map(({ lines, widthMm, heightMm }) =>
    drawingOf(
      lines.map(([x, y, u, v], index) => ({ d: `M${x} ${y}L${u} ${v}`, group: index % 2 })),
      { widthMm, heightMm, groups: ["a", "b"] },
    ),
  );

const paperOf = fc.record({
  paper: fc.constantFrom(
    { widthMm: 210, heightMm: 297 },
    { widthMm: 148, heightMm: 210 },
    { widthMm: 60, heightMm: 400 },
  ),
  landscape: fc.boolean(),
  marginMm: fc.constantFrom(0, 15),
  hiddenLayers: fc.constantFrom([], ["g1"]),
  tileColumns: fc.constantFrom(1, 1, 2),
  tile: fc.constant(0),
});
const placing = fc.record({
  fit: fc.constantFrom("auto" as const, false),
  rotateDeg: fc.constantFrom("auto" as const, 0, 90, 33),
  outside: fc.constantFrom("refuse" as const, "move" as const),
  layout: fc.option(
    fc.record({
      xMm: fc.integer({ min: -50, max: 200 }),
      yMm: fc.integer({ min: -50, max: 200 }),
      widthMm: fc.option(fc.integer({ min: 5, max: 300 })),
      heightMm: fc.constant(null),
      turnDeg: fc.constantFrom(0, 30),
    }),
    { nil: null },
  ),
});

const settingsOf = (some: Partial<Prepare>): PlotSettings => ({
  ...DEFAULT_PLOT_SETTINGS,
  prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, ...some },
});

const EDGES = ["leftMm", "topMm", "rightMm", "bottomMm"] as const;
/** How much the strip over the paper says. */
const saidOf = (from: Drawing, prepareSettings: Prepare): readonly number[] => {
  const { outside } = prepare(from, prepareSettings);
  return outside === null ? [0] : [outside.strokeCount, ...EDGES.map((edge) => outside[edge])];
};
const isLess = (after: readonly number[], before: readonly number[]): boolean =>
  after[0] === 0 || after.some((said, index) => said < before[index] - 0.05);

it("a drawing alone: each choice puts it on the paper, or lets the machine draw it, and leaves something", () => {
  const offered = { turn: 0, canCut: 0, canMove: 0, canAllow: 0 };
  const kept = { canCut: 0, canMove: 0, canAllow: 0 };
  fc.assert(
    fc.property(drawing, paperOf, placing, (from, paper, place) => {
      const settings = settingsOf({ ...paper, ...place });
      const before = prepare(from, settings.prepare);
      const { outside } = before;
      if (!outside) return;
      const { choice } = layOutDrawing(from, settings.prepare);
      const drawnBox = boxOfPoints(before.strokes.xy);
      const choices = outsideChoices({ drawing: from, settings, outside, drawnBox, sheet: null });
      const with_ = (change: Partial<Prepare>) => prepare(from, { ...settings.prepare, ...change });
      const planned = { settings, choice };
      expect(with_(fittedTo(planned)).outside).toBeNull();
      if (choices.turn) {
        offered.turn++;
        expect(with_(choices.turn).outside).toBeNull();
      }
      if (choices.canMove) {
        offered.canMove++;
        expect(with_(movedBack(planned, outside)).outside).toBeNull();
      } else kept.canMove++;
      const cut = with_({ outside: "cut" });
      expect(cut.outside).toBeNull();
      expect(cut.strokes.layer.length > 0).toBe(choices.canCut);
      if (choices.canCut) offered.canCut++;
      else kept.canCut++;
      const draw = (): void => checkBounds(with_({ outside: "allow" }).strokes, machineOf(settings));
      if (choices.canAllow) {
        offered.canAllow++;
        draw();
      } else {
        kept.canAllow++;
        expect(draw).toThrow("can only go from (0, 0)");
      }
    }),
    { numRuns: cases(2_000, 300) },
  );
  expect(Math.min(...Object.values(offered), ...Object.values(kept))).toBeGreaterThan(0);
});

it("several drawings on a sheet: moving them back is offered where less leaves the paper then, and always if nothing does", () => {
  const counts = { offered: 0, kept: 0 };
  const item = fc.record({
    source: fc.nat(1),
    x: fc.integer({ min: -150, max: 250 }),
    y: fc.integer({ min: -150, max: 250 }),
    turnDeg: fc.constantFrom(0, 90, 40),
    scale: fc.constantFrom(0.3, 0.6, 1),
    isCropped: fc.boolean(),
  });
  fc.assert(
    fc.property(
      fc.tuple(drawing, drawing),
      fc.array(item, { minLength: 1, maxLength: 4 }),
      paperOf,
      (drawings, wanted, paper) => {
        const settings = sheetSettings(settingsOf({ ...paper, hiddenLayers: [] }));
        const sources: SheetSource[] = drawings.map((one, index) => ({
          drawing: one,
          name: "",
          layerPrefix: index === 0 ? "" : "2/",
        }));
        const items: (SheetItem & Placed)[] = wanted.map(({ source, x, y, turnDeg, scale, isCropped }) => ({
          source,
          isCropped,
          extent: extentOf(drawings[source]),
          map: compose(
            translation(x, y),
            mapAround(100, 100, compose(rotation((turnDeg * Math.PI) / 180), scaling(scale))),
          ),
        }));
        const sheetWith = (all: readonly (SheetItem & Placed)[]): Drawing =>
          combine(sources, all, sheetSize(settings.prepare));
        const from = sheetWith(items);
        const before = prepare(from, settings.prepare);
        if (!before.outside) return;
        const drawnBox = boxOfPoints(before.strokes.xy);
        const sheet = { sources, items, map: IDENTITY };
        const { outside } = before;
        const { turn, canMove } = outsideChoices({ drawing: from, settings, outside, drawnBox, sheet });
        expect(turn).toBeNull();
        const said = saidOf(from, settings.prepare);
        const { paper: room, inside } = roomOf(settings);
        const movedOn = sheetWith(items.map((one) => movedOnto(one, room)));
        const after = saidOf(movedOn, settings.prepare);
        if (canMove) expect(isLess(after, said)).toBe(true);
        // Lines of a drawing that stays off the paper are not counted.
        else expect(after[0]).toBeGreaterThan(0);
        counts[canMove ? "offered" : "kept"]++;
        const fitted = sheetWith(fittedInto(items, inside));
        expect(saidOf(fitted, settings.prepare)).toEqual([0]);
      },
    ),
    { numRuns: cases(2_000, 300) },
  );
  expect(Math.min(counts.offered, counts.kept)).toBeGreaterThan(0);
});
