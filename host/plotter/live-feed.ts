/**
 * Plans a live drawing while it is drawn. Each plan is one of the known points, and ends at rest at the last of them. When
 * there are more, they are planned again from the same place, and the playback goes on with the longer plan.
 *
 *   origin            pen   sent        end of plan 1
 *     |────────────────·······|──────────────\                 plan 1 brakes for its end
 *     |────────────────·······|──────────────────────────\     plan 2 moves like it up to the braking
 *
 * If the braking is already sent, the pen rests at the end of plan 1, and the next plan begins there. The pen rests on the
 * line for a short time, then it is lifted, and later it comes down on the same point.
 */
import { planJob, type StrokePosition, type StrokeSet, type Trajectory } from "../../src/index.js";
import {
  machineOf,
  type LivePart,
  type Machine,
  type MachineState,
  type MachineCommands,
  type PlannedPlot,
  type Playback,
  type PlaybackGrowth,
} from "../../src/internal.js";
import type { LiveSettings } from "./live-settings.js";
import type { LiveStrokes } from "./live-strokes.js";

/** Time between two looks for new points while the plotter draws, s of this computer. */
const LOOK_S = 0.02;
/** If more than this is planned but not sent, nothing is planned, s of this computer. */
const AHEAD_S = 2;
/** Points in a plan. */
const PLAN_POINTS = 8_000;
/** After so many points of a stroke, its plans begin later. */
const ORIGIN_POINTS = 3_000;
/** How far they then begin before the pen, at least: there the pen moves as if they had begun earlier. */
const BEFORE_PEN_POINTS = 500;
const BEFORE_PEN_MM = 20;

/** Where a plan begins. */
interface Origin {
  readonly stroke: number;
  /** A point of the stroke, at the place or before it. */
  readonly point: number;
  /** mm from the point to the place. */
  readonly afterMm: number;
  /** The carriage. */
  readonly x: number;
  readonly y: number;
  readonly penDown: boolean;
}

/** A plan, and where it ends. */
interface LivePlan {
  readonly origin: Origin;
  readonly trajectory: Trajectory;
  readonly end: StrokePosition;
  /** It draws the points before this one. */
  readonly endPoint: number;
  readonly endsWith: LivePart["end"];
  /** The version of the strokes. */
  readonly version: number;
  /** More points were known, but the plan would have been too long. */
  readonly isCut: boolean;
}

/** The strokes that a plan may draw: all, or those that an undo leaves. */
interface Known {
  readonly points: number;
  readonly strokes: number;
  /** More points of the last one may come. */
  readonly isOpen: boolean;
}

export class LiveFeed {
  private isPlaying = false;
  /** The plan that is played, or was played last. */
  private plan: LivePlan | null = null;
  private readonly plans = new WeakMap<Trajectory, LivePlan>();
  private lookedS = -Infinity;
  private stopLooking: () => void = () => undefined;
  private wake: () => void = () => undefined;

  constructor(
    private readonly source: LiveStrokes,
    private readonly machine: Machine,
    private readonly stream: Playback,
    private readonly settings: LiveSettings,
    /** Where the plot rests, while nothing is played. */
    private readonly restPlace: () => StrokePosition | null,
  ) {
    source.onUndo(() => this.stopForUndo());
    source.onChange(() => {
      this.wake();
      this.look();
    });
  }

  /** Everything is drawn, and the carriage is home. */
  get isOver(): boolean {
    return this.plan?.endsWith === "home";
  }

  /** Call when the user asks for something: a wait at rest ends. */
  interrupt(): void {
    this.wake();
  }

