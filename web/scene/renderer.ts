/** The interface of the stroke renderers, which draw in a worker: WebGL2 if there is a graphics card, otherwise in software. */
import type { Pieces } from "./pieces.js";
import type { Scene } from "./scene.js";
import type { View } from "./view.js";

export interface Frame {
  readonly view: View;
  /** CSS px. */
  readonly width: number;
  readonly height: number;
  /** Device px per CSS px. */
  readonly ratio: number;
  /** What gives a piece its colour: its two values or its time, both on the colour ramp, or its layer. */
  readonly colorBy: "value" | "time" | "layer";
  readonly showTravel: boolean;
  /** "#rrggbb" by layer index. */
  readonly layerColors: readonly string[];
  /** Line width of each layer, mm, by layer index. */
  readonly layerWidthsMm: readonly number[];
  /**
   * The mean distance between neighbouring lines, mm. If given, lines that would merge when zoomed out are drawn
   * thinner than usual.
   */
  readonly lineGapMm?: number | undefined;
  /** "#rrggbb" of strokes that are not drawn yet at the shown moment. */
  readonly ghostColor: string;
  /** Strokes after this time are shown pale, s; null: the whole plot is shown as drawn. */
  readonly untilS: number | null;
}

/** The parts of a scene that are drawn. */
export interface Picture extends Pick<Scene, "draw" | "travel" | "totalS"> {
  /** The planned strokes, drawn as thin lines under those of a simulated pen. */
  readonly asked?: Pieces | undefined;
}

/** "whole": every piece; "coarse": few pieces that are drawn quickly and look similar when zoomed out. */
export type Detail = "coarse" | "whole";

/**
 * Draws a picture off-screen in parts; `present` shows it. The pixels do not depend on the number of parts.
 */
export interface SceneRenderer {
  setScene(scene: Picture | null): void;
  /** Begins a new picture and drops the current one. Returns the number of its pieces. */
  begin(frame: Frame, detail: Detail): number;
  /** Draws about `pieceCount` more pieces. Returns how many; 0 while the scene is being sent to the card. */
  advance(pieceCount: number): number;
  /** All of the picture was sent to the card. */
  readonly isFinished: boolean;
  /** The card has finished everything that was sent to it. */
  isIdle(): boolean;
  /** Puts the finished picture on the canvas. */
  present(): void;
  close(): void;
}

/** Min. line width, CSS px: thinner lines flicker when zoomed out. */
export const MIN_LINE_PX = 1.15;
/** Min. line width in a dense drawing, CSS px: leaves half of the visible paper empty. */
const HAIR_LINE_PX = 0.5;
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
