/** The limits of one run in the planner's units, derived from settings and machine. */
import { TICKS_PER_S } from "../units.js";
import type { MachineProfile } from "../machines/profile.js";
import type { RunPath } from "./run-path.js";
import type { LayerMotion, MotionLimits, MotionSettings } from "../settings/motion.js";

export interface RunLimits {
  /** mm/s, mm/s², mm/s³. */
  readonly speed: number;
  readonly accel: number;
  readonly jerk: number;
  /** δ, mm. */
  readonly corner: number;
  /** Max speed along x and along y, mm/s. */
  readonly speedX: number;
  readonly speedY: number;
  /**
   * Stretch of the frame in which runs are planned, so that |a| ≤ `accel` is the limit of both axes there; 1
   * unless an axis has its own limit (axis-frame.ts). `speed`, `speedX`, `speedY` and `motorSpeed` are in the
   * machine's frame.
   */
  readonly stretchX: number;
  readonly stretchY: number;
  /** Max speed of one motor, mm/s along its own axis. */
  readonly motorSpeed: number;
  readonly mixed: boolean;
  /** mm/s, on the parts of the path that are marked for easing. */
  readonly easeSpeed: number;
}

export const NO_LIMITS: RunLimits = {
  speed: Infinity,
  accel: Infinity,
  jerk: Infinity,
  corner: Infinity,
  speedX: Infinity,
  speedY: Infinity,
  stretchX: 1,
  stretchY: 1,
  motorSpeed: Infinity,
  mixed: false,
  easeSpeed: Infinity,
};

/** Merged blocks may exceed their limits by this factor. */
export const SLACK = 1.0009;

/** Share of the board's max step rate that a plan uses, so that rounding to whole rates cannot exceed it. */
const STEP_RATE_SHARE = 0.98;

/**
 * On a mixed machine (H-bot, CoreXY) each motor moves |x ± y|: up to √2 times the carriage's acceleration.
 * The motor's acceleration limit therefore holds in every direction if A ≤ limit/√2. Its speed limit is
 * applied per direction in `capSegments`. Shaping keeps A only in each axis separately, so a motor may get 2 A.
 */
export function runLimits(
  limits: MotionLimits,
  motion: MotionSettings,
  machine: MachineProfile | undefined,
): RunLimits {
  const { motorAccelStepsPerS2, ease } = motion;
  const mixed = machine?.motors === "mixed";
  const perMotor = !mixed ? 1 : (motion.shaper ?? "none") === "none" ? Math.SQRT2 : 2;
  const motorAccel = machine && motorAccelStepsPerS2 ? motorAccelStepsPerS2 / machine.stepsPerMm : Infinity;
  const accelLimit = Math.min(limits.accelMmPerS2, motorAccel / perMotor);
  const accelX = Math.min(accelLimit, motion.accelXMmPerS2 ?? Infinity);
  const accelY = Math.min(accelLimit, motion.accelYMmPerS2 ?? Infinity);
  const accel = Math.max(accelX, accelY);
  return {
    speed: limits.speedMmPerS,
    accel,
    speedX: motion.speedXMmPerS ?? Infinity,
    speedY: motion.speedYMmPerS ?? Infinity,
    stretchX: accel / accelX,
    stretchY: accel / accelY,
    jerk: limits.jerkMmPerS3,
    corner: limits.cornerMm,
    motorSpeed: machine ? (STEP_RATE_SHARE * TICKS_PER_S) / machine.stepsPerMm : Infinity,
    mixed,
    easeSpeed: ease ? ease.speedMmPerS : Infinity,
  };
}

/** The limits of a stroke drawn at `factor` times its layer's speed. */
export const scaledLimits = (limits: RunLimits, factor: number): RunLimits =>
  factor === 1 ? limits : { ...limits, speed: limits.speed * factor };

/**
 * The limits for planning a line that is then shaped. Shaping keeps V only in each axis separately, so on a mixed
 * machine a motor may get 2 V. A straight keeps its direction, so there the limit of `capSegments` is enough.
 */