  /**
   * At rest at a place: resolves when there is something to draw, or the drawing has ended. The pen is lifted if points are
   * late or the stroke is complete. It is also lifted if `isInterrupted` becomes true, which ends the wait.
   */
  async untilMore(place: StrokePosition | null, isInterrupted: () => boolean): Promise<void> {
    const { source, machine } = this;
    const { clock, speed } = machine;
    source.restsAt(this.pointsDone(place));
    const liftAtS = clock.nowS() + (source.liftAfterMs / 1_000) * speed;
    for (;;) {
      const hasMore = this.pointsDone(place) < source.pointCount;
      const rests = this.isOnLine(place) && (hasMore || clock.nowS() < liftAtS) && !isInterrupted();
      if (machine.penUp !== true && !rests) await machine.movePen(true, this.settings.current);
      else if (hasMore || source.isEnded || isInterrupted()) return;
      else await this.untilWoken(machine.penUp === true ? null : liftAtS - clock.nowS());
    }
  }

  /** At rest at a place: forgets what is drawn, if that is much. Returns the place in what is left. */
  forget(place: StrokePosition | null): StrokePosition | null {
    if (!place || !this.source.mustForget) return place;
    const rest = this.source.forget(place);
    this.stream.progress.place = rest;
    return rest;
  }

  /** A plan of what is known, from a place where the carriage can begin. `take` tells that it is played. */
  planFrom(place: StrokePosition | null, x: number, y: number, board: MachineState): PlannedPlot {
    const { source, machine } = this;
    const { stroke, alongMm } = this.nextPlace(place);
    const penDown = machine.penUp === false;
    if (stroke >= source.strokeCount) {
      return this.planned({ stroke, point: source.pointCount, afterMm: 0, x, y, penDown: false }, board);
    }
    const point = Math.max(source.firstPointOf(stroke), source.pointsBefore({ stroke, alongMm }) - 1);
    const afterMm = Math.max(0, alongMm - source.alongAt(point));
    return this.planned({ stroke, point, afterMm, x, y, penDown }, board);
  }

  /** A plan of `planFrom` begins to be played, or takes over in motion. */
  take({ trajectory }: PlannedPlot): void {
    this.plan = this.plans.get(trajectory)!;
    this.isPlaying = true;
    this.stopLooking();
    const { clock, speed } = this.machine;
    let cancel = (): void => undefined;
    const next = (): void => {
      const { place } = this.stream.progress;
      if (place) this.source.drawnTo(place);
      this.look();
      cancel = clock.after(LOOK_S * speed, next);
    };
    cancel = clock.after(LOOK_S * speed, next);
    this.stopLooking = () => cancel();
  }

  /** The current plan is not played any more. Returns the place where it ends, if it was played to its end. */
  ended(isStopped: boolean): StrokePosition {
    this.stopLooking();
    this.isPlaying = false;
    const { end, endPoint } = this.plan!;
    if (!isStopped) this.source.restsAt(endPoint);
    return end;
  }

  /**
   * The last stroke is taken back: goes on without it if the pen is before it. If it is on it, or on its way to it, the pen
   * stops and lifts. Returns the place up to which the strokes are drawn, at the last stroke or after it.
   */
  private stopForUndo(): StrokePosition {
    const { source, stream, plan, isPlaying } = this;
    const stroke = source.strokeCount - 1;
    const start = { stroke, alongMm: 0 };
    const nothing = { stroke: stroke + 1, alongMm: 0 };
    const stopped = (): StrokePosition | null => (stream.stopped ? (stream.stopped.place ?? nothing) : null);
    if (!isPlaying || plan === null) {
      const place = this.restPlace() ?? FIRST;
      return this.pointsDone(place) < source.pointCount ? place : nothing;
    }
    const atEnd = plan.endPoint < source.pointCount ? plan.end : nothing;
    if (stream.stopped) return stopped() ?? atEnd;
    const first = source.firstPointOf(stroke);
    if (plan.endPoint <= first) return start;
    const ahead = stream.placeAhead(0);
    if (ahead !== null && ahead.from.stroke < stroke) {
      const { growth } = stream;
      const known = { points: first, strokes: stroke, isOpen: false };
      for (const origin of this.originsOf(plan)) {
        const { trajectory } = this.planned(origin, undefined, known);
        if (growth?.extend(trajectory) !== true) continue;
        this.plan = this.plans.get(trajectory)!;
        return start;
      }
    }
    stream.slowToRest();
    return stopped() ?? atEnd;
  }

