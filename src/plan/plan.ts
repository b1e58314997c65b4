/**
 * Plans strokes as a sequence of runs and pen moves. The motion mode decides how each run moves.
 *
 *   travel | drop | draw stroke 0 | lift | travel | drop | draw stroke 1 | lift | travel home
 *
 * The carriage waits for each pen move, or only for the part of it near the paper (pen-flight.ts).
 * A travel of zero length has no run. A dot (a stroke of a single point) is a draw run without blocks. If a
 * stroke begins exactly where the previous one of the same layer ended, the pen stays down.
 */
import { PlotwrightError } from "../errors.js";
import {
  checkStrokes,
  pointCount,
  settingsIdOf,
  strokeCount,
  type StrokeSet,
} from "../drawing/stroke-set.js";
import { penServoOf } from "../machines/pen-servo.js";
import type { MachineProfile, PenServo } from "../machines/profile.js";
import type { Cancellation } from "../prepare/work.js";
import { BlockColumns } from "./block-columns.js";
import { checkSettings } from "./check-settings.js";
import type { Kernel } from "./shaping/impulse-filter.js";
import { drawLimitsOf, runLimits, scaledLimits, type RunLimits } from "./limits.js";
import { loweredBefore, PenMoveWriter } from "./pen/pen-moves.js";
import { dropsInFlight, dropWait, hopLift, liftBefore, lowerDuring, type Lift } from "./pen/pen-flight.js";
import { dropMoveTime, liftTime, penOfLayer, type TimedPen } from "./pen/pen-times.js";
import { Resampler } from "./resample.js";
import { RunPath, SHORTEST_MM } from "./run-path.js";
import { RunWriter, type RunPlanner } from "./run-writer.js";
import { fillAlong } from "./rest/shaped-along.js";
import { shaperKernel } from "./shaping/shapers.js";
import { DEFAULT_MOTION, type MotionSettings } from "../settings/motion.js";
import { withGiven, type DeepPartial } from "../settings/partial.js";
import { DEFAULT_PEN, type PenSettings } from "../settings/pen.js";
import type { StrokePosition, Trajectory } from "./trajectory.js";

/** Where a plan begins and ends. Every option has a default. */
export interface PlanOptions {
  /** Where in the drawing to begin, possibly in the middle of a stroke; default: the start of the drawing. */
  readonly from?: StrokePosition | undefined;
  /** Position of the carriage, mm in the machine frame; default 0, 0. The pen is up there. */
  readonly startX?: number | undefined;
  readonly startY?: number | undefined;
  /**
   * If the carriage is closer than this to `from`, mm, the line continues from the carriage without a travel;
   * default 0.
   */
  readonly penOffsetMm?: number | undefined;
  /**
   * The pen is down at `startX`, `startY`, at rest on the line at `from`. Default false.
   *
   * @internal
   */
  readonly penDown?: boolean | undefined;
  /** Begin with a lift, because the pen's height is unknown. Default false: the pen is up. */
  readonly liftFirst?: boolean | undefined;
  /**
   * Travel to `endX`, `endY` at the end, with the pen up; default true. False: stop where the last stroke
   * ends.
   */
  readonly returnHome?: boolean | undefined;
  /** mm in the machine frame; default 0, 0 (home). */
  readonly endX?: number | undefined;
  readonly endY?: number | undefined;
  /**
   * False: the pen stays down where the last stroke ends, because the stroke goes on later. Default true.
   *
   * @internal
   */
  readonly liftAtEnd?: boolean | undefined;
  /**
   * Strokes whose end may not be known yet (live drawing). Their motion depends only on the points near by, so that it
   * stays the same when more points follow. Default: none.
   *
   * @internal
   */
  readonly mayGrow?: ((stroke: number) => boolean) | undefined;
  /** If given, its motor limits and pen servo apply too: the max step rate, and `motorAccelStepsPerS2`. */
  readonly machine?: MachineProfile | undefined;
  /**
   * Writes the runs instead of the motion mode: the model of a controller that plans its motion by itself.
   *
   * @internal
   */
  readonly runs?: RunPlanner | undefined;
  /**
   * How long the carriage stands for a pen move, s, for a controller that decides that. `waitS`: the time by the model of
   * the servo. From a height to the same one: only a wait.
   *
   * @internal
   */
  readonly penS?: ((fromPct: number, toPct: number, waitS: number) => number) | undefined;
  /**
   * Lower the pen only at the stroke, also with "fast" (pen-flight.ts): for a machine that may lose the end of a travel
   * with its connection. Default false.
   *
   * @internal
   */
  readonly dropsAtStroke?: boolean | undefined;
  /**
   * The pen's servo, instead of the machine's.
   *
   * @internal
   */
  readonly servo?: PenServo | undefined;
  /** Checked before every stroke. */
  readonly cancel?: Cancellation | undefined;
}

