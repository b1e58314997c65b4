/**
 * A drawing that is larger than the paper, on several sheets. The drawing is laid out on a large sheet, the poster. Each
 * tile is a window of it, placed inside the margins of a sheet of paper. Neighbouring windows overlap, so that the
 * sheets can be glued or cut anywhere in the overlap. Marks in the margins show the middle of the overlap.
 *
 *        window 1           window 2
 *   ┌───────────────────┐                        x = 0        at the left edge of window 1
 *   │             ╎┌────┼──────────────┐         ╎            the cut, with a mark above and below it
 *   │             ╎│    │              │         poster       from the left edge of window 1 to the right edge of window 2
 *   └───────────────────┘              │
 *                  └───────────────────┘
 */
import type { PaperSize } from "../drawing/paper.js";
import { PlotwrightError } from "../errors.js";
import { intersectBoxes, type Box } from "../geometry/box.js";
import { LineBuilder, type Lines } from "../geometry/polyline.js";
import type { PrepareSettings } from "../settings/prepare.js";

type TileSettings = Pick<
  PrepareSettings,
  | "paper"
  | "landscape"
  | "marginMm"
  | "margins"
  | "reach"
  | "tileColumns"
  | "tileRows"
  | "tileOverlapMm"
  | "tileMarks"
  | "tile"
>;

/** Width and height as the paper lies: the long side along x in landscape, otherwise along y. */
export function orientedPaper(paper: PaperSize, landscape: boolean): PaperSize {
  const long = Math.max(paper.widthMm, paper.heightMm);
  const short = Math.min(paper.widthMm, paper.heightMm);
  return landscape ? { widthMm: long, heightMm: short } : { widthMm: short, heightMm: long };
}

/** The number of sheets; 1: the drawing is not tiled. */
export const tileCount = ({
  tileColumns,
  tileRows,
}: Pick<TileSettings, "tileColumns" | "tileRows">): number => tileColumns * tileRows;

type TileChoice = Pick<TileSettings, "tileColumns" | "tileRows" | "tile">;

const isTile = (settings: TileChoice): boolean => settings.tile > 0 && tileCount(settings) > 1;

/** Two sheets of drawings that have several never share their paper. */
export const needsNewPaper = (before: TileChoice, next: TileChoice): boolean =>
  isTile(before) && isTile(next);

/** Settings for each sheet that is still to be plotted: one, unless the drawing is tiled and no sheet was chosen. */
export const tilesOf = <S extends TileSettings>(settings: S): S[] =>
  tileCount(settings) === 1 || settings.tile > 0
    ? [settings]
    : Array.from({ length: tileCount(settings) }, (_, k) => ({ ...settings, tile: k + 1 }));

/** The paper, and what is inside its margins. Throws `bad-setting` if the margins leave no room. */
export function paperAndMargins(
  settings: Pick<TileSettings, "paper" | "landscape" | "marginMm" | "margins">,
): {
  readonly paper: Box;
  readonly inside: Box;
} {
  const { widthMm, heightMm } = orientedPaper(settings.paper, settings.landscape);
  const m = settings.marginMm;
  const { topMm, rightMm, bottomMm, leftMm } = settings.margins ?? {
    topMm: m,
    rightMm: m,
    bottomMm: m,
    leftMm: m,
  };
  const inside = { x0: leftMm, y0: topMm, x1: widthMm - rightMm, y1: heightMm - bottomMm };
  if (inside.x0 < inside.x1 && inside.y0 < inside.y1) {
    return { paper: { x0: 0, y0: 0, x1: widthMm, y1: heightMm }, inside };
  }
  const sides = settings.margins ? `${topMm}, ${rightMm}, ${bottomMm} and ${leftMm}` : String(m);
  throw new PlotwrightError(
    "bad-setting",
    `Margins of ${sides} mm leave no room on paper of ${widthMm} × ${heightMm} mm: make the margin smaller or the paper larger.`,
  );
}

interface Windows {
  readonly inside: Box;
  readonly width: number;
  readonly height: number;
  /** From one window to the next. */
  readonly stepX: number;
  readonly stepY: number;
}

function windowsOf(settings: TileSettings): Windows {
  const { inside } = paperAndMargins(settings);
  const [width, height] = [inside.x1 - inside.x0, inside.y1 - inside.y0];
  const { tileColumns, tileRows, tileOverlapMm } = settings;
  const side = Math.min(tileColumns > 1 ? width : Infinity, tileRows > 1 ? height : Infinity);
  if (tileOverlapMm >= side / 2) {
    throw new PlotwrightError(
      "bad-setting",
      `The sheets can't overlap by ${tileOverlapMm} mm: inside the margins they are only ${side} mm wide or high. Choose less than half of that with --tile-overlap.`,
    );
  }
  return { inside, width, height, stepX: width - tileOverlapMm, stepY: height - tileOverlapMm };
}

/** What the drawing is laid out on: the paper, or the poster, which has no margins of its own. */
export function sheetOf(settings: TileSettings): { readonly paper: Box; readonly inside: Box } {
  if (tileCount(settings) === 1) return paperAndMargins(settings);
  const { width, height, stepX, stepY } = windowsOf(settings);
  const { tileColumns, tileRows } = settings;
  const poster = {
    x0: 0,
    y0: 0,
    x1: (tileColumns - 1) * stepX + width,
    y1: (tileRows - 1) * stepY + height,
  };
  return { paper: poster, inside: poster };
}

/** The size of what the drawing is laid out on. */
export function sheetSize(settings: TileSettings): PaperSize {
  if (tileCount(settings) === 1) return orientedPaper(settings.paper, settings.landscape);
  const { paper } = sheetOf(settings);
  return { widthMm: paper.x1, heightMm: paper.y1 };
}