  /** Plans again if the current plan does not draw everything that is known. */
  private look(): void {
    const { plan, source, stream } = this;
    const { clock, speed } = this.machine;
    const { growth } = stream;
    if (!plan || !growth || !stream.playing || stream.stopped || source.mustForget) return;
    if (clock.nowS() < this.lookedS + LOOK_S * speed || growth.unsentS > AHEAD_S * speed) return;
    const later = this.laterOrigin(plan);
    if (plan.isCut ? later === null : plan.version === source.version) return this.goOn(plan, growth);
    this.lookedS = clock.nowS();
    for (const origin of this.originsOf(plan)) {
      const { trajectory } = this.planned(origin);
      if (!growth.extend(trajectory)) continue;
      this.plan = this.plans.get(trajectory)!;
      return;
    }
    this.goOn(plan, growth);
  }

  /** When the current plan is sent to its end: goes on from its end, if its last stroke or another one goes on there. */
  private goOn({ end, endPoint, endsWith, trajectory }: LivePlan, growth: PlaybackGrowth): void {
    const { source } = this;
    if (growth.unsentS > 0 || endPoint === source.pointCount) return;
    const penDown = endsWith === "down";
    if (penDown && !this.isOnLine(end)) return;
    const point = penDown ? endPoint - 1 : endPoint;
    const { endX: x, endY: y } = trajectory;
    const next = this.planned({ stroke: end.stroke, point, afterMm: 0, x, y, penDown });
    if (growth.append(next.trajectory)) this.plan = this.plans.get(next.trajectory)!;
  }

  /** The start of the stroke that is being drawn, or a place on it well before the pen; null: nothing is later. */
  private laterOrigin({ origin }: LivePlan): Origin | null {
    const { source, stream } = this;
    const { place } = stream.progress;
    if (!place || place.stroke >= source.strokeCount) return null;
    const { stroke, alongMm } = place;
    if (stroke > origin.stroke) return this.originAt(stroke, source.firstPointOf(stroke));
    let point = source.pointsBefore(place) - BEFORE_PEN_POINTS;
    if (stroke < origin.stroke || point - origin.point < ORIGIN_POINTS) return null;
    while (point > origin.point && alongMm - source.alongAt(point) < BEFORE_PEN_MM) point--;
    return point - origin.point < ORIGIN_POINTS ? null : this.originAt(stroke, point);
  }

  /** Where another plan can begin that takes over from a plan. */
  private originsOf(plan: LivePlan): readonly Origin[] {
    const later = this.laterOrigin(plan);
    return later ? [later, plan.origin] : [plan.origin];
  }

  private originAt(stroke: number, point: number): Origin {
    const { xy } = this.source.strokes;
    return { stroke, point, afterMm: 0, x: xy[2 * point], y: xy[2 * point + 1], penDown: true };
  }

  private planned(origin: Origin, board?: MachineState, known = this.allKnown()): PlannedPlot {
    const { source, settings, machine } = this;
    const endPoint = this.endOfPlan(origin, known.points);
    const isCut = endPoint < known.points;
    const last = isCut ? source.strokeOf(endPoint) : known.strokes - 1;
    const isOpen = isCut ? endPoint > source.firstPointOf(last) : known.isOpen;
    const endsWith = isOpen ? "down" : source.isEnded && !isCut ? "home" : "up";
    const strokeEnd = isCut && !isOpen ? last : last + 1;
    const { planned } = settings;
    const job = planJob(
      { strokes: partOf(source.strokes, origin, strokeEnd, endPoint) },
      planned,
      machineOf(planned),
      {
        from: { stroke: 0, alongMm: origin.afterMm },
        startXMm: origin.x,
        startYMm: origin.y,
        firmware: machine.firmware,
        board,
        live: {
          penDown: origin.penDown,
          end: endsWith,
          mayGrow: (stroke) => source.mayGrow(origin.stroke + stroke),
        },
      },
    );
    const { trajectory } = job;
    place(trajectory, origin.stroke, source.alongAt(origin.point));
    const end = isOpen
      ? { stroke: last, alongMm: source.alongAt(endPoint - 1) }
      : { stroke: strokeEnd, alongMm: 0 };
    const { version } = source;
    this.plans.set(trajectory, { origin, trajectory, end, endPoint, endsWith, version, isCut });
    return { trajectory, commands: board ? job.commands() : NO_COMMANDS };
  }

