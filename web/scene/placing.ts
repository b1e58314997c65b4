/**
 * Placing the drawing on the paper by dragging its frame. Pure functions.
 *
 *             ○ turn
 *   nw ┌──────┴──────┐ ne     A corner scales about the opposite one and keeps the proportions. The inside moves.
 *      │    move     │        The knob turns about the centre. x and y are the nw corner before turning, so that
 *   sw └─────────────┘ se     turning changes neither place nor size.
 */
import type { Box, FourMargins } from "../../src/internal.js";
import type { Size } from "./view.js";

export interface FrameMm {
  readonly xMm: number;
  readonly yMm: number;
  readonly widthMm: number;
  readonly heightMm: number;
  /** Clockwise, about the centre. */
  readonly turnDeg: number;
}

export const CORNER_PARTS = ["nw", "ne", "sw", "se"] as const;
export type CornerPart = (typeof CORNER_PARTS)[number];
type FramePart = CornerPart | "move" | "turn";

interface Point {
  readonly x: number;
  readonly y: number;
}

const MIN_SIZE_MM = 2;
const SNAP_DEG = 15;
const SNAP_WITHIN_DEG = 3;

const isWest = (part: CornerPart): boolean => part.endsWith("w");
const isNorth = (part: CornerPart): boolean => part.startsWith("n");

export const middleOf = ({ xMm, yMm, widthMm, heightMm }: FrameMm): Point => ({
  x: xMm + widthMm / 2,
  y: yMm + heightMm / 2,
});

/** A point of the frame on the paper; `along` and `down` are −1 … 1 from the centre on the frame's own axes. */
const pointOf = (frame: FrameMm, along: number, down: number): Point => {
  const middle = middleOf(frame);
  const { x, y } = turned((along * frame.widthMm) / 2, (down * frame.heightMm) / 2, frame.turnDeg);
  return { x: middle.x + x, y: middle.y + y };
};

const turned = (x: number, y: number, deg: number): Point => {
  const cos = Math.cos((deg * Math.PI) / 180);
  const sin = Math.sin((deg * Math.PI) / 180);
  return { x: x * cos - y * sin, y: x * sin + y * cos };
};

export const cornerOf = (frame: FrameMm, part: CornerPart): Point =>
  pointOf(frame, isWest(part) ? -1 : 1, isNorth(part) ? -1 : 1);

/** The position of the knob for turning: `reachMm` above the middle of the top edge. */
export const knobOf = (frame: FrameMm, reachMm: number): Point => {
  const down = frame.heightMm > 0 ? -1 - (2 * reachMm) / frame.heightMm : 0;
  return pointOf(frame, 0, down);
};

/** The part of the frame at (x, y) mm. Knob and corners extend to `reachMm`. Null: outside. */
export const framePartAt = (
  frame: FrameMm,
  xMm: number,
  yMm: number,
  reachMm: number,
  knobMm: number,
): FramePart | null => {
  const isNear = ({ x, y }: Point): boolean => Math.hypot(xMm - x, yMm - y) <= reachMm;
  if (isNear(knobOf(frame, knobMm))) return "turn";
  const corner = (["se", "nw", "ne", "sw"] as const).find((part) => isNear(cornerOf(frame, part)));
  if (corner) return corner;
  const middle = middleOf(frame);
  const { x, y } = turned(xMm - middle.x, yMm - middle.y, -frame.turnDeg);
  return Math.abs(x) < frame.widthMm / 2 && Math.abs(y) < frame.heightMm / 2 ? "move" : null;
};

/** The frame after dragging `part` by (dx, dy) mm; the drag began at `from`. */
export const draggedFrame = (
  frame: FrameMm,
  part: FramePart,
  from: Point,
  dxMm: number,
  dyMm: number,
): FrameMm => {
  if (part === "move") return { ...frame, xMm: frame.xMm + dxMm, yMm: frame.yMm + dyMm };
  if (part === "turn") return turnedBy(frame, from, { x: from.x + dxMm, y: from.y + dyMm });
  const { x, y } = turned(dxMm, dyMm, -frame.turnDeg);
  // Only the component along the diagonal counts, so that the frame follows the pointer without jumps.
  const wantedX = frame.widthMm + (isWest(part) ? -x : x);
  const wantedY = frame.heightMm + (isNorth(part) ? -y : y);
  const diagonal2 = frame.widthMm ** 2 + frame.heightMm ** 2;
  return scaledFrame(
    frame,
    part,
    (wantedX * frame.widthMm + wantedY * frame.heightMm) / Math.max(1e-9, diagonal2),
  );
};

/** Scales the frame. The corner opposite to `part` keeps its place on the paper. */
const scaledFrame = (frame: FrameMm, part: CornerPart, wanted: number): FrameMm => {
  const factor = Math.max(MIN_SIZE_MM / Math.max(frame.widthMm, frame.heightMm, 1e-9), wanted);
  const along = isWest(part) ? 1 : -1;
  const down = isNorth(part) ? 1 : -1;
  const fixed = pointOf(frame, along, down);
  const widthMm = frame.widthMm * factor;
  const heightMm = frame.heightMm * factor;
  const arm = turned((along * widthMm) / 2, (down * heightMm) / 2, frame.turnDeg);
  return {
    ...frame,
    xMm: fixed.x - arm.x - widthMm / 2,
    yMm: fixed.y - arm.y - heightMm / 2,
    widthMm,
    heightMm,
  };
};