/**
 * Plans the motion that draws `strokes` in order, from rest to rest. Linear in the number of points. Settings that are
 * left out have their defaults.
 *
 * @throws PlotwrightError "bad-setting" for settings that contradict each other; "cancelled"
 * @throws RangeError for coordinates that are not finite, or a place that is not in the drawing
 */
export function plan(
  strokes: StrokeSet,
  givenMotion: DeepPartial<MotionSettings> = {},
  givenPen: DeepPartial<PenSettings> = {},
  options: PlanOptions = {},
): Trajectory {
  checkStrokes("plan", strokes);
  const motion = withGiven(DEFAULT_MOTION, givenMotion);
  const pen = withGiven(DEFAULT_PEN, givenPen);
  checkSettings(motion, pen, options.machine);
  const from = checkPlace(options.from, strokeCount(strokes));
  const { machine, startX = 0, startY = 0, penOffsetMm = 0 } = options;
  const { servo = penServoOf(machine) } = options;
  const builder = new PlanBuilder(strokes, motion, { ...pen, servo }, machine, startX, startY, options);
  if (options.liftFirst) builder.liftFirst();
  if (options.penDown === true && from.stroke < strokeCount(strokes)) builder.beginDown(from.stroke);
  for (let stroke = from.stroke; stroke < strokeCount(strokes); stroke++) {
    if (options.cancel?.aborted) throw new PlotwrightError("cancelled", "Planning was cancelled.");
    builder.draw(stroke, stroke === from.stroke ? from.alongMm : 0, penOffsetMm);
  }
  if (options.liftAtEnd === false) return builder.finish();
  builder.lift(Infinity);
  if (options.returnHome ?? true) builder.travel(options.endX ?? 0, options.endY ?? 0);
  return builder.finish();
}

class PlanBuilder {
  private readonly blocks: BlockColumns;
  /** Null: nothing is shaped. */
  private readonly shaper: Kernel | null;
  /** The motion before the shaper, if there is one. */
  private readonly planned: BlockColumns;
  private readonly plannedFirst: Uint32Array;
  private readonly path = new RunPath();
  private readonly resampler = new Resampler();
  private readonly travelPath = new RunPath();
  private readonly writer: RunPlanner;
  private readonly penMoves: PenMoveWriter;
  private runCount = 0;
  private readonly firstBlock: Uint32Array;
  private readonly runStroke: Int32Array;
  private readonly runStartS: Float64Array;
  private readonly travelLimits: RunLimits;
  /** By layer index. */
  private readonly drawLimits: readonly RunLimits[];
  private readonly pens: readonly TimedPen[];
  /**
   * Wait before a layer's first stroke, s. If a layer was split (`partOf`), only its first part has one.
   */
  private readonly waitsS: readonly number[];
  private readonly dropsAtStroke: boolean;
  private readonly penS: PlanOptions["penS"];
  private readonly mayGrow: (stroke: number) => boolean;
  /** The stroke on which the plan begins with the pen down; -1: none. */
  private downAtStroke = -1;
  /** The board waits for whole milliseconds. */
  private readonly waitsWholeMs: boolean;
  /** The pen settings of the current or last stroke. */
  private pen: TimedPen;
  private penUp = true;
  private heightPct: number;
  /** When the last lift of this plan began, s; null: none yet, so the pen's real height may be unknown. */
  private liftS: number | null = null;
  private lastLayer = -1;

