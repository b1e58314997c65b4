/** What draws the strokes, on whichever thread: WebGL2 where there is a graphics card, our own code elsewhere. */
import type { ColorMode } from "./color-mode.js";
import type { Pieces } from "./pieces.js";
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
  /**
   * The mean distance between a line and the next, mm. From afar, lines that would run into each other are then
   * drawn thinner than usual; left out: never.
   */
  readonly lineGapMm?: number | undefined;
  /** What lies later than this many seconds is shown pale; null shows the whole plot as drawn. */
  readonly untilS: number | null;
}

/** What of a scene is drawn. */
export interface Picture extends Pick<Scene, "draw" | "travel" | "totalS"> {
  /** What a simulated pen should have drawn: a thin line under what it draws. */
  readonly asked?: Pieces | undefined;
}

/** "whole": every piece; "coarse": few enough of them to be quick, much like the whole from afar. */
export type Detail = "coarse" | "whole";

/**
 * Draws a picture in parts, out of sight; `present` shows it. A picture is the same to the pixel in however many parts
 * it was drawn.
 */
export interface SceneRenderer {
  setScene(scene: Picture | null): void;
  /** Begins a picture in place of the one it was at; returns how many pieces that takes. */
  begin(frame: Frame, detail: Detail): number;
  /** Draws about so many more of its pieces, and returns how many; none while the scene is on its way to the card. */
  advance(pieceCount: number): number;
  /** All of the picture has been handed to the card. */
  readonly isFinished: boolean;
  /** The card has done all that it was handed. */
  isIdle(): boolean;
  /** Puts the finished picture on the canvas. */
  present(): void;
  close(): void;
}

/** Of this thread or of the page's: the renderers use what both have. */
export type StrokesCanvas = HTMLCanvasElement | OffscreenCanvas;

/** Narrowest line, CSS px: thinner ones flicker when zoomed out. */
export const MIN_LINE_PX = 1.15;
/** Narrowest line of a dense drawing, CSS px: half of what can be seen of it is still paper. */
const HAIR_LINE_PX = 0.5;
export const GHOST_COLOR = "#dcdad4";
export const ASKED_COLOR = "#a8a498";
export const TRAVEL_COLOR = "#5b8fa8";
export const TRAVEL_ALPHA = 0.6;
export const TRAVEL_PX = 0.9;
export const INK_COLOR = "#22242c";

/** Width and height of a frame's picture, device px. */
export const pictureSize = ({ width, height, ratio }: Frame): readonly [number, number] => [
  Math.max(1, Math.round(width * ratio)),
  Math.max(1, Math.round(height * ratio)),
];

export const lineWidthPx = ({ view, lineGapMm }: Frame, lineMm: number): number => {
  const halfGapPx = lineGapMm === undefined ? MIN_LINE_PX : (lineGapMm * view.scale) / 2;
  return Math.max(Math.min(MIN_LINE_PX, Math.max(HAIR_LINE_PX, halfGapPx)), lineMm * view.scale);
};

export const bytesFromHex = (hex: string): [number, number, number] => {
  const n = Number.parseInt(hex.slice(1), 16);
  return [(n >> 16) & 255, (n >> 8) & 255, n & 255];
};