  private allKnown(): Known {
    const { pointCount: points, strokeCount: strokes, isOpen } = this.source;
    return { points, strokes, isOpen };
  }

  /** The points that a plan can have. Only strokes that may grow are cut. */
  private endOfPlan({ point }: Origin, pointCount: number): number {
    const { source } = this;
    const end = point + PLAN_POINTS;
    if (end >= pointCount) return pointCount;
    const stroke = source.strokeOf(end);
    return source.mayGrow(stroke) ? end : source.firstPointOf(stroke);
  }

  /** Whether a pen that rests at a place is on a stroke that goes on. */
  private isOnLine(place: StrokePosition | null): boolean {
    const { source } = this;
    if (!place || place.stroke >= source.strokeCount) return false;
    const isLast = place.stroke === source.strokeCount - 1;
    return (isLast && source.isOpen) || this.pointsDone(place) < source.firstPointOf(place.stroke + 1);
  }

  /** Where the plot goes on: after a stroke that is complete, at the next one. */
  private nextPlace(place: StrokePosition | null): StrokePosition {
    if (!place || place.stroke >= this.source.strokeCount || this.isOnLine(place)) return place ?? FIRST;
    return { stroke: place.stroke + 1, alongMm: 0 };
  }

  /** Number of points drawn when the pen rests at a place. */
  private pointsDone(place: StrokePosition | null): number {
    if (place && place === this.plan?.end) return this.plan.endPoint;
    return place ? this.source.pointsBefore(place) : 0;
  }

  /** `leftS`: at most so long; null: without a limit. */
  private async untilWoken(leftS: number | null): Promise<void> {
    let cancel = (): void => undefined;
    await new Promise<void>((resolve) => {
      this.wake = resolve;
      if (leftS !== null) cancel = this.machine.clock.after(Math.max(0, leftS), resolve);
    });
    cancel();
    this.wake = () => undefined;
  }
}

const FIRST: StrokePosition = { stroke: 0, alongMm: 0 };
/** A plan that goes on is compiled by the playback, from where the machine is then. */
const NO_COMMANDS: MachineCommands = { count: 0, planS: new Float64Array(1), warnings: [] };

/** The strokes from the point of an origin on. */
function partOf(
  { xy, offsets, layer, layers }: StrokeSet,
  { stroke, point }: Origin,
  strokeEnd: number,
  endPoint: number,
): StrokeSet {
  const own = offsets
    .slice(stroke, strokeEnd + 1)
    .map((first) => Math.min(Math.max(first, point), endPoint) - point);
  return {
    xy: xy.subarray(2 * point, 2 * endPoint),
    offsets: own,
    layer: layer.subarray(stroke, strokeEnd),
    layers,
  };
}

/** Numbers a plan's strokes as in the whole drawing; `alongMm`: of its first stroke. */
function place({ planned, runs, alongMm: along }: Trajectory, firstStroke: number, alongMm: number): void {
  for (let run = 0; run < runs.count; run++) {
    if (runs.stroke[run] < 0) continue;
    if (runs.stroke[run] === 0) {
      for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1]; k++) along[k] += alongMm;
    }
    runs.stroke[run] += firstStroke;
  }
  if (planned) place(planned.trajectory, firstStroke, alongMm);
}