  constructor(
    private readonly strokes: StrokeSet,
    private readonly motion: MotionSettings,
    pen: TimedPen,
    machine: MachineProfile | undefined,
    private x: number,
    private y: number,
    {
      runs,
      penS,
      dropsAtStroke = false,
      mayGrow = () => false,
    }: Pick<PlanOptions, "runs" | "penS" | "dropsAtStroke" | "mayGrow"> = {},
  ) {
    this.penS = penS;
    if (!(Math.abs(x) + Math.abs(y) < Infinity)) {
      throw new RangeError(`the start is (${x}, ${y}): it must be finite, in mm`);
    }
    this.pen = pen;
    this.heightPct = pen.upPct;
    this.dropsAtStroke = dropsAtStroke;
    this.mayGrow = mayGrow;
    this.waitsWholeMs = runs === undefined;
    this.pens = strokes.layers.map((layer) => penOfLayer(pen, settingsIdOf(layer)));
    this.drawLimits = strokes.layers.map((layer) =>
      runLimits(drawLimitsOf(motion, settingsIdOf(layer)), motion, machine),
    );
    this.waitsS = strokes.layers.map(({ id }) => (pen.layers?.[id]?.beforeMs ?? 0) / 1_000);
    this.travelLimits = runLimits(motion.travel, motion, machine);
    // Max number of runs: a travel and a draw run for each stroke, and the travel home. Max number of pen moves: for each
    // stroke a lift, a lowering to the hop height, a wait and a drop, and one more at the beginning and at the end, and the
    // drop before the beginning.
    const count = strokeCount(strokes);
    this.firstBlock = new Uint32Array(2 * count + 2);
    this.runStroke = new Int32Array(2 * count + 1);
    this.runStartS = new Float64Array(2 * count + 1);
    this.penMoves = new PenMoveWriter(4 * count + 3);
    // A stroke has one segment fewer than points, and a travel before it. The last segment is the travel home.
    // A controller that plans by itself is not shaped.
    const springs = machine?.springs ?? null;
    this.shaper = runs ? null : shaperKernel(motion.shaper ?? "none", springs);
    const segments = pointCount(strokes) + 1;
    this.blocks = new BlockColumns(segments, motion.mode === "scurve");
    this.planned = new BlockColumns(segments, false);
    this.plannedFirst = new Uint32Array(this.shaper ? 2 * count + 2 : 0);
    this.writer = runs ?? new RunWriter(motion.mode, motion.fit ?? null, this.shaper, springs);
  }

  /**
   * @param penOffsetMm if a stroke begins in the middle and the carriage is closer than this, the line continues from
   *   the carriage
   */
  draw(stroke: number, fromAlong: number, penOffsetMm: number): void {
    const { path, strokes, motion } = this;
    path.load(strokes.xy, strokes.offsets[stroke], strokes.offsets[stroke + 1], fromAlong);
    this.resampler.resample(path);
    if (fromAlong > 0 && path.segmentCount === 0) return;
    const layer = strokes.layer[stroke];
    const awayMm = Math.hypot(path.x[0] - this.x, path.y[0] - this.y);
    const continues = fromAlong > 0 || (stroke === this.downAtStroke && path.segmentCount > 0);
    if (continues && awayMm >= SHORTEST_MM && awayMm < penOffsetMm) path.prependPoint(this.x, this.y);
    const x = path.x[0];
    const y = path.y[0];
    const gap = Math.hypot(x - this.x, y - this.y);
    if (layer !== this.lastLayer || gap >= SHORTEST_MM) this.lift(layer === this.lastLayer ? gap : Infinity);
    const travelS = this.blocks.clockS;
    this.travel(x, y);
    const waitS = fromAlong === 0 && this.beginsLayer(stroke) ? this.waitsS[layer] : 0;
    this.wait(waitS);
    this.lastLayer = layer;
    path.startAt(this.x, this.y);
    this.pen = this.pens[layer];
    this.drop(waitS > 0 ? null : travelS);
    this.beginRun(stroke);
    path.mayGrow = this.mayGrow(stroke);
    if (motion.ease) path.ease(motion.ease.lengthMm);
    const limits = scaledLimits(this.drawLimits[layer], strokes.speedFactor?.[stroke] ?? 1);
    this.writer.write(path, limits, this.blocks, this.planned);
    this.x = path.x[path.segmentCount];
    this.y = path.y[path.segmentCount];
  }

  travel(x: number, y: number): void {
    if (Math.hypot(x - this.x, y - this.y) < SHORTEST_MM) return;
    this.beginRun(-1);
    this.travelPath.setLine(this.x, this.y, x, y);
    this.writer.write(this.travelPath, this.travelLimits, this.blocks, this.planned);
    this.x = x;
    this.y = y;
  }

  /** @param travelMm length of the travel after the lift; for a short one the pen may be lifted less */
  lift(travelMm: number): void {
    if (this.penUp) return;
    this.liftS = this.blocks.clockS;
    this.movePen(true, liftBefore(this.pen, travelMm, this.motion.travel.accelMmPerS2));
  }

  /** The pen was lowered before the plan begins. */
  beginDown(stroke: number): void {
    const layer = this.strokes.layer[stroke];
    this.lastLayer = layer;
    this.downAtStroke = stroke;
    this.pen = this.pens[layer];
    this.penUp = false;
    this.penMoves.push(loweredBefore(this.pen.downPct));
  }

