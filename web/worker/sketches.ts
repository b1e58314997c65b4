/** Small pictures of a drawing with other settings, as polylines. */
import { prepare, type Drawing, type PrepareSettings } from "../../src/index.js";
import { hasFill, isEmptyBox, layOutDrawing, type Box } from "../../src/internal.js";
import type { Sketch } from "./protocol.js";

/** A larger drawing has none: that would take seconds, in which it could not be planned again. */
const MAX_COORDS = 200_000;
const MAX_SHAPES = 4_000;
/** A picture of more filled shapes would be too small to tell what becomes of each. */
const SHOWN_SHAPES = 10;
/** Deviation of the lines and distance of the hatches, as shares of the picture's side. */
const FLATTEN_SHARE = 1 / 300;
const HATCH_SHARE = 1 / 30;

/** The same part of the drawing for each change of the settings; none for a large drawing, or one without fills. */
export const sketchesOf = (
  drawing: Drawing,
  settings: PrepareSettings,
  changes: readonly Partial<PrepareSettings>[],
): Sketch[] => {
  if (drawing.paths.count > MAX_SHAPES || drawing.paths.coords.length > MAX_COORDS) return [];
  const box = partOf(drawing, settings);
  if (box === null) return [];
  const sideMm = Math.max(box.x1 - box.x0, box.y1 - box.y0);
  return changes.map((change) => {
    const wanted = { ...settings, ...change, ...COARSE, flattenMm: FLATTEN_SHARE * sideMm };
    const spacingMm = Math.max(wanted.hatch.spacingMm, HATCH_SHARE * sideMm);
    const hatch = wanted.hatch.spacingMm > 0 ? { ...wanted.hatch, spacingMm } : wanted.hatch;
    const { xy, offsets } = prepare(drawing, { ...wanted, hatch }).strokes;
    return { box, xy, offsets };
  });
};

/** What is not seen in a small picture, and takes time. */
const COARSE = { order: "none", spread: "none", joinMm: 0, dropRepeatsMm: 0, smoothRounds: 0 } as const;

/** A part of the drawing with a few filled shapes, around the one nearest to the middle. */
const partOf = (drawing: Drawing, settings: PrepareSettings): Box | null => {
  const { content, shapeBoxes } = layOutDrawing(drawing, settings);
  const { paths } = drawing;
  const filled = shapeBoxes().filter((box, shape) => hasFill(paths, shape) && !isEmptyBox(box));
  const sideOf = ({ x0, y0, x1, y1 }: Box): number => Math.max(x1 - x0, y1 - y0);
  const middleOf = ({ x0, y0, x1, y1 }: Box): readonly [number, number] => [(x0 + x1) / 2, (y0 + y1) / 2];
  const whole = sideOf(content);
  if (filled.length === 0 || !(whole > 0 && whole < Infinity)) return null;
  const [x, y] = middleOf(content);
  const awayOf = (box: Box): number => {
    const [boxX, boxY] = middleOf(box);
    return Math.hypot(boxX - x, boxY - y);
  };
  const nearest = filled.reduce((best, box) => (awayOf(box) < awayOf(best) ? box : best));
  const side = Math.min(
    whole,
    Math.max(1.5 * sideOf(nearest), whole * Math.sqrt(SHOWN_SHAPES / filled.length)),
  );
  const [cx, cy] = side < whole ? middleOf(nearest) : [x, y];
  return { x0: cx - side / 2, y0: cy - side / 2, x1: cx + side / 2, y1: cy + side / 2 };
};
