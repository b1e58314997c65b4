/**
 * The visible part of the paper: screen px = mm × scale + offset. Pure functions.
 */
export interface View {
  /** CSS px per mm. */
  readonly scale: number;
  /** CSS px of the paper's top left corner. */
  readonly offsetX: number;
  readonly offsetY: number;
}

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

export const fitView = (paperMm: Size, viewportPx: Size, insets: Insets): View => {
  const roomX = Math.max(40, viewportPx.width - insets.left - insets.right);
  const roomY = Math.max(40, viewportPx.height - insets.top - insets.bottom);
  const scale = Math.min(roomX / paperMm.width, roomY / paperMm.height);
  return {
    scale,
    offsetX: insets.left + (roomX - paperMm.width * scale) / 2,
    offsetY: insets.top + (roomY - paperMm.height * scale) / 2,
  };
};

/** Zooms by `factor` and keeps the point under (xPx, yPx) where it is. */
export const zoomAt = (view: View, factor: number, xPx: number, yPx: number): View => {
  const scale = Math.min(MAX_SCALE, Math.max(MIN_SCALE, view.scale * factor));
  const f = scale / view.scale;
  return {
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

export const mmFromScreen = (view: View, xPx: number, yPx: number): [xMm: number, yMm: number] => [
  (xPx - view.offsetX) / view.scale,
  (yPx - view.offsetY) / view.scale,
];

/** Distance between ruler numbers: the smallest of 1, 2, 5 × 10ⁿ that is at least `minPx` wide. */
export const rulerStep = (scale: number, minPx: number): number => {
  const raw = minPx / scale;
  const power = 10 ** Math.floor(Math.log10(raw));
  for (const factor of [1, 2, 5]) if (factor * power >= raw * (1 - 1e-9)) return factor * power;
  return 10 * power;
};
