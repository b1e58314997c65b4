/**
 * Converts the file's drawing to pen strokes, by the steps below.
 *
 * Until lines are sorted by layer, the tag of a line is its shape; after that, its part of a layer (layers.ts).
 * Hidden layers are processed until they are counted, so that the page can show their figures, and then dropped. They
 * hide nothing, and nothing hides them.
 */
import { isBackground, type Drawing } from "../drawing/drawing.js";
import { withPxPerInch } from "../drawing/px-size.js";
import { drawingOfLines, setFor, type Line, type StrokeSet } from "../drawing/stroke-set.js";
import { clipLinesToBox } from "../geometry/cut-line.js";
import { lineCount, totalLength, type Lines } from "../geometry/polyline.js";
import { cropAreas, filledAreas, filledOnly } from "./steps/areas.js";
import {
  sortedByLayer,
  countLayers,
  dropShort,
  emptyWarning,
  partOfTag,
  strokeSetOf,
  visibleOnly,
  type PreparedLayer,
} from "./assemble.js";
import { checkObject } from "../check-arguments.js";
import { clipRegions, clipLines } from "./steps/clips.js";
import { completeSettings } from "./complete-settings.js";
import { dashLines } from "./steps/dash.js";
import {
  flattenShapes,
  gapsOfShapes,
  addHatch,
  areaOfHatches,
  cropBox,
  cropLines,
  cropToPage,
  cutsAreas,
  dashedAcross,
  dashesOf,
  edgeName,
  hatchesOf,
  shapesOnPaper,
  strokedOnly,
  withoutBackgrounds,
} from "./steps/shapes.js";
import { hideCovered } from "./steps/hidden-lines.js";
import { joinInFileOrder, joinLines } from "./steps/join.js";
import { inOrder, layersOf, visibleLayers, speedPartsOf, type SpeedParts } from "./layers/layers.js";
import { inDrawingOrder } from "./order/order.js";
import { drawnSizeOf, outsidePaper, type DrawnSize, type OutsidePaper } from "./on-paper.js";
import { layOutDrawing } from "./layout.js";
import { moved, sheetSize, tileOf, withMarks, type TileOnPaper } from "./tiles.js";
import { dropRepeats } from "./steps/repeats.js";
import type { PrepareSettings } from "../settings/prepare.js";
import { simplifyLines, reloopLines, smoothLines } from "./steps/points.js";
import { stopIfCancelled, type Work } from "./work.js";

/** The result of `prepare`: the strokes and figures about them. */
export interface Prepared {
  /** The strokes, in drawing order. */
  readonly strokes: StrokeSet;
  /** All layers, including hidden ones, in drawing order. The layer mode decides what a layer is. */
  readonly layers: readonly PreparedLayer[];
  /** The paper after `landscape` is applied. */
  readonly paperWidthMm: number;
  readonly paperHeightMm: number;
  /** The drawing's size on the paper, and its scale. */
  readonly size: DrawnSize;
  /** Strokes that leave the paper; null if there are none, or none that are drawn. */
  readonly outside: OutsidePaper | null;
  /** Distance with the pen up from home through all strokes and back home, in the file's order. */
  readonly travelMmUnordered: number;
  /** The same in drawing order. */
  readonly travelMm: number;
  /** Distance with the pen down. */
  readonly drawMm: number;
  /** Warnings about lines left out with this paper and these settings. The drawing's own warnings are not repeated. */
  readonly warnings: readonly string[];
}

/**
 * Places the drawing on the paper and turns it into strokes in drawing order (mm in the machine frame).
 *
 * @param imported a drawing, or lines: their points are mm on the paper, and they are joined and ordered like a drawing's
 * @param changes the settings that differ from `DEFAULT_PREPARE`
 * @throws PlotwrightError "bad-setting" for a wrong setting, or if the margins leave no room; "cancelled"
 */
