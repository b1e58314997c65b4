import type { PaperSize } from "../drawing/paper.js";

export const LAYER_MODES = ["group", "stroke", "all"] as const;
export type LayerMode = (typeof LAYER_MODES)[number];

export const ORDER_MODES = ["none", "fast", "best"] as const;
export type OrderMode = (typeof ORDER_MODES)[number];

export const MIRROR_MODES = ["none", "leftRight", "upDown"] as const;
export type MirrorMode = (typeof MIRROR_MODES)[number];

export const SPREAD_MODES = ["none", "interleave", "shuffle"] as const;
export type SpreadMode = (typeof SPREAD_MODES)[number];

export interface FourMargins {
  readonly topMm: number;
  readonly rightMm: number;
  readonly bottomMm: number;
  readonly leftMm: number;
}

/** Where the drawing's own box goes, mm from the paper's top left corner. */
export interface PlacedBox {
  readonly xMm: number;
  readonly yMm: number;
  /** One of them null: the drawing keeps its proportions. Both null: its true size. */
  readonly widthMm: number | null;
  readonly heightMm: number | null;
  /** A turn after that, clockwise about the box's middle: the size stays, and so does the middle. */
  readonly turnDeg?: number | undefined;
}

export interface ShiftMm {
  readonly xMm: number;
  readonly yMm: number;
}

/** How areas are filled with lines. */
export interface HatchSettings {
  /** Distance of the lines, which is the width that the pen covers; 0 leaves areas empty. */
  readonly spacingMm: number;
  /** Of the lines, clockwise from the x axis. */
  readonly angleDeg: number;
  /** A second set of lines across the first. */
  readonly cross: boolean;
}

export interface LayerHatch extends HatchSettings {
  /** Layer id. */
  readonly layer: string;
}

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
  /** Layers that are drawn although their name begins with "%". */
  readonly shownLayers: readonly string[];
  /** Layer ids that are drawn first, in this order; the rest follow in the file's order. */
  readonly layerOrder: readonly string[];
  /** By layer id: how many times it is drawn; once unless told. */
  readonly layerRepeats: Readonly<Record<string, number>>;
  /** By layer id: by how much its strokes are moved last of all, so that a pen that sits askew meets the others. */
  readonly layerShifts?: Readonly<Record<string, ShiftMm>> | undefined;
  readonly order: OrderMode;
  /** How long `best` may search, in the time of the clock that `prepare` is given. */
  readonly orderS: number;
  /** Each side by itself; null: `marginMm` all round. */
  readonly margins: FourMargins | null;
  readonly mirror: MirrorMode;
  /** The drawing's place by numbers, after turning and mirroring; goes before `fit`. Null: `fit` decides. */
  readonly place: PlacedBox | null;
  /** Cut off what lies outside the file's own page. */
  readonly cropToPage: boolean;
  /** Cut off what lies outside the machine's travel, from home; null: nothing is cut for it. */
  readonly reach: PaperSize | null;
  readonly hatch: HatchSettings;
  /** Layers that are filled in their own way. */
  readonly layerHatches: readonly LayerHatch[];
  /** Draw the outline of shapes that have a fill and no stroke. */
  readonly outlineFills: boolean;
  /** Leave out what lies under filled shapes painted later. */
  readonly hideCovered: boolean;
  /** Pieces drawn before within this distance are left out; 0 keeps all. */
  readonly dropRepeatsMm: number;
  /** Rounds of corner cutting (Chaikin): 0 none, each doubles the points. */
  readonly smoothRounds: number;
  /** Closed strokes begin at a random point, so that their seams do not line up. */
  readonly reloop: boolean;
  /** Draw neighbours apart in time, so that ink dries and paper survives. Goes after `order`. */
  readonly spread: SpreadMode;
  /** A stop to take up ink after so much drawing: layers are split there; 0 never. */
  readonly reinkMm: number;
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
  shownLayers: [],
  layerOrder: [],
  layerRepeats: {},
  order: "fast",
  orderS: 9,
  margins: null,
  mirror: "none",
  place: null,
  cropToPage: false,
  reach: null,
  hatch: { spacingMm: 0, angleDeg: 45, cross: false },
  layerHatches: [],
  outlineFills: true,
  hideCovered: false,
  dropRepeatsMm: 0,
  smoothRounds: 0,
  reloop: false,
  spread: "none",
  reinkMm: 0,
};
