/** What draws the strokes: WebGL2 where there is a graphics card, Canvas 2D elsewhere. */
import type { ColorMode } from "../state/persist.js";
import type { Scene } from "./scene.js";
import type { View } from "./view.js";

export interface Frame {
  readonly view: View;
  /** CSS px. */
  readonly width: number;
  readonly height: number;
  /** Device px a CSS px. */
  readonly ratio: number;
  readonly colorBy: ColorMode;
  readonly showTravel: boolean;
  readonly lineMm: number;
  /** "#rrggbb" by layer index. */
  readonly layerColors: readonly string[];
  /** mm by layer index: how wide its pen draws; null: all lines are `lineMm` wide. */
  readonly layerWidthsMm: readonly number[] | null;
  /** What lies later than this many seconds is shown pale; null shows the whole plot as drawn. */
  readonly untilS: number | null;
  /** The view is being moved: a large drawing may be shown coarser until it rests. */
  readonly isMoving: boolean;
}

export interface SceneRenderer {
  readonly kind: "webgl" | "canvas";
  setScene(scene: Scene | null): void;
  /** False where the scene is still on its way to the card or the last frame is still being drawn: not begun. */
  draw(frame: Frame): boolean;
  close(): void;
}

/** Narrowest line, CSS px: thinner ones flicker when zoomed out. */
export const MIN_LINE_PX = 1.15;
export const GHOST_COLOR = "#dcdad4";
export const TRAVEL_COLOR = "#5b8fa8";
export const INK_COLOR = "#22242c";

export const lineWidthPx = ({ view }: Frame, lineMm: number): number =>
  Math.max(MIN_LINE_PX, lineMm * view.scale);

export const bytesFromHex = (hex: string): [number, number, number] => {
  const n = Number.parseInt(hex.slice(1), 16);
  return [(n >> 16) & 255, (n >> 8) & 255, n & 255];
};