export function prepare(
  imported: Drawing | readonly Line[],
  changes: Partial<PrepareSettings> = {},
  options: Work = {},
): Prepared {
  const settings = completeSettings(changes);
  const drawing = drawingFrom(imported, settings);
  const progress = (done: number, step: string): void => {
    stopIfCancelled(options);
    options.onProgress?.(done, step);
  };
  const warnings: string[] = [];

  progress(0, "placing");
  const place = layOutDrawing(drawing, settings);
  const tile = tileOf(settings);
  const limit = cropBox(settings, place);
  const edge = edgeName(settings);
  const area = areaOfHatches(settings, place, limit);
  const table = inOrder(layersOf(drawing, settings.layers), settings.layerOrder);
  const isVisible = visibleLayers(table, settings);
  const wanted = shapesOnPaper(drawing, place, limit, edge, warnings);

  progress(0.05, "flattening");
  const subpaths = flattenShapes(drawing.paths, place.map, settings.flattenMm, wanted, options);
  const gaps = gapsOfShapes(drawing.paths, settings.flattenMm);
  const clipOf = clipRegions(drawing, place.map, settings.flattenMm);
  const dashOf = dashesOf(drawing, place);
  let lines = drawing.dashes.length > 0 ? dashLines(subpaths, dashOf, area) : subpaths;
  lines = withoutBackgrounds(lines, drawing);
  if (!settings.outlineFills) lines = strokedOnly(lines, drawing);

  progress(0.15, "cutting");
  let dashed = dashedAcross(subpaths, dashOf, limit);
  if (drawing.clips.length > 0) {
    lines = clipLines(lines, drawing, clipOf, gaps, options);
    dashed = clipLines(dashed, drawing, clipOf, gaps, options);
  }
  lines = cropLines(lines, dashed, limit, edge, warnings);
  if (settings.cropToPage) lines = cropToPage(lines, drawing, place, warnings);

  progress(0.25, "filling");
  const hatches = hatchesOf(settings, table);
  if (hatches !== null || settings.hideCovered) {
    const whole = filledAreas(subpaths, drawing, clipOf, gaps, settings.hatchOutlines, options);
    const areas = cropAreas(whole, area);
    // If the outline is drawn too, the warning about its lines is enough.
    const isHatchOnly = (shape: number): boolean =>
      !settings.outlineFills &&
      drawing.paths.stroke[shape] < 0 &&
      (hatches?.[table.ofShape[shape]].spacingMm ?? 0) > 0;
    if (limit !== null && cutsAreas(whole, limit, isHatchOnly)) warnings.push(cutHatch(edge));
    if (hatches !== null) {
      const toHatch = new Map([...areas].filter(([shape]) => !isBackground(drawing.paths, shape)));
      if (toHatch.size === 0) warnings.push(nothingToFill(settings.hatchOutlines));
      lines = addHatch(lines, toHatch, (shape) => hatches[table.ofShape[shape]], options);
    }
    if (settings.cropToPage && hatches !== null) lines = cropToPage(lines, drawing, place, warnings);
    if (settings.hideCovered)
      lines = hideCovered(
        lines,
        filledOnly(areas, drawing),
        (shape) => isVisible[table.ofShape[shape]],
        gaps,
        options,
      );
  }

  progress(0.45, "joining");
  const parts = speedPartsOf(drawing, table);
  const partOf = partOfTag(drawing);
  lines = sortedByLayer(lines, parts, drawing);
  lines = dropRepeats(lines, settings.dropRepeatsMm, partOf, options);
  if (settings.joinMm > 0) {
    lines =
      settings.order === "none"
        ? joinInFileOrder(lines, settings.joinMm)
        : joinLines(lines, settings.joinMm, partOf);
  }
  lines = { ...lines, tag: lines.tag.map(partOf) };
  lines = dropShort(lines, settings.dropShorterMm);
  lines = simplifyLines(lines, settings.simplifyMm);
  lines = smoothLines(lines, settings.smoothRounds);
  if (settings.reloop) lines = reloopLines(lines);
  // Cut last, so that neighbouring sheets show the same lines where they overlap.
  if (tile) lines = clipLinesToBox(lines, tile.window);

  progress(0.55, "ordering");
  const layers = countLayers(lines, table, parts, isVisible);
  lines = visibleOnly(lines, parts, isVisible);
  if (lineCount(lines) === 0) warnings.push(emptyWarning(drawing, isVisible));
  // On the poster, before it has marks.
  const outside = tile && outsidePaper(lines, place);
  if (tile) lines = onTile(lines, tile, parts, isVisible);
  if (tile?.lacksMarks) warnings.push(NO_ROOM_FOR_MARKS);
  const passesOf = (part: number): number =>
    setFor(settings.layerRepeats, table.layers[parts.layer[part]].id) ?? 1;
  const ordered = inDrawingOrder(lines, passesOf, settings, within(options, 0.55, 0.98));
  const strokes = strokeSetOf(
    ordered.lines,
    parts,
    table.layers,
    isVisible,
    settings.reinkMm,
    settings.layerShifts,
  );

  progress(1, "done");
  return {
    strokes,
    layers,
    paperWidthMm: (tile ?? place).paper.x1,
    paperHeightMm: (tile ?? place).paper.y1,
    size: drawnSizeOf(ordered.lines, place, settings.rotateDeg !== "auto"),
    outside: tile ? outside : outsidePaper(ordered.lines, place),
    travelMmUnordered: ordered.travelMmUnordered,
    travelMm: ordered.travelMm,
    drawMm: totalLength(ordered.lines),
    warnings,
  };
}

/** The lines of a sheet where they lie on its paper, with marks drawn by the first pen. */
function onTile(
  lines: Lines,
  tile: TileOnPaper,
  { layer, count }: SpeedParts,
  isVisible: readonly boolean[],
): Lines {
  const parts = Array.from({ length: count }, (_, part) => part);
  const first = lineCount(lines) > 0 ? lines.tag[0] : parts.find((part) => isVisible[layer[part]]);
  return moved(first === undefined ? lines : withMarks(lines, tile.marks, first), tile.move);
}

const NO_ROOM_FOR_MARKS =
  "The margins have no room for the marks of the sheets: make them at least 3 mm wide, or switch off --tile-marks.";

const cutHatch = (edge: string): string =>
  `Areas filled with lines lie partly outside ${edge} and are cut off. Fit the drawing to the paper or make it smaller.`;

const nothingToFill = (withOutlines: boolean): string =>
  withOutlines
    ? "There is nothing to fill with lines: no filled shape and no closed line."
    : "There is nothing to fill with lines: no shape of this drawing is filled. Use --hatch-outlines, or give shapes a fill.";

/** The same work, with its progress mapped to a part of the whole. */
const within = (work: Work, from: number, to: number): Work => ({
  ...work,
  onProgress: work.onProgress && ((done, step) => work.onProgress?.(from + done * (to - from), step)),
});

function drawingFrom(imported: Drawing | readonly Line[], settings: PrepareSettings): Drawing {
  if (isLines(imported)) return drawingOfLines(imported, sheetSize(settings));
  checkObject(
    "prepare",
    "the drawing",
    imported,
    ["paths", "groups"],
    "what importSvg or importDrawing returns, or a list of lines",
  );
  return withPxPerInch(imported, settings.pxPerInch);
}

const isLines = (imported: Drawing | readonly Line[]): imported is readonly Line[] => Array.isArray(imported);
