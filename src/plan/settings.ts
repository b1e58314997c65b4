/** How the pen moves. One set of limits with the pen down (`draw`), one with it up (`travel`). */
export const MOTION_MODES = ["junction", "blend", "scurve"] as const;
export type MotionMode = (typeof MOTION_MODES)[number];

export interface MotionLimits {
  readonly speedMmPerS: number;
  readonly accelMmPerS2: number;
  /** δ: how far the line may leave a sharp corner (blend), or may pretend to (junction deviation). */
  readonly cornerMm: number;
  /** Largest change of acceleration; used in `scurve` mode. */
  readonly jerkMmPerS3: number;
}

export interface MotionSettings {
  readonly mode: MotionMode;
  readonly draw: MotionLimits;
  readonly travel: MotionLimits;
}

export const DEFAULT_MOTION: MotionSettings = {
  mode: "junction",
  draw: { speedMmPerS: 50, accelMmPerS2: 500, cornerMm: 0.05, jerkMmPerS3: 10_000 },
  travel: { speedMmPerS: 150, accelMmPerS2: 1_000, cornerMm: 0.5, jerkMmPerS3: 20_000 },
};

/** Pen heights in percent of the servo's range (100 = highest), and how long the queue waits for the pen. */
export interface PenSettings {
  readonly upPct: number;
  readonly downPct: number;
  readonly liftMs: number;
  readonly dropMs: number;
}

export const DEFAULT_PEN: PenSettings = { upPct: 60, downPct: 30, liftMs: 250, dropMs: 300 };
