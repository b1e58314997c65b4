/**
 * Finds the shapes that only colour the paper. Many programs write a filled rectangle as the page's background. Drawn with
 * a pen it would be a frame that is not visible on screen.
 *
 * A filled shape without a stroke is background if
 *   - it covers the page, in any colour, or
 *   - it is white, or nearly so, and lies on nothing but white background.
 * If the file has nothing else, nothing is background.
 */
import { FillRule, type Paths64 } from "clipper2-ts/dist/Core.js";
import Flatbush from "flatbush";
import { curveBoxOf } from "../../drawing/curve-box.js";
import { curvesOf, RULE_EVENODD, type Drawing } from "../../drawing/drawing.js";
import { flattenVerbs, ringsOfClip } from "../../drawing/flatten.js";
import { IDENTITY } from "../../geometry/affine.js";
import {
  boxContains,
  grownBox,
  insideRange,
  intersectBoxes,
  isEmptyBox,
  type Box,
} from "../../geometry/box.js";
import { LineBuilder, lineCount } from "../../geometry/polyline.js";
import { cleanRings, regionContains, regionOf, ringOfLine, SCALE } from "../../geometry/region.js";
import { isNearWhite } from "../color.js";
import { getOrAdd } from "../../get-or-add.js";

/** A shape covers the page if it leaves no more than this free at its edges, as a share of the shorter side. */
const FREE_EDGE = 0.01;
/** Shapes side by side may overlap by this much, mm. */
const OVERLAP_MM = 0.01;

type Shapes = Omit<Drawing, "warnings">;

/** 1 for each shape that is background; null if there is none. */
export function backgroundsOf(drawing: Shapes): Uint8Array | null {
  const { paths, colors } = drawing;
  const isFilledOnly = (shape: number): boolean => paths.stroke[shape] < 0 && paths.fill[shape] >= 0;
  const isWhite = colors.map(isNearWhite);
  const covers = pageCovers(drawing);
  const background = new Uint8Array(paths.count);
  let count = 0;
  let isPaperWhite = true;
  let liesOnNothing: ((shape: number) => boolean) | null = null;
  for (let shape = 0; shape < paths.count; shape++) {
    if (!isFilledOnly(shape)) continue;
    const isWhiteShape = isWhite[paths.fill[shape]];
    if (covers(shape)) {
      isPaperWhite &&= isWhiteShape;
    } else {
      if (!isPaperWhite || !isWhiteShape) continue;
      liesOnNothing ??= onNothing(drawing, background);
      if (!liesOnNothing(shape)) continue;
    }
    background[shape] = 1;
    count++;
  }
  return count > 0 && count < paths.count ? background : null;
}

/** Tells whether a shape, cut to its clips, covers the page. */
function pageCovers(drawing: Shapes): (shape: number) => boolean {
  const { widthMm, heightMm, paths, clips } = drawing;
  const freeMm = FREE_EDGE * Math.min(widthMm, heightMm);
  const inner = grownBox({ x0: 0, y0: 0, x1: widthMm, y1: heightMm }, -freeMm);
  const tolerance = freeMm / 4;
  const clipCovers = new Map<number, boolean>();
  const isOpen = (clip: number): boolean =>
    getOrAdd(clipCovers, clip, () => coversBox(ringsOfClip(clips[clip], IDENTITY, tolerance), inner));
  return (shape) => {
    const curves = curvesOf(paths, shape);
    if (!boxContains(curveBoxOf(curves, IDENTITY), inner)) return false;
    for (let clip = paths.clip[shape]; clip >= 0; clip = clips[clip].parent) if (!isOpen(clip)) return false;
    const builder = new LineBuilder();
    flattenVerbs(curves, IDENTITY, tolerance, true, builder, () => shape);
    const lines = builder.finish();
    const rings = Array.from({ length: lineCount(lines) }, (_, i) => ringOfLine(lines, i));
    const rule = paths.fillRule[shape] === RULE_EVENODD ? FillRule.EvenOdd : FillRule.NonZero;
    return coversBox(cleanRings(rings, rule), inner);
  };
}

/** Whether no edge runs through the box, and its middle is inside. */
function coversBox(rings: Paths64, box: Box): boolean {
  const isFree = rings.every((ring) =>
    ring.every((p, k) => {
      const q = ring[(k + 1) % ring.length];
      return insideRange(p.x / SCALE, p.y / SCALE, q.x / SCALE, q.y / SCALE, box) === null;
    }),
  );
  return isFree && regionContains(regionOf(rings), (box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2);
}

/**
 * Tells whether nothing but background is painted before a shape, where it lies. Compares boxes, so a shape is drawn in
 * case of doubt. `background` is known for the shapes before.
 */
function onNothing(drawing: Shapes, background: Uint8Array): (shape: number) => boolean {
  const boxes = visibleBoxes(drawing);
  const painted = Array.from(boxes.keys()).filter((shape) => !isEmptyBox(boxes[shape]));
  const tree = new Flatbush(Math.max(painted.length, 1));
  if (painted.length === 0) tree.add(0, 0, 0, 0);
  for (const shape of painted) tree.add(boxes[shape].x0, boxes[shape].y0, boxes[shape].x1, boxes[shape].y1);
  tree.finish();
  return (shape) => {
    const { x0, y0, x1, y1 } = grownBox(boxes[shape], -OVERLAP_MM);
    const isBelow = (k: number): boolean => painted[k] < shape && background[painted[k]] === 0;
    return tree.search(x0, y0, x1, y1, isBelow).length === 0;
  };
}

/** The box of each shape, cut to those of its clips. */
function visibleBoxes({ paths, clips }: Shapes): Box[] {
  const clipBoxes = clips.map((clip) => curveBoxOf(clip, IDENTITY));
  return Array.from({ length: paths.count }, (_, shape) => {
    let box = curveBoxOf(curvesOf(paths, shape), IDENTITY);
    for (let clip = paths.clip[shape]; clip >= 0; clip = clips[clip].parent)
      box = intersectBoxes(box, clipBoxes[clip]);
    return box;
  });
}
