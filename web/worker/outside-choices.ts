/** What can be done about strokes that leave the paper. Only what helps is offered. */
import {
  boxOfPoints,
  combine,
  compose,
  cutOffLines,
  isReached,
  layOutDrawing,
  machineOf,
  prepareSettingsOf,
  sheetOf,
  sheetSize,
  turnedOntoPaper,
  uniteBoxes,
  type Affine,
  type Box,
  type OutsidePaper,
  type SheetItem,
  type SheetSource,
} from "../../src/internal.js";
import { DEFAULT_PREPARE, type Drawing } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { movedOnto, type FileExtent } from "../scene/arrange.js";

export interface OutsideChoices {
  /** The settings that turn the drawing, or the paper, so that all of it is on the paper; null: a turn does not help. */
  readonly turn: Partial<PlotSettings["prepare"]> | null;
  /** A part is left if the rest is cut off. */
  readonly canCut: boolean;
  readonly canMove: boolean;
  /** The machine reaches all of it. */
  readonly canAllow: boolean;
}

interface Outside {
  readonly drawing: Drawing;
  readonly settings: PlotSettings;
  readonly outside: OutsidePaper;
  /** The box of all lines that the pen draws. */
  readonly drawnBox: Box;
  /** The drawings of a sheet that has several, as they lie on the paper. */
  readonly sheet: {
    readonly sources: readonly SheetSource[];
    readonly items: readonly SheetItem[];
    readonly map: Affine;
  } | null;
}

export function outsideChoices({ drawing, settings, outside, drawnBox, sheet }: Outside): OutsideChoices {
  const machine = machineOf(settings);
  return {
    // Of a sheet each drawing has its own place.
    turn: sheet === null ? turnedOntoPaper(drawing, prepareSettingsOf(settings), machine) : null,
    canCut: outside.canCut,
    canMove: sheet === null ? outside.canMove : doesMovingHelp(sheet, settings),
    canAllow: isReached(drawnBox, machine),
  };
}

/** Whether less is off the paper after each drawing that fits on it was moved onto it. */
function doesMovingHelp(
  { sources, items, map }: NonNullable<Outside["sheet"]>,
  settings: PlotSettings,
): boolean {
  const wanted = prepareSettingsOf(settings);
  const { paper } = sheetOf(wanted);
  // Each drawing alone, where it lies.
  const alone = {
    ...wanted,
    ...({ fit: false, rotateDeg: 0, mirror: "none", layout: null, outside: "cut" } as const),
    clipToMargins: false,
    reach: null,
  };
  const before: Box[] = [];
  const after: Box[] = [];
  for (const item of items) {
    const own = { ...item, source: 0, map: compose(map, item.map) };
    const source = sources[item.source];
    const one = combine([source], [own], sheetSize(wanted));
    const beside = cutOffLines(one, alone, layOutDrawing(one, alone));
    if (beside === null) continue;
    const box = boxOfPoints(beside.lines.xy);
    const placed = { extent: extentOf(source.drawing), map: own.map, isCropped: item.isCropped ?? false };
    const { e, f } = movedOnto(placed, paper).map;
    const [x, y] = [e - own.map.e, f - own.map.f];
    before.push(box);
    after.push({ x0: box.x0 + x, y0: box.y0 + y, x1: box.x1 + x, y1: box.y1 + y });
  }
  if (before.length === 0) return false;
  const isOff = (box: Box): boolean => overEdges(box, paper).some((mm) => mm > NOTICED_MM);
  const [most, left] = [before, after].map((boxes) => overEdges(boxes.reduce(uniteBoxes), paper));
  return after.filter(isOff).length < before.length || left.some((mm, edge) => mm < most[edge] - NOTICED_MM);
}

/** Less than this is not shown, mm. */
const NOTICED_MM = 0.1;

const overEdges = (box: Box, paper: Box): readonly number[] => [
  Math.max(0, paper.x0 - box.x0),
  Math.max(0, paper.y0 - box.y0),
  Math.max(0, box.x1 - paper.x1),
  Math.max(0, box.y1 - paper.y1),
];

/** What a file draws, on its page. */
export function extentOf(drawing: Drawing): FileExtent {
  const contentOn = (cropToPage: boolean): Box =>
    layOutDrawing(drawing, { ...DEFAULT_PREPARE, fit: false, rotateDeg: 0, outside: "allow", cropToPage })
      .content;
  const { widthMm, heightMm } = drawing;
  return { widthMm, heightMm, content: contentOn(false), onPage: contentOn(true) };
}