const angleDeg = (from: Point, to: Point): number =>
  (Math.atan2(to.y - from.y, to.x - from.x) * 180) / Math.PI;

const turnedBy = (frame: FrameMm, from: Point, to: Point): FrameMm => {
  const middle = middleOf(frame);
  return { ...frame, turnDeg: wholeTurn(frame.turnDeg + angleDeg(middle, to) - angleDeg(middle, from)) };
};

/** The angle in −180 < deg ≤ 180. */
export const wholeTurn = (deg: number): number => deg - 360 * Math.ceil((deg - 180) / 360) + 0;

/** The box around the turned frame. */
export const boxAround = (frame: FrameMm): Box => {
  const corners = CORNER_PARTS.map((part) => cornerOf(frame, part));
  const xs = corners.map(({ x }) => x);
  const ys = corners.map(({ y }) => y);
  return { x0: Math.min(...xs), y0: Math.min(...ys), x1: Math.max(...xs), y1: Math.max(...ys) };
};

/** Lines that the frame's edges and centre snap to: mm along x and y. */
export interface SnapLines {
  readonly xs: readonly number[];
  readonly ys: readonly number[];
}

/** A snapped frame, and the lines that it snapped to. */
interface Snapped {
  readonly frame: FrameMm;
  readonly lines: SnapLines;
}

const NO_LINES: SnapLines = { xs: [], ys: [] };

/** Snaps a dragged frame to lines within `reachMm`, or a turn to steps of 15°. */
export const snapFrame = (frame: FrameMm, part: FramePart, lines: SnapLines, reachMm: number): Snapped => {
  if (part === "turn") {
    const step = SNAP_DEG * Math.round(frame.turnDeg / SNAP_DEG);
    const isNear = Math.abs(frame.turnDeg - step) <= SNAP_WITHIN_DEG;
    return { frame: isNear ? { ...frame, turnDeg: wholeTurn(step) } : frame, lines: NO_LINES };
  }
  if (part === "move") return snapMove(frame, lines, reachMm);
  return frame.turnDeg === 0 ? snapCorner(frame, part, lines, reachMm) : { frame, lines: NO_LINES };
};

const snapMove = (frame: FrameMm, lines: SnapLines, reachMm: number): Snapped => {
  const { x0, y0, x1, y1 } = boxAround(frame);
  const x = nearestLine([x0, (x0 + x1) / 2, x1], lines.xs, reachMm);
  const y = nearestLine([y0, (y0 + y1) / 2, y1], lines.ys, reachMm);
  return {
    frame: { ...frame, xMm: frame.xMm + (x?.by ?? 0), yMm: frame.yMm + (y?.by ?? 0) },
    lines: { xs: x ? [x.line] : [], ys: y ? [y.line] : [] },
  };
};

const snapCorner = (frame: FrameMm, part: CornerPart, lines: SnapLines, reachMm: number): Snapped => {
  const corner = cornerOf(frame, part);
  const x = nearestLine([corner.x], lines.xs, reachMm);
  const y = nearestLine([corner.y], lines.ys, reachMm);
  if (x && (!y || Math.abs(x.by) <= Math.abs(y.by))) {
    const widthMm = frame.widthMm + (isWest(part) ? -x.by : x.by);
    return { frame: scaledFrame(frame, part, widthMm / frame.widthMm), lines: { xs: [x.line], ys: [] } };
  }
  if (!y) return { frame, lines: NO_LINES };
  const heightMm = frame.heightMm + (isNorth(part) ? -y.by : y.by);
  return { frame: scaledFrame(frame, part, heightMm / frame.heightMm), lines: { xs: [], ys: [y.line] } };
};

const nearestLine = (
  places: readonly number[],
  lines: readonly number[],
  reachMm: number,
): { readonly line: number; readonly by: number } | null => {
  let best: { line: number; by: number } | null = null;
  for (const line of lines) {
    for (const place of places) {
      const by = line - place;
      if (Math.abs(by) <= reachMm && (!best || Math.abs(by) < Math.abs(best.by))) best = { line, by };
    }
  }
  return best;
};

/** The paper's edges and centre lines, and the margins. */
export const snapLinesOf = (paperMm: Size, margins: FourMargins): SnapLines => ({
  xs: [0, margins.leftMm, paperMm.width / 2, paperMm.width - margins.rightMm, paperMm.width],
  ys: [0, margins.topMm, paperMm.height / 2, paperMm.height - margins.bottomMm, paperMm.height],
});

const round = (mm: number): number => Math.round(mm * 100) / 100;

/**
 * The frame as prepare settings, rounded to 0.01 mm and 0.1°, which is finer than any pen and readable in the fields.
 * The width is set, and the height follows from the proportions.
 */
export const layoutOfFrame = ({
  xMm,
  yMm,
  widthMm,
  turnDeg,
}: FrameMm): { xMm: number; yMm: number; widthMm: number; heightMm: null; turnDeg: number } => ({
  xMm: round(xMm),
  yMm: round(yMm),
  widthMm: Math.max(0.01, round(widthMm)),
  heightMm: null,
  turnDeg: Math.round(turnDeg * 10) / 10,
});
