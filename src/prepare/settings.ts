import type { PaperSize } from "../drawing/paper.js";

export const LAYER_MODES = ["group", "stroke", "all"] as const;
export type LayerMode = (typeof LAYER_MODES)[number];

export const ORDER_MODES = ["none", "fast", "best"] as const;
export type OrderMode = (typeof ORDER_MODES)[number];

/** How the drawing is laid on the paper and made into strokes. */
export interface PrepareSettings {
  /** Portrait size; `landscape` turns it. */
  readonly paper: PaperSize;
  readonly landscape: boolean;
  readonly marginMm: number;
  /** True: scale to fill the space inside the margins. False: true size, page corner on paper corner. */
  readonly fit: boolean;
  /** Clockwise, about the drawing's middle, before fitting. Any angle. */
  readonly rotateDeg: number;
  /** Cut off what lies outside the margins. */
  readonly clipToMargins: boolean;
  /** Largest gap between a curve and its chords, after scaling to paper. */
  readonly flattenMm: number;
  /** Ends closer than this are joined into one stroke; 0 joins none. */
  readonly joinMm: number;
  /** Strokes shorter than this are dropped; 0 keeps all, dots too. */
  readonly dropShorterMm: number;
  /** Points closer than this to the chord are dropped (Douglas–Peucker); 0 keeps all. */
  readonly simplifyMm: number;
  readonly layers: LayerMode;
  /** Layer ids to leave out. */
  readonly hiddenLayers: readonly string[];
  readonly order: OrderMode;
}

export const DEFAULT_PREPARE: PrepareSettings = {
  paper: { widthMm: 210, heightMm: 297 },
  landscape: true,
  marginMm: 15,
  fit: true,
  rotateDeg: 0,
  clipToMargins: true,
  flattenMm: 0.02,
  joinMm: 0.1,
  dropShorterMm: 0,
  simplifyMm: 0,
  layers: "group",
  hiddenLayers: [],
  order: "fast",
};
