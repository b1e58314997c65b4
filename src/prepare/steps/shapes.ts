/** The steps of `prepare` while lines still belong to shapes: select, flatten, dash, crop, hatch. */
import {
  isBackground,
  type DashPattern,
  type Drawing,
  curvesOf,
  type DrawingPaths,
} from "../../drawing/drawing.js";
import {
  EMPTY_BOX,
  boxContains,
  boxesTouch,
  boxOfPoints,
  grownBox,
  intersectBoxes,
  isEmptyBox,
  type Box,
} from "../../geometry/box.js";
import { clipLinesToBox, cutLines } from "../../geometry/cut-line.js";
import {
  LineBuilder,
  filterLines,
  lineBox,
  lineCount,
  totalLength,
  type Lines,
} from "../../geometry/polyline.js";
import { regionOf, ringOf, type Region } from "../../geometry/region.js";
import { patternOnPaper } from "./dash.js";
import { hatchArea } from "./hatch.js";
import type { LayerTable } from "../layers/layers.js";
import { isFarAway, pageCorners, withTolerance, type Layout } from "../layout.js";
import { tileCount } from "../tiles.js";
import type { HatchSettings, PrepareSettings } from "../../settings/prepare.js";
import { stopIfCancelled, type Work } from "../work.js";
import { flattenVerbs, gapOf } from "../../drawing/flatten.js";
import type { Affine } from "../../geometry/affine.js";

/** The box to which lines are cropped; null if nothing is cropped. */
export function cropBox(settings: PrepareSettings, place: Layout): Box | null {
  const { clipToMargins, outside } = settings;
  // On a tiled drawing's poster the machine's reach differs for each sheet.
  const reach = tileCount(settings) === 1 ? settings.reach : null;
  const boxes = [
    ...(clipToMargins ? [place.inside] : []),
    ...(outside === "cut" ? [withTolerance(place.paper)] : []),
    ...(reach === null ? [] : [{ x0: 0, y0: 0, x1: reach.widthMm, y1: reach.heightMm }]),
  ];
  return boxes.length === 0 ? null : boxes.reduce(intersectBoxes);
}

/** What cuts lines off, for warnings. */
export const edgeName = ({ clipToMargins, outside }: PrepareSettings): string =>
  clipToMargins ? "the margins" : outside === "cut" ? "the paper" : "the machine's reach";

/** Marks the shapes to flatten: those that touch `limit` and are not extremely far away. */
export function shapesOnPaper(
  drawing: Drawing,
  place: Layout,
  limit: Box | null,
  edge: string,
  warnings: string[],
): Uint8Array {
  const wanted = new Uint8Array(drawing.paths.count);
  const within = limit === null || isFarAway(limit) ? EMPTY_BOX : limit;
  // Not true if a shape is empty, because `whole` is infinite then.
  if (boxContains(within, place.whole)) return wanted.fill(1);
  let outside = 0;
  let far = 0;
  place.shapeBoxes().forEach((box, shape) => {
    if (isEmptyBox(box)) return;
    if (isFarAway(box)) far++;
    else if (limit !== null && !boxesTouch(box, limit)) outside++;
    else wanted[shape] = 1;
  });
  if (far > 0) warnings.push(`${shapes(far)} much too far from the paper (over 1000 km) and not drawn.`);
  if (outside > 0) {
    warnings.push(
      `${shapes(outside)} entirely outside ${edge} and not drawn. Fit the drawing to the paper, or place it.`,
    );
  }
  return wanted;
}

const shapes = (count: number): string => (count === 1 ? "1 shape is" : `${count} shapes are`);

/**
 * Makes one line from each subpath of the shapes for which `wanted` is 1; its tag is the shape. A subpath of zero
 * length becomes a dot. A shape without a stroke is drawn as the outline of its fill: its subpaths are closed, and its
 * dots are dropped.
 */
export function flattenShapes(
  paths: DrawingPaths,
  map: Affine,
  toleranceMm: number,
  wanted: Uint8Array,
  work: Work,
): Lines {
  const builder = new LineBuilder();
  for (let shape = 0; shape < paths.count; shape++) {
    stopIfCancelled(work);
    if (wanted[shape] === 0) continue;
    const isArea = paths.stroke[shape] < 0;
    flattenVerbs(curvesOf(paths, shape), map, toleranceMm, isArea, builder, () => shape);
  }
  return builder.finish();
}

/** Max gap between the chords of `flattenShapes` and their curves, mm, by shape. */
export const gapsOfShapes = (paths: DrawingPaths, toleranceMm: number): Float64Array =>
  Float64Array.from({ length: paths.count }, (_, shape) => gapOf(curvesOf(paths, shape), toleranceMm));

/** 100 m around home. */
const ANYWHERE: Box = { x0: -1e5, y0: -1e5, x1: 1e5, y1: 1e5 };
const BESIDE_PAPER_MM = 1_000;

/**
 * The area for dashes and hatches. A drawing that leaves the paper is not plotted unless that is allowed, so it needs
 * only so many of them there that this is noticed.
 */