/** The windows of all tiles on the poster, row by row. Empty if the drawing is not tiled. */
export function tileWindows(settings: TileSettings): Box[] {
  if (tileCount(settings) === 1) return [];
  const { width, height, stepX, stepY } = windowsOf(settings);
  return Array.from({ length: tileCount(settings) }, (_, k) => {
    const x0 = (k % settings.tileColumns) * stepX;
    const y0 = Math.floor(k / settings.tileColumns) * stepY;
    return { x0, y0, x1: x0 + width, y1: y0 + height };
  });
}

/** One sheet of a tiled drawing. */
export interface TileOnPaper {
  /** What is drawn of the poster. Without end where the poster ends: what leaves it is a matter of the whole drawing. */
  readonly window: Box;
  /** From the poster to the paper. */
  readonly move: { readonly x: number; readonly y: number };
  readonly paper: Box;
  /** Marks for cutting, on the poster. */
  readonly marks: readonly Mark[];
  /** The margins have no room for marks. */
  readonly lacksMarks: boolean;
}

/** A straight line. */
type Mark = readonly [x0: number, y0: number, x1: number, y1: number];

const MARK_MM = 5;
const SHORTEST_MARK_MM = 1;
/** Between a mark and the drawing, and between a mark and the paper's edge. */
const MARK_GAP_MM = 1;

/** The chosen sheet. Null: the drawing is not tiled, or no sheet is chosen. Throws `bad-setting` if there is no such sheet. */
export function tileOf(settings: TileSettings): TileOnPaper | null {
  const { tile, tileColumns, tileRows } = settings;
  if (tile > tileCount(settings)) {
    throw new PlotwrightError(
      "bad-setting",
      `There is no sheet ${tile}: the drawing is on ${tileCount(settings)}, in ${tileColumns} columns and ${tileRows} rows.`,
    );
  }
  if (!isTile(settings)) return null;
  const { paper, inside } = paperAndMargins(settings);
  const own = tileWindows(settings)[tile - 1];
  const move = { x: inside.x0 - own.x0, y: inside.y0 - own.y0 };
  const column = (tile - 1) % tileColumns;
  const row = Math.floor((tile - 1) / tileColumns);
  const window = {
    x0: column === 0 ? -Infinity : own.x0,
    y0: row === 0 ? -Infinity : own.y0,
    x1: column === tileColumns - 1 ? Infinity : own.x1,
    y1: row === tileRows - 1 ? Infinity : own.y1,
  };
  const { reach } = settings;
  const reached = reach && {
    x0: -move.x,
    y0: -move.y,
    x1: reach.widthMm - move.x,
    y1: reach.heightMm - move.y,
  };
  const { marks, lacksMarks } = settings.tileMarks ? marksOf(settings, own) : NO_MARKS;
  return { window: reached ? intersectBoxes(window, reached) : window, move, paper, marks, lacksMarks };
}

const NO_MARKS = { marks: [], lacksMarks: false };

/** Marks above and below each cut, left and right of each: on both neighbours at the same place of the poster. */
function marksOf(settings: TileSettings, own: Box): Pick<TileOnPaper, "marks" | "lacksMarks"> {
  const { tileColumns, tileRows, tileOverlapMm: overlap } = settings;
  const { stepX, stepY } = windowsOf(settings);
  const { paper, inside } = paperAndMargins(settings);
  const rooms = {
    left: inside.x0,
    top: inside.y0,
    right: paper.x1 - inside.x1,
    bottom: paper.y1 - inside.y1,
  };
  const lengthIn = (room: number): number => Math.min(MARK_MM, room - 2 * MARK_GAP_MM);
  const marks: Mark[] = [];
  let lacksMarks = false;
  const add = (room: number, markOf: (from: number, to: number) => Mark): void => {
    const length = lengthIn(room);
    if (length < SHORTEST_MARK_MM) lacksMarks = true;
    else marks.push(markOf(MARK_GAP_MM, MARK_GAP_MM + length));
  };
  for (const x of cutsBetween(own.x0, own.x1, stepX, tileColumns, overlap)) {
    add(rooms.top, (from, to) => [x, own.y0 - to, x, own.y0 - from]);
    add(rooms.bottom, (from, to) => [x, own.y1 + from, x, own.y1 + to]);
  }
  for (const y of cutsBetween(own.y0, own.y1, stepY, tileRows, overlap)) {
    add(rooms.left, (from, to) => [own.x0 - to, y, own.x0 - from, y]);
    add(rooms.right, (from, to) => [own.x1 + from, y, own.x1 + to, y]);
  }
  return { marks, lacksMarks };
}

/** The cuts of a window along one axis: in the middle of its overlaps. */
const cutsBetween = (from: number, to: number, step: number, count: number, overlap: number): number[] =>
  Array.from({ length: count - 1 }, (_, k) => (k + 1) * step + overlap / 2).filter(
    (cut) => cut >= from && cut <= to,
  );

/** The marks as lines with this tag, before other lines. */
export function withMarks(lines: Lines, marks: readonly Mark[], tag: number): Lines {
  const builder = new LineBuilder();
  for (const [x0, y0, x1, y1] of marks) {
    builder.point(x0, y0);
    builder.point(x1, y1);
    builder.end(tag);
  }
  for (let i = 0; i + 1 < lines.offsets.length; i++) builder.copy(lines, i, lines.tag[i]);
  return builder.finish();
}

export const moved = (lines: Lines, { x, y }: TileOnPaper["move"]): Lines => ({
  ...lines,
  xy: lines.xy.map((mm, k) => mm + (k % 2 === 0 ? x : y)),
});
