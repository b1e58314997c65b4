/**
 * The visible part of the paper: screen px = mm, turned by quarters, × scale + offset. Pure functions.
 */
import type { Affine, Box } from "../../src/internal.js";

export interface View {
  /** CSS px per mm. */
  readonly scale: number;
  /** CSS px of the paper's corner at home. */
  readonly offsetX: number;
  readonly offsetY: number;
  /** How far the desk is turned clockwise, 0 … 3 quarters. Left out: 0. */
  readonly turn?: number;
}

const COS = [1, 0, -1, 0] as const;
const SIN = [0, 1, 0, -1] as const;

/** The directions of the paper's x axis on the screen: cos and sin of the turn. */
export const turnOf = ({ turn = 0 }: Pick<View, "turn">): readonly [cos: number, sin: number] => [
  COS[turn],
  SIN[turn],
];

/** From mm on the paper to px on the screen. */
export const screenMap = (view: View): Affine => {
  const [cos, sin] = turnOf(view).map((part) => part * view.scale);
  return { a: cos, b: sin, c: -sin, d: cos, e: view.offsetX, f: view.offsetY };
};

export interface Size {
  readonly width: number;
  readonly height: number;
}

const MIN_SCALE = 0.05;
const MAX_SCALE = 400;

/** Free space around the paper, CSS px; the rulers are at the top and left. */
interface Insets {
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
  readonly left: number;
}

export const fitView = (paperMm: Size, viewportPx: Size, insets: Insets, turn = 0): View => {
  const roomX = Math.max(40, viewportPx.width - insets.left - insets.right);
  const roomY = Math.max(40, viewportPx.height - insets.top - insets.bottom);
  const isUpright = turn % 2 === 0;
  const acrossMm = isUpright ? paperMm.width : paperMm.height;
  const downMm = isUpright ? paperMm.height : paperMm.width;
  const scale = Math.min(roomX / acrossMm, roomY / downMm);
  const { x0, y0 } = screenBox(
    { scale, offsetX: 0, offsetY: 0, turn },
    { x0: 0, y0: 0, x1: paperMm.width, y1: paperMm.height },
  );
  return {
    scale,
    offsetX: insets.left + (roomX - acrossMm * scale) / 2 - x0,
    offsetY: insets.top + (roomY - downMm * scale) / 2 - y0,
    turn,
  };
};

/** Zooms by `factor` and keeps the point under (xPx, yPx) where it is. */
export const zoomAt = (view: View, factor: number, xPx: number, yPx: number): View => {
  const scale = Math.min(MAX_SCALE, Math.max(MIN_SCALE, view.scale * factor));
  const f = scale / view.scale;
  return {
    ...view,
    scale,
    offsetX: xPx - (xPx - view.offsetX) * f,
    offsetY: yPx - (yPx - view.offsetY) * f,
  };
};

export const panBy = (view: View, dxPx: number, dyPx: number): View => ({
  ...view,
  offsetX: view.offsetX + dxPx,
  offsetY: view.offsetY + dyPx,
});

/** A distance on the paper from one on the screen, mm. */
export const mmFromPx = (view: View, dxPx: number, dyPx: number): [dxMm: number, dyMm: number] => {
  const [cos, sin] = turnOf(view);
  return [(cos * dxPx + sin * dyPx) / view.scale, (cos * dyPx - sin * dxPx) / view.scale];
};

export const mmFromScreen = (view: View, xPx: number, yPx: number): [xMm: number, yMm: number] =>
  mmFromPx(view, xPx - view.offsetX, yPx - view.offsetY);

export const screenPoint = (view: View, xMm: number, yMm: number): [xPx: number, yPx: number] => {
  const { a, b, c, d, e, f } = screenMap(view);
  return [a * xMm + c * yMm + e, b * xMm + d * yMm + f];
};

/** A box of the paper on the screen, px. */
export const screenBox = (view: View, { x0, y0, x1, y1 }: Box): Box => {
  const [ax, ay] = screenPoint(view, x0, y0);
  const [bx, by] = screenPoint(view, x1, y1);
  return { x0: Math.min(ax, bx), y0: Math.min(ay, by), x1: Math.max(ax, bx), y1: Math.max(ay, by) };
};

/** Distance between ruler numbers: the smallest of 1, 2, 5 × 10ⁿ that is at least `minPx` wide. */
export const rulerStep = (scale: number, minPx: number): number => {
  const raw = minPx / scale;
  const power = 10 ** Math.floor(Math.log10(raw));
  for (const factor of [1, 2, 5]) if (factor * power >= raw * (1 - 1e-9)) return factor * power;
  return 10 * power;
};
