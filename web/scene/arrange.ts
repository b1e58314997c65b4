/** Drawings on a sheet: their frames, and where aligning, copying and adding put them. Pure functions. */
import { compose, mapAround, rotation, scaling, translation, uniteBoxes } from "../../src/internal.js";
import type { Affine, Box, SheetFile } from "../../src/internal.js";
import { boxAround, middleOf, wholeTurn, type FrameMm } from "./placing.js";

/** What a file draws, mm on its page. */
export interface FileExtent {
  readonly widthMm: number;
  readonly heightMm: number;
  /** Of all that it draws. */
  readonly content: Box;
  /** Of what lies on its page. */
  readonly onPage: Box;
}

/** A drawing on the sheet. */
export interface Placed {
  readonly extent: FileExtent;
  /** Its page to the sheet, mm. */
  readonly map: Affine;
  readonly isCropped: boolean;
}

const contentOf = ({ extent, isCropped }: Placed): Box => (isCropped ? extent.onPage : extent.content);

const sizeOf = ({ x0, y0, x1, y1 }: Box) => ({ width: x1 - x0, height: y1 - y0 });

const isMirrored = ({ a, b, c, d }: Affine): boolean => a * d - b * c < 0;

/** The frame around what it draws, as it lies on the sheet. */
export const frameOf = (placed: Placed): FrameMm => {
  const { a, b, c, d, e, f } = placed.map;
  const box = contentOf(placed);
  const { width, height } = sizeOf(box);
  const [x, y] = [(box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2];
  const widthMm = width * Math.hypot(a, b);
  const heightMm = height * Math.hypot(c, d);
  const sign = isMirrored(placed.map) ? -1 : 1;
  return {
    xMm: a * x + c * y + e - widthMm / 2,
    yMm: b * x + d * y + f - heightMm / 2,
    widthMm,
    heightMm,
    turnDeg: wholeTurn((Math.atan2(sign * b, sign * a) * 180) / Math.PI),
  };
};

/** The same drawing in another frame. It keeps its proportions and stays mirrored if it is. */
export const inFrame = <T extends Placed>(placed: T, frame: FrameMm): T => {
  const box = contentOf(placed);
  const { width, height } = sizeOf(box);
  const { x, y } = middleOf(frame);
  const now = placed.map;
  const along =
    width > 0 ? frame.widthMm / width : height > 0 ? frame.heightMm / height : Math.hypot(now.a, now.b);
  const stretch = Math.hypot(now.c, now.d) / Math.hypot(now.a, now.b);
  const mirror = isMirrored(now) ? -1 : 1;
  const toMiddle = translation(-(box.x0 + box.x1) / 2, -(box.y0 + box.y1) / 2);
  const turned = compose(rotation((frame.turnDeg * Math.PI) / 180), scaling(along * mirror, along * stretch));
  return { ...placed, map: compose(translation(x, y), compose(turned, toMiddle)) };
};

/** The upright box around a drawing on the sheet. */
export const boxOf = (placed: Placed): Box => boxAround(frameOf(placed));

export const boxOfAll = (all: readonly Placed[]): Box => all.map(boxOf).reduce(uniteBoxes);

export const movedBy = <T extends Placed>(placed: T, xMm: number, yMm: number): T => ({
  ...placed,
  map: compose(translation(xMm, yMm), placed.map),
});

/** Scales and moves all drawings together, so that the box around them is in the middle of `to`, as large as it can be. */
export const fittedInto = <T extends Placed>(all: readonly T[], to: Box): T[] => {
  const from = boxOfAll(all);
  const [have, room] = [sizeOf(from), sizeOf(to)];
  const factor = Math.min(
    have.width > 0 ? room.width / have.width : Infinity,
    have.height > 0 ? room.height / have.height : Infinity,
  );
  const map = compose(
    translation((to.x0 + to.x1 - from.x0 - from.x1) / 2, (to.y0 + to.y1 - from.y0 - from.y1) / 2),
    mapAround(
      (from.x0 + from.x1) / 2,
      (from.y0 + from.y1) / 2,
      scaling(Number.isFinite(factor) ? factor : 1),
    ),
  );
  return all.map((placed) => ({ ...placed, map: compose(map, placed.map) }));
};

export const ALIGNMENTS = ["left", "centre", "right", "top", "middle", "bottom"] as const;
export type Alignment = (typeof ALIGNMENTS)[number];

/** Moves a drawing so that its box is aligned with `to` on one axis. */
export const aligned = <T extends Placed>(placed: T, how: Alignment, to: Box): T => {
  const { x0, y0, x1, y1 } = boxOf(placed);
  switch (how) {
    case "left":
      return movedBy(placed, to.x0 - x0, 0);
    case "centre":
      return movedBy(placed, (to.x0 + to.x1 - x0 - x1) / 2, 0);
    case "right":
      return movedBy(placed, to.x1 - x1, 0);
    case "top":
      return movedBy(placed, 0, to.y0 - y0);
    case "middle":
      return movedBy(placed, 0, (to.y0 + to.y1 - y0 - y1) / 2);
    case "bottom":
      return movedBy(placed, 0, to.y1 - y1);
  }
};

export interface GridWish {
  readonly columns: number;
  readonly rows: number;
  readonly gapMm: number;
  /** Scales the copies so that the grid is as large as the space inside the margins. */
  readonly fills: boolean;
}

/** Copies of a drawing in rows and columns, in the middle of the space inside the margins, row by row. */
export const gridOf = <T extends Placed>(
  placed: T,
  { columns, rows, gapMm, fills }: GridWish,
  inside: Box,
): T[] => {
  const room = sizeOf(inside);
  const cell = {
    width: (room.width - (columns - 1) * gapMm) / columns,
    height: (room.height - (rows - 1) * gapMm) / rows,
  };
  const canFill = fills && cell.width > 0 && cell.height > 0;
  const [one] = canFill ? fittedInto([placed], { x0: 0, y0: 0, x1: cell.width, y1: cell.height }) : [placed];
  const box = boxOf(one);
  const { width, height } = sizeOf(box);
  const [stepX, stepY] = [width + gapMm, height + gapMm];
  const left = (inside.x0 + inside.x1 - (columns * stepX - gapMm)) / 2;
  const top = (inside.y0 + inside.y1 - (rows * stepY - gapMm)) / 2;
  return Array.from({ length: columns * rows }, (_, k) =>
    movedBy(one, left + (k % columns) * stepX - box.x0, top + Math.floor(k / columns) * stepY - box.y0),
  );
};

/** Free space between drawings, mm. */
const GAP_MM = 5;

const overlaps = (a: Box, b: Box): boolean => a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;

/** Moves a new drawing to a free place inside the margins: beside or below one that is there. If there is none: a little aside. */
export const atFreePlace = <T extends Placed>(placed: T, others: readonly Placed[], inside: Box): T => {
  const own = boxOf(placed);
  const { width, height } = sizeOf(own);
  const taken = others.map(boxOf);
  const places = [
    [inside.x0, inside.y0],
    ...taken.map(({ x1, y0 }) => [x1 + GAP_MM, y0]),
    ...taken.map(({ x0, y1 }) => [x0, y1 + GAP_MM]),
    ...taken.map(({ x1 }) => [x1 + GAP_MM, inside.y0]),
    ...taken.map(({ y1 }) => [inside.x0, y1 + GAP_MM]),
  ] as const;
  const free = places
    .map(([x, y]) => ({ x0: x, y0: y, x1: x + width, y1: y + height }))
    .find((box) => isIn(box, inside) && !taken.some((other) => overlaps(box, other)));
  if (free) return movedBy(placed, free.x0 - own.x0, free.y0 - own.y0);
  const shift = GAP_MM * others.filter((other) => other.extent === placed.extent).length;
  return movedBy(placed, shift, shift);
};

const ROUNDING_MM = 1e-6;
const isIn = (box: Box, outer: Box): boolean =>
  box.x0 >= outer.x0 - ROUNDING_MM &&
  box.y0 >= outer.y0 - ROUNDING_MM &&
  box.x1 <= outer.x1 + ROUNDING_MM &&
  box.y1 <= outer.y1 + ROUNDING_MM;

/** A file that was just added: at its true size, or smaller if the space inside the margins is, and where there is room. */
export const asAdded = (extent: FileExtent, others: readonly Placed[], inside: Box): Placed => {
  const atTrueSize: Placed = { extent, map: scaling(1), isCropped: false };
  const own = sizeOf(boxOf(atTrueSize));
  const room = sizeOf(inside);
  const isLarge = own.width > room.width || own.height > room.height;
  const [sized] = isLarge ? fittedInto([atTrueSize], inside) : [atTrueSize];
  return atFreePlace(aligned(aligned(sized, "centre", inside), "middle", inside), others, inside);
};

/** Moves drawings that leave the paper back onto it, where they fit on it. */
export const movedOnto = <T extends Placed>(placed: T, paper: Box): T => {
  const { x0, y0, x1, y1 } = boxOf(placed);
  const along = (from: number, to: number, low: number, high: number): number =>
    to - from > high - low ? 0 : Math.max(low - from, Math.min(0, high - to));
  return movedBy(placed, along(x0, x1, paper.x0, paper.x1), along(y0, y1, paper.y0, paper.y1));
};

/** The topmost drawing at (x, y) mm. Later ones lie over earlier ones. */
export const topmostAt = <T extends Placed>(
  all: readonly T[],
  x: number,
  y: number,
  reachMm: number,
): T | null =>
  [...all].reverse().find((placed) => {
    const { x0, y0, x1, y1 } = boxOf(placed);
    return x > x0 - reachMm && x < x1 + reachMm && y > y0 - reachMm && y < y1 + reachMm;
  }) ?? null;

/** As it is stored, with enough digits for any sheet. */
export const matrixOf = ({ a, b, c, d, e, f }: Affine): SheetFile["items"][number]["matrix"] => {
  const digits = (value: number): number => Number(value.toPrecision(12));
  return [digits(a), digits(b), digits(c), digits(d), digits(e), digits(f)];
};

export const mapOfMatrix = ([a, b, c, d, e, f]: SheetFile["items"][number]["matrix"]): Affine => ({
  a,
  b,
  c,
  d,
  e,
  f,
});
