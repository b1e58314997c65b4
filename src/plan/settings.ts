/** How the pen moves. One set of limits with the pen down (`draw`), one with it up (`travel`). */
export const MOTION_MODES = ["junction", "blend", "scurve"] as const;
export type MotionMode = (typeof MOTION_MODES)[number];

export interface MotionLimits {
  readonly speedMmPerS: number;
  readonly accelMmPerS2: number;
  /** δ: how far the line may leave the drawing at corners and in tight curves (blend), or may pretend to (junction). */
  readonly cornerMm: number;
  /** Largest change of acceleration; used in `scurve` mode. */
  readonly jerkMmPerS3: number;
}

/** Neighbouring blocks are merged into fewer, longer ones. */
export interface FitSettings {
  /** ε: how far they may leave the plan. */
  readonly toleranceMm: number;
  /** A block shorter than this is merged with its neighbour where that is possible. */
  readonly floorMs: number;
}

/** Slow-in and slow-out: the first and last millimetres of every stroke are drawn no faster than this. */
export interface EaseSettings {
  readonly lengthMm: number;
  readonly speedMmPerS: number;
}

/** What one layer does differently; what is left out is as for all. */
export interface LayerMotion {
  readonly speedMmPerS?: number | undefined;
  readonly accelMmPerS2?: number | undefined;
  readonly cornerMm?: number | undefined;
  readonly jerkMmPerS3?: number | undefined;
}

export interface MotionSettings {
  readonly mode: MotionMode;
  readonly draw: MotionLimits;
  readonly travel: MotionLimits;
  readonly fit?: FitSettings | null | undefined;
  readonly ease?: EaseSettings | null | undefined;
  /** Largest acceleration of one motor; matters on mixed machines, where a diagonal loads one motor more. */
  readonly motorAccelStepsPerS2?: number | null | undefined;
  /** By layer id: limits with the pen down. */
  readonly layers?: Readonly<Record<string, LayerMotion>> | undefined;
}

export const DEFAULT_FIT: FitSettings = { toleranceMm: 0.02, floorMs: 15 };

export const DEFAULT_MOTION: MotionSettings = {
  mode: "blend",
  draw: { speedMmPerS: 50, accelMmPerS2: 500, cornerMm: 0.025, jerkMmPerS3: 10_000 },
  travel: { speedMmPerS: 150, accelMmPerS2: 1_000, cornerMm: 0.5, jerkMmPerS3: 20_000 },
  fit: DEFAULT_FIT,
};

/** What one layer's pen does differently; what is left out is as for all. */
export interface LayerPen {
  readonly upPct?: number | undefined;
  readonly downPct?: number | undefined;
  readonly liftMs?: number | undefined;
  readonly dropMs?: number | undefined;
  /** A wait with the pen up before the layer's first stroke. */
  readonly beforeMs?: number | undefined;
}

/** Short ways between strokes: the pen is lifted less high, and so faster, for hops up to `longestMm`. */
export interface HopSettings {
  readonly longestMm: number;
  readonly upPct: number;
}

/** Pen heights in percent of the servo's range (100 = highest), and how long the queue waits for the pen. */
export interface PenSettings {
  readonly upPct: number;
  readonly downPct: number;
  /** With a rate this is a delay besides the time that the rate needs; without, the whole time. */
  readonly liftMs: number;
  readonly dropMs: number;
  /** How fast the pen rises and sinks; null or left out: as fast as the servo can. A low drop rate is gentle. */
  readonly liftPctPerS?: number | null | undefined;
  readonly dropPctPerS?: number | null | undefined;
  /** Share of the lift after which the pen is clear and the carriage may start: 100 waits for the whole of it. */
  readonly clearPct?: number | undefined;
  readonly hop?: HopSettings | null | undefined;
  readonly layers?: Readonly<Record<string, LayerPen>> | undefined;
}

export const DEFAULT_PEN: PenSettings = { upPct: 60, downPct: 30, liftMs: 250, dropMs: 300 };
