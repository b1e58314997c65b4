/**
 * Dragging the drawing about on the paper: which part of its frame is held, and where the drag leads. Pure.
 *
 *   nw ┌─────────┐ ne     a corner scales about the opposite one, proportions kept;
 *      │  move   │        the inside moves
 *   sw └─────────┘ se
 */
export interface FrameMm {
  readonly xMm: number;
  readonly yMm: number;
  readonly widthMm: number;
  readonly heightMm: number;
}

export const FRAME_PARTS = ["nw", "ne", "sw", "se", "move"] as const;
export type FramePart = (typeof FRAME_PARTS)[number];

const SMALLEST_MM = 2;

/** The part of the frame at (x, y) mm; corners count within `reachMm`. Null outside. */
export const framePartAt = (frame: FrameMm, xMm: number, yMm: number, reachMm: number): FramePart | null => {
  const right = frame.xMm + frame.widthMm;
  const bottom = frame.yMm + frame.heightMm;
  const isNear = (x: number, y: number): boolean => Math.hypot(xMm - x, yMm - y) <= reachMm;
  if (isNear(right, bottom)) return "se";
  if (isNear(frame.xMm, frame.yMm)) return "nw";
  if (isNear(right, frame.yMm)) return "ne";
  if (isNear(frame.xMm, bottom)) return "sw";
  const isInside = xMm > frame.xMm && xMm < right && yMm > frame.yMm && yMm < bottom;
  return isInside ? "move" : null;
};

/** The frame after its part has been dragged by (dx, dy) mm from where it began. */
export const draggedFrame = (frame: FrameMm, part: FramePart, dxMm: number, dyMm: number): FrameMm => {
  if (part === "move") return { ...frame, xMm: frame.xMm + dxMm, yMm: frame.yMm + dyMm };
  const isWest = part === "nw" || part === "sw";
  const isNorth = part === "nw" || part === "ne";
  // The drag's part along the diagonal decides: both sides have their say, and no side wins by jumping.
  const wantedX = frame.widthMm + (isWest ? -dxMm : dxMm);
  const wantedY = frame.heightMm + (isNorth ? -dyMm : dyMm);
  const diagonal2 = frame.widthMm ** 2 + frame.heightMm ** 2;
  const wanted = (wantedX * frame.widthMm + wantedY * frame.heightMm) / Math.max(1e-9, diagonal2);
  const factor = Math.max(SMALLEST_MM / Math.max(frame.widthMm, frame.heightMm, 1e-9), wanted);
  const widthMm = frame.widthMm * factor;
  const heightMm = frame.heightMm * factor;
  return {
    xMm: isWest ? frame.xMm + frame.widthMm - widthMm : frame.xMm,
    yMm: isNorth ? frame.yMm + frame.heightMm - heightMm : frame.yMm,
    widthMm,
    heightMm,
  };
};

/** To a hundredth of a millimetre: finer than any pen, and readable in the fields. */
export const roundedFrame = (frame: FrameMm): FrameMm => ({
  xMm: round(frame.xMm),
  yMm: round(frame.yMm),
  widthMm: round(frame.widthMm),
  heightMm: round(frame.heightMm),
});

const round = (mm: number): number => Math.round(mm * 100) / 100;

/** As the prepare settings want it: the width decides, the proportions stay. */
export const placeOfFrame = (
  frame: FrameMm,
): { xMm: number; yMm: number; widthMm: number; heightMm: null } => {
  const { xMm, yMm, widthMm } = roundedFrame(frame);
  return { xMm, yMm, widthMm, heightMm: null };
};