  liftFirst(): void {
    const waitS = liftTime(this.pen, this.heightPct);
    const lift = { heightPct: this.heightPct, waitS, moveS: waitS };
    this.movePen(true, lift, this.blocks.clockS, this.pen.downPct);
  }

  private beginsLayer(stroke: number): boolean {
    const { layer } = this.strokes;
    return stroke === 0 || layer[stroke - 1] !== layer[stroke];
  }

  /** Waits with the pen up, by repeating the move to its current height. */
  private wait(waitS: number): void {
    if (waitS > 0) this.moveInPlace(true, this.heightPct, waitS);
  }

  /** @param travelS start of the travel that has just ended; null if the carriage has waited since */
  private drop(travelS: number | null): void {
    if (!this.penUp) return;
    const { blocks, pen, heightPct, liftS, dropsAtStroke } = this;
    const endS = blocks.clockS;
    if (travelS === null || travelS === endS || liftS === null || !dropsInFlight(pen)) {
      this.moveInPlace(false, pen.downPct, dropWait(pen, heightPct));
      return;
    }
    const travel = { startS: travelS, endS, accel: this.motion.travel.accelMmPerS2, dropsAtStroke };
    const { hoverS, dropS, downS } = lowerDuring(pen, { heightPct, liftS }, travel);
    if (hoverS !== null) this.movePen(true, hopLift(pen), hoverS);
    const moveS = dropMoveTime(pen, this.heightPct - pen.downPct);
    this.movePen(false, { heightPct: pen.downPct, waitS: downS - endS, moveS }, dropS);
  }

  /** A pen move for which the carriage waits. */
  private moveInPlace(up: boolean, heightPct: number, waitS: number): void {
    this.movePen(up, { heightPct, waitS, moveS: waitS });
  }

  private movePen(
    up: boolean,
    lift: Lift,
    startS = this.blocks.clockS,
    fromPct = this.penUp ? this.heightPct : this.pen.downPct,
  ): void {
    const { heightPct } = lift;
    const ownS = this.penS?.(fromPct, heightPct, lift.waitS);
    const waitS = ownS ?? (this.waitsWholeMs ? wholeMs(lift.waitS) : lift.waitS);
    const moveS = ownS ?? lift.moveS;
    this.penUp = up;
    if (up) this.heightPct = heightPct;
    this.penMoves.push({ beforeRun: this.runCount, up, startS, waitS, moveS, heightPct });
    this.blocks.clockS += waitS;
  }

  private beginRun(stroke: number): void {
    const run = this.runCount++;
    this.firstBlock[run] = this.blocks.count;
    this.plannedFirst[run] = this.planned.count;
    this.runStroke[run] = stroke;
    this.runStartS[run] = this.blocks.clockS;
  }

  finish(): Trajectory {
    const { shaper, planned } = this;
    const trajectory = this.trajectoryOf(this.blocks, this.firstBlock);
    if (shaper === null) return trajectory;
    const before = this.trajectoryOf(planned, this.plannedFirst);
    fillAlong(trajectory, before, shaper.meanDelayS);
    return { ...trajectory, planned: { trajectory: before, kernel: shaper } };
  }

  private trajectoryOf(blocks: BlockColumns, firstBlock: Uint32Array): Trajectory {
    const { penMoves, runCount } = this;
    blocks.trim();
    firstBlock[runCount] = blocks.count;
    return {
      ...blocks.ofTrajectory(),
      runs: {
        count: runCount,
        firstBlock: firstBlock.slice(0, runCount + 1),
        stroke: this.runStroke.slice(0, runCount),
        startS: this.runStartS.slice(0, runCount),
      },
      penMoves: penMoves.finish(),
      totalS: this.blocks.clockS,
      endX: this.x,
      endY: this.y,
    };
  }
}

/** Otherwise a difference of half a millisecond per stroke would add up to seconds. */
const wholeMs = (s: number): number => Math.max(0, Math.ceil(1_000 * s - 1e-6)) / 1_000;

function checkPlace(place: StrokePosition | undefined, strokes: number): StrokePosition {
  if (place === undefined) return { stroke: 0, alongMm: 0 };
  const { stroke, alongMm } = place;
  if (!(Number.isInteger(stroke) && stroke >= 0 && stroke <= strokes && alongMm >= 0 && alongMm < Infinity)) {
    throw new RangeError(
      `no place (stroke ${stroke}, ${alongMm} mm) in a drawing of ${strokes} strokes, numbered from 0`,
    );
  }
  return place;
}