export const areaOfHatches = ({ outside }: PrepareSettings, { paper }: Layout, limit: Box | null): Box =>
  limit ?? (outside === "allow" ? ANYWHERE : grownBox(paper, BESIDE_PAPER_MM));

/** The dash pattern of each shape on the paper; null for solid lines. */
export function dashesOf(drawing: Drawing, place: Layout): (shape: number) => DashPattern | null {
  const patterns = drawing.dashes.map((pattern) => patternOnPaper(pattern, place.map));
  return (shape) => {
    const dash = drawing.paths.dash[shape];
    return dash >= 0 && drawing.paths.stroke[shape] >= 0 ? patterns[dash] : null;
  };
}

/** The lines that will be dashed and leave `limit`. No dashes are made outside, so only these lines tell the loss. */
export const dashedAcross = (
  lines: Lines,
  dashOf: (shape: number) => DashPattern | null,
  limit: Box | null,
): Lines =>
  filterLines(
    lines,
    (i) => limit !== null && dashOf(lines.tag[i]) !== null && !boxContains(limit, lineBox(lines, i)),
  );

/** If the margins cut off no more than this, it is rounding and causes no warning, mm. */
const UNNOTICED_CROP = 0.1;

/** `dashed`: the lines of `dashedAcross`, which count as cut off too. */
export function cropLines(
  lines: Lines,
  dashed: Lines,
  limit: Box | null,
  edge: string,
  warnings: string[],
): Lines {
  if (limit === null) return lines;
  const kept = boxContains(limit, boxOfPoints(lines.xy)) ? lines : clipLinesToBox(lines, limit);
  const lost =
    totalLength(lines) - totalLength(kept) + totalLength(dashed) - totalLength(clipLinesToBox(dashed, limit));
  if (lost > UNNOTICED_CROP) {
    warnings.push(
      `${Math.ceil(lost)} mm of line lie outside ${edge} and are cut off. Fit the drawing to the paper or make it smaller.`,
    );
  }
  return kept;
}

/** Whether `limit` cuts off more than rounding of any of the areas for which `counts`. */
export function cutsAreas(
  areas: ReadonlyMap<number, Region>,
  limit: Box,
  counts: (shape: number) => boolean,
): boolean {
  const widened = grownBox(limit, UNNOTICED_CROP);
  return [...areas].some(([shape, { box }]) => counts(shape) && !boxContains(widened, box));
}

/** Crops to the file's own page, which may be rotated. */
export function cropToPage(lines: Lines, drawing: Drawing, place: Layout, warnings: string[]): Lines {
  const corners = pageCorners(drawing, place.map);
  const page = regionOf([ringOf(corners)]);
  // Most drawings are within their page. Check that first, because cutting a large drawing by a region is slow.
  const [x0, y0, x1, y1] = corners;
  const isUpright = Math.min(Math.abs(x1 - x0), Math.abs(y1 - y0)) < 1e-6;
  if (isUpright && boxContains(boxOfPoints(corners), boxOfPoints(lines.xy))) return lines;
  const kept = cutLines(lines, page);
  const lost = totalLength(lines) - totalLength(kept);
  if (lost > UNNOTICED_CROP)
    warnings.push(`${Math.ceil(lost)} mm of line lie outside the file's page and are cut off.`);
  return kept;
}

/** Removes the outlines of the page's background. */
export const withoutBackgrounds = (lines: Lines, { paths }: Drawing): Lines =>
  paths.background === undefined ? lines : filterLines(lines, (i) => !isBackground(paths, lines.tag[i]));

/** Removes the outlines of shapes without a stroke. */
export const strokedOnly = (lines: Lines, drawing: Drawing): Lines =>
  filterLines(lines, (i) => drawing.paths.stroke[lines.tag[i]] >= 0);

/** The hatch of each layer; null if no layer has one. */
export function hatchesOf(settings: PrepareSettings, table: LayerTable): HatchSettings[] | null {
  const own = new Map(settings.layerHatches.map((hatch) => [hatch.layer, hatch]));
  const hatches = table.layers.map((layer) => own.get(layer.id) ?? settings.hatch);
  return hatches.some((hatch) => hatch.spacingMm > 0) ? hatches : null;
}

/** Adds the hatch of each filled shape before its outline, in paint order. */
export function addHatch(
  lines: Lines,
  areas: ReadonlyMap<number, Region>,
  hatchOf: (shape: number) => HatchSettings,
  work: Work,
): Lines {
  const builder = new LineBuilder();
  let at = 0;
  const copyBelow = (shape: number): void => {
    for (; at < lineCount(lines) && lines.tag[at] < shape; at++) builder.copy(lines, at, lines.tag[at]);
  };
  for (const [shape, area] of areas) {
    stopIfCancelled(work);
    copyBelow(shape);
    hatchArea(area, hatchOf(shape), shape, builder);
  }
  copyBelow(Infinity);
  return builder.finish();
}