export const shapedLimits = (path: RunPath, limits: RunLimits): RunLimits =>
  limits.mixed && (path.segmentCount > 1 || path.mayGrow)
    ? { ...limits, speed: Math.min(limits.speed, limits.motorSpeed / 2) }
    : limits;

/** The limits of one layer's strokes. */
export function drawLimitsOf(motion: MotionSettings, layerId: string): MotionLimits {
  const own: LayerMotion = motion.layers?.[layerId] ?? {};
  const { draw } = motion;
  return {
    speedMmPerS: (own.speedMmPerS ?? draw.speedMmPerS) * (own.speedFactor ?? 1),
    accelMmPerS2: own.accelMmPerS2 ?? draw.accelMmPerS2,
    cornerMm: own.cornerMm ?? draw.cornerMm,
    jerkMmPerS3: own.jerkMmPerS3 ?? draw.jerkMmPerS3,
  };
}

/**
 * Acceleration that is allowed in every direction, mm/s²: for a stop, which brakes along the path.
 *
 * @param accel that of the whole motion
 */
export const accelEverywhere = (motion: MotionSettings, accel: number): number =>
  Math.min(accel, motion.accelXMmPerS2 ?? Infinity, motion.accelYMmPerS2 ?? Infinity);

export const isStretched = ({ stretchX, stretchY }: RunLimits): boolean => stretchX !== 1 || stretchY !== 1;

/**
 * Whether V is allowed in every direction: the frame is not stretched, and no axis or motor is slower. In the
 * worst direction a motor runs at √2 (mixed) or 1 (direct) times the carriage's speed.
 */
const isIsotropic = (limits: RunLimits): boolean =>
  !isStretched(limits) &&
  limits.speed <= Math.min(limits.speedX, limits.speedY) &&
  limits.speed <= limits.motorSpeed / (limits.mixed ? Math.SQRT2 : 1);

/** Whether the axes and motors can reach velocity (vx, vy) in the machine frame, with the slack of a merged block. */
export function isVelocityAllowed(
  { speedX, speedY, motorSpeed, mixed }: RunLimits,
  vx: number,
  vy: number,
): boolean {
  const ax = Math.abs(vx);
  const ay = Math.abs(vy);
  return (
    (mixed ? ax + ay : Math.max(ax, ay)) <= motorSpeed * SLACK && ax <= speedX * SLACK && ay <= speedY * SLACK
  );
}

/** mm of the machine for each mm of the planning frame, in direction (ux, uy) of that frame. */
export const mmPerFrameMm = (limits: RunLimits, ux: number, uy: number): number =>
  isStretched(limits) ? Math.hypot(ux / limits.stretchX, uy / limits.stretchY) : 1;

/**
 * Fills `path.cap2` with the max speed² of each segment: V, the easing speed, and the limits of axes and
 * motors in its direction.
 */
export function capSegments(path: RunPath, limits: RunLimits): void {
  const { segmentCount: n, cap2, ux, uy } = path;
  const { speedX, speedY, stretchX, stretchY } = limits;
  const max2 = limits.speed * limits.speed;
  cap2.fill(max2, 0, n);
  if (limits.easeSpeed < limits.speed) {
    cap2.fill(limits.easeSpeed ** 2, 0, Math.min(path.easeUntil, n));
    if (path.easeFrom < n) cap2.fill(limits.easeSpeed ** 2, path.easeFrom, n);
  }
  // With most settings the loop below changes nothing. It takes 20 ms for a million segments.
  if (isIsotropic(limits)) return;
  for (let i = 0; i < n; i++) {
    const ax = Math.abs(ux[i]) / stretchX;
    const ay = Math.abs(uy[i]) / stretchY;
    cap2[i] /= mmPerFrameMm(limits, ux[i], uy[i]) ** 2;
    const motor = limits.motorSpeed / (limits.mixed ? ax + ay : Math.max(ax, ay));
    const max = Math.min(motor, speedX / ax, speedY / ay);
    if (max * max < cap2[i]) cap2[i] = max * max;
  }
}
