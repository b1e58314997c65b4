/**
 * One plot on the board: plays plans, brings them to rest along the path, and switches from one plan to another in
 * motion. The caller decides what is drawn, and when.
 *
 * Commands already written to the board (at most the streamer's window) cannot be changed. Any change applies after
 * them.
 */
import type { StrokeSet } from "../../../drawing/stroke-set.js";
import { PlotwrightError } from "../../../errors.js";
import { positionFromMotors } from "../../../machines/motors.js";
import { machineOf } from "../../../machines/profiles.js";
import { comeToRest } from "../../../plan/rest/come-to-rest.js";
import { isPenUpBefore, penMoveBefore, penMoveColumns, penMovesOf } from "../../../plan/pen/pen-moves.js";
import { reseatWaitS } from "../../../plan/pen/pen-times.js";
import type { StrokePosition, Trajectory } from "../../../plan/trajectory.js";
import { strokeLengthMm } from "../../../position/on-drawing.js";
import { endOfPlan, passOf } from "../../../position/on-plan.js";
import { drawnPosition, estimatedPosition, stoppedPosition } from "../../../position/pen-position.js";
import { sameMotionS } from "../../../position/same-motion.js";
import type { Playback, PlaybackGrowth, PlaceAhead, PlaybackEvents, PlaybackRequest } from "../../driver.js";
import type { MachineSettings, PlannedPlot } from "../../machine-job.js";
import {
  PAST_PARTS,
  PAST_PARTS_GROWING,
  PlaybackProgress,
  type PenMoment,
  type PlanPart,
  type PlotProgress,
} from "../../playback-progress.js";
import { streamOf, type BoardState, type CommandStream } from "../compile/command-stream.js";
import { compile } from "../compile/compile.js";
import { penCommand } from "../protocol/commands.js";
import {
  boardStateBefore,
  commandAfter,
  penMovesInRun,
  restingStream,
  withoutDrop,
} from "../stream/cut-streams.js";
import type { PollTime } from "../stream/stream-types.js";
import type { Streamer } from "../stream/streamer.js";
import type { StreamSpan } from "../stream/timeline.js";
import { brakingAt } from "./braking.js";
import type { Carriage } from "./carriage.js";

/** Max distance of a carriage that follows the plan: rounding to steps, mm. */
const ON_PLAN_MM = 0.05;
/** A place nearer than this to the end of a stroke counts as its end. */
const EDGE_MM = 0.05;

/** A part of a run, in the form that the board receives. */
interface EbbPart extends PlanPart {
  readonly commands: CommandStream;
  /** The board's state before its first command. */
  readonly start: BoardState;
}

/** A command and the time it takes in the board's queue, s. */
type TimedLine = readonly [line: string, durationS: number];

/** A path to rest, and the state after it. */
interface Rest {
  readonly part: EbbPart;
  /** The first place still to be drawn; null if everything is drawn. */
  readonly place: StrokePosition | null;
  readonly state: BoardState;
}

export class EbbPlayback implements Playback, PlaybackGrowth {
  /** Set when the stream was stopped on purpose: the first place still to be drawn. */
  stopped: { readonly place: StrokePosition | null } | null = null;
  readonly progress: PlaybackProgress<EbbPart>;

  readonly growth: PlaybackGrowth = this;
  private streamer: Streamer | null = null;
  /** The part with which the current play began. */
  private firstPart: EbbPart | null = null;
  private readonly events: PlaybackEvents;
  /** The error with which an emergency stop ends the current play. */
  private emergency: PlotwrightError | null = null;
  /** The last place that the board certainly reached with its motors powered. */
  private certain: StrokePosition | null = null;
  /** Set by `fail`: nothing more may be streamed. */
  private failure: PlotwrightError | null = null;

  constructor(
    private readonly carriage: Carriage,
    private readonly request: PlaybackRequest,
  ) {
    this.events = request.events;
    this.progress = new PlaybackProgress(request.grows ? PAST_PARTS_GROWING : PAST_PARTS);
  }

  private get strokes(): StrokeSet {
    return this.request.strokes;
  }

  private get settings(): MachineSettings {
    return this.request.settings();
  }

  /** Still set after all commands are written, until the board is at rest. */
  get playing(): object | null {
    return this.streamer;
  }

  now(): PlotProgress | null {
    return this.streamer && this.progress.update(this.streamer.position());
  }

  ahead(stepS: number, count: number): readonly PenMoment[] {
    return this.streamer ? this.progress.ahead(this.streamer.positionsAhead(stepS, count)) : [];
  }

  /** Switching to another plan; until that is done, no third plan is accepted. */
  get isSwitching(): boolean {
    return this.streamer?.isSwitching ?? false;
  }

  get receivedPlace(): StrokePosition | undefined {
    const at = this.streamer?.receivedPlace();
    if (!at || !this.progress.includes(at.stream)) return undefined;
    const { trajectory, next } = this.progress.partOf(at.stream);
    const isFirstTravel = at.stream === this.firstPart?.commands && at.planS <= firstStrokeS(trajectory);
    if (isFirstTravel) return undefined;
    return (
      estimatedPosition(trajectory, at.planS) ?? next ?? endOfPlan(this.strokes, trajectory) ?? undefined
    );
  }

  /** Plays a plan to its end, or to a hold, with the pen up at first; `afterS`: time of the plot after this plan. */
  async play(plot: PlannedPlot, afterS: number, begun: () => void): Promise<void> {
    const { carriage } = this;
    this.stopped = null;
    this.emergency = null;
    // `fail` may have been called while the pen was lifted.
    if (this.failure) throw this.failure;
    const { trajectory: whole } = plot;
    const commands = streamOf(plot.commands);
    this.firstPart = { trajectory: whole, commands, start: carriage.position.state!, afterS };
    this.progress.add(this.firstPart);
    this.certain = estimatedPosition(whole, commands.planS[0]);
    const streamer = carriage.upkeep.streamer(this.settings, (steps, asked) => this.reached(steps, asked));
    // First, because a reply that comes at once may call `fail`.
    this.streamer = streamer;
    const { mark } = carriage.position;
    mark.noteRun(this.request.run);
    const played = carriage.play(streamer, plot, this.settings);
    begun();
    let left: StrokePosition | null = null;
    try {
      const report = await played;
      const { trajectory } = this.progress.partOf(report.end.stream);
      const planS = report.end.stream.planS[report.end.commandIndex + 1];
      // A play stopped while the carriage was at rest ends in the middle of the plan; its path to rest has no command.
      const isWhole = report.complete && !this.stopped;
      const penUp = isPenUpBefore(trajectory, isWhole ? Infinity : planS);
      carriage.pen.isUp = penUp;
      // The board is at rest, so the pen is too, even if its planned end is slightly later by rounding.
      this.events.progressed({
        ...this.progress.update({ ...report.end, planS: isWhole ? trajectory.totalS : planS }),
        penUp,
        penMoving: false,
      });
      left = this.whereStopped() ?? this.progress.place;
    } catch (error) {
      // The play may have failed for another reason before the stop was requested.
      if (error === this.emergency) {
        // Counts if the position cannot be read back. Without step counters, the estimate counts.
        if (carriage.connection.features.hasStepQuery) left = this.certain;
        left = await this.afterEmergency(streamer);
      } else {
        // Without a state, the position is lost.
        const isRefused = streamer.refused.length > 0 && carriage.position.state;
        left = isRefused ? await this.afterRefusal(streamer) : this.certain;
        throw error;
      }
    } finally {
      this.events.ended(left);
      this.streamer = null;
    }
    // The place that is stored is exact. At home, nothing is drawn that it does not count.
    if (this.wasStopped() || isAtHome(carriage.position.state)) mark.noteRun(null);
    if (this.wasStopped() && carriage.pen.isUp !== true) await carriage.pen.move(true, this.settings);
  }

  /** Cuts the stream after what the board already has, and appends the path to rest. */
  slowToRest(): void {
    const { streamer } = this;
    if (!streamer?.playing || this.stopped) return;
    const cut = streamer.cut();
    const part = this.progress.partOf(cut.stream);
    const rest = this.restAt(part, cut.commandIndex, true);
    this.stopped = { place: rest.place };
    this.progress.add(rest.part);
    streamer.replace(rest.part.commands);
  }

  /** Clears the board's queue: it stops at once, and `play` ends with the position read back. */
  stopAtOnce(): void {
    if (!this.streamer) return;
    this.emergency ??= new PlotwrightError("conflict", "The plot was stopped at once.");
    this.carriage.upkeep.noteEmergencyStop(this.settings);
    this.streamer.stopAtOnce(this.emergency);
  }

  /** Stops the motors for good: the current play, or the next one, fails with the error. */
  fail(error: PlotwrightError): void {
    this.failure = error;
    if (this.streamer) this.streamer.stopAtOnce(error);
    else this.carriage.connection.session.write([{ line: "ES" }]);
  }

  /**
   * A place at least `leadS` ahead that the board has not received yet; null if too little is left. The pen is either
   * up there or within a stroke. The end of a stroke is excluded, because a new plan would start there with the pen down.
   */
  placeAhead(leadS: number): PlaceAhead | null {
    const { streamer } = this;
    if (!streamer?.playing) return null;
    const part = this.progress.partOf(streamer.nextStream);
    let index = commandAfter(part.commands, streamer.nextIndex, leadS);
    for (; index < part.commands.count; index++) {
      const rest = this.restAt(part, index, false);
      if (!rest.place) return null;
      const isDown = !isPenUpBefore(part.trajectory, part.commands.planS[index]);
      if (isDown && !isWithinStroke(this.strokes, rest.place)) continue;
      const { endX: x, endY: y } = rest.part.trajectory;
      const from = rest.place;
      const switchTo = (plot: PlannedPlot, afterS: number): boolean =>
        this.switchTo({ index, part, rest, isDown }, plot, afterS);
      return { from, x, y, board: rest.state, switchTo };
    }
    return null;
  }

  private switchTo(
    { index, part, rest, isDown }: { index: number; part: EbbPart; rest: Rest; isDown: boolean },
    plot: PlannedPlot,
    afterSectionS: number,
  ): boolean {
    const { streamer } = this;
    if (streamer?.nextStream !== part.commands) return false;
    const { trajectory } = rest.part;
    const planned = streamOf(plot.commands);
    const { setUp, afterDrop: commands } = isDown ? withoutDrop(planned) : { setUp: [], afterDrop: planned };
    const lines = setUp.map((line): TimedLine => [line, 0]);
    if (isDown) {
      const fromPct = downPctAt(part.trajectory, part.commands.planS[index]);
      lines.push(...this.reseat(rest.place, fromPct, downPctAt(plot.trajectory, 0)));
    }
    const heights = restingStream(lines, rest.state, trajectory.totalS);
    if (!streamer.cutAt(index, rest.part.commands, heights, commands)) return false;
    const afterS = plot.trajectory.totalS + afterSectionS;
    this.progress.add({ ...rest.part, afterS });
    this.progress.add({ commands: heights, trajectory, start: rest.state, afterS, next: rest.place });
    this.progress.add({ commands, trajectory: plot.trajectory, start: rest.state, afterS: afterSectionS });
    return true;
  }

  get unsentS(): number {
    const { streamer } = this;
    if (!streamer?.playing) return 0;
    const { trajectory, commands } = this.progress.partOf(streamer.nextStream);
    return trajectory.totalS - commands.planS[streamer.nextIndex];
  }

  extend(plan: Trajectory): boolean {
    const { streamer } = this;
    if (!streamer?.playing || streamer.isSwitching || this.stopped) return false;
    const { trajectory, commands } = this.progress.partOf(streamer.nextStream);
    const fromS = sameMotionS(trajectory, commands.planS[streamer.nextIndex], plan);
    return fromS !== null && this.goOn(streamer, plan, fromS);
  }

  append(plan: Trajectory): boolean {
    const { streamer } = this;
    if (!streamer?.playing || streamer.isSwitching || this.stopped) return false;
    return streamer.nextIndex === streamer.nextStream.count && this.goOn(streamer, plan, 0);
  }

  /** Sends another plan from `fromS` on, in place of what is not sent. */
  private goOn(streamer: Streamer, plan: Trajectory, fromS: number): boolean {
    const part = this.progress.partOf(streamer.nextStream);
    const start = boardStateBefore(part.commands, streamer.nextIndex, part.start);
    const commands = compile(plan, {
      machine: machineOf(this.settings),
      firmware: this.carriage.connection.features.version,
      pen: this.settings.pen,
      start,
      fromS,
      penMovesDue: penMovesInRun(part.commands, streamer.nextIndex),
    });
    const isUnsent = streamer.nextIndex === 0 && part !== this.firstPart;
    this.progress.add({ commands, trajectory: plan, start, afterS: 0 });
    streamer.replace(commands);
    if (isUnsent) this.progress.remove(part);
    return true;
  }

  private brakingAt(place: StrokePosition | null): ReturnType<typeof brakingAt> {
    return brakingAt(this.settings, this.strokes, place, this.carriage.connection.features.version);
  }

  /** The path to rest that begins before a command that is not yet written. */
  private restAt(part: EbbPart, index: number, lifts: boolean): Rest {
    const { commands, trajectory } = part;
    const fromS = commands.planS[index];
    const { limits, pen } = this.brakingAt(estimatedPosition(trajectory, fromS));
    const rest = comeToRest(trajectory, fromS, limits, lifts ? pen : null);
    const { trajectory: restTrajectory, planS } = rest;
    const leftS = Math.max(0, trajectory.totalS - planS) + part.afterS;
    const start = boardStateBefore(commands, index, part.start);
    const restCommands = compile(restTrajectory, {
      machine: machineOf(this.settings),
      firmware: this.carriage.connection.features.version,
      pen,
      start,
    });
    const state = boardStateBefore(restCommands, restCommands.count, start);
    const end = { x: restTrajectory.endX, y: restTrajectory.endY };
    const next = drawnPosition(this.strokes, trajectory, planS, end) ?? part.next ?? null;
    const path = withPenOf(trajectory, fromS, restTrajectory);
    return {
      part: { commands: restCommands, trajectory: path, start, afterS: leftS, next },
      place: next,
      state,
    };
  }

  /** Moves a pen that is down to another down height. */
  private reseat(place: StrokePosition | null, fromPct: number, heightPct: number): TimedLine[] {
    const distancePct = Math.abs(heightPct - fromPct);
    if (distancePct === 0) return [];
    const { pen } = this.brakingAt(place);
    const waitS = reseatWaitS(pen, distancePct);
    const move = { up: false, heightPct, ratePctPerS: pen.dropPctPerS };
    return [[penCommand(machineOf(this.settings), move, 1_000 * waitS), waitS]];
  }

  /** Step counters that the board reported during the play. */
  private reached([steps1, steps2]: readonly [number, number], asked: PollTime): void {
    const at = positionFromMotors(machineOf(this.settings), steps1, steps2);
    const pass = this.streamer && passOf(this.partsOf(this.streamer.spansAt(asked)), at);
    if (!pass || pass.awayMm > ON_PLAN_MM) return;
    const { part } = pass.span;
    this.certain = drawnPosition(this.strokes, part.trajectory, pass.planS, at) ?? this.afterPart(part);
  }

  /** Parts of streams, with their plans. */
  private partsOf(spans: readonly StreamSpan[]): (StreamSpan & { part: EbbPart; trajectory: Trajectory })[] {
    const known = spans.filter(({ stream }) => this.progress.includes(stream));
    return known.map((span) => {
      const part = this.progress.partOf(span.stream);
      return { ...span, part, trajectory: part.trajectory };
    });
  }

  /** The user stopped the board at once. */
  private async afterEmergency(streamer: Streamer): Promise<StrokePosition | null> {
    const place = await this.positionAfterStop(streamer);
    this.stopped = { place };
    // Of the next plan, which may only go home, this is all that is known.
    if (place) this.progress.place = place;
    return place;
  }

  /** The board refused commands, and was stopped at once. */
  private async afterRefusal(streamer: Streamer): Promise<StrokePosition | null> {
    const { carriage } = this;
    try {
      const place = await this.positionAfterStop(streamer);
      await carriage.pen.move(true, this.settings);
      return place;
    } catch {
      // The position cannot be read back, so home has to be set again.
      await carriage.position.forget().catch(() => undefined);
      return this.certain;
    }
  }

  /** The board's queue is cleared: the counters show how far it drew. */
  private async positionAfterStop(streamer: Streamer): Promise<StrokePosition | null> {
    const { carriage, strokes } = this;
    await carriage.position.readBack();
    carriage.pen.isUp = null;
    // The board counts on if the supply fails just before or after the stop.
    if (await carriage.upkeep.supply.wasLow()) return this.certain;
    const machine = machineOf(this.settings);
    const spans = this.partsOf(streamer.spansAtStop(carriage.connection.features));
    const stop = stoppedPosition(strokes, spans, carriage.position.mm(machine)!, machine.springs ?? null);
    return stop ? (stop.place ?? this.afterPart(stop.pass.span.part)) : this.certain;
  }

  /** The first place still to be drawn when a part is drawn; at the end of the plan, the end of its last stroke. */
  private afterPart({ next, trajectory }: EbbPart): StrokePosition | null {
    return next ?? endOfPlan(this.strokes, trajectory) ?? this.progress.place;
  }

  // These two are methods because TypeScript does not know that events may set `stopped` during `play`.
  private wasStopped(): boolean {
    return this.stopped !== null;
  }

  private whereStopped(): StrokePosition | null {
    return this.stopped?.place ?? null;
  }
}

/**
 * A path that begins with the pen as it is at `tS` of the trajectory before it: a stop on that path then lifts a pen that
 * is down, and no instant before the lift counts as lifted.
 */
function withPenOf(before: Trajectory, tS: number, path: Trajectory): Trajectory {
  const last = penMoveBefore(before, tS);
  if (!last || last.up) return path;
  const lowered = { ...last, beforeRun: 0, startS: -1, waitS: 0, moveS: 0 };
  return { ...path, penMoves: penMoveColumns([lowered, ...penMovesOf(path)]) };
}

/** The height that the last drop before `tS` lowers the pen to; if there is none, that of the first drop. */
function downPctAt({ penMoves }: Trajectory, tS: number): number {
  const { count, up, startS, heightPct } = penMoves;
  let drop = up.indexOf(0);
  for (let i = drop + 1; i < count && startS[i] < tS; i++) if (up[i] === 0) drop = i;
  return heightPct[drop];
}

/** When the first stroke begins. */
function firstStrokeS({ runs }: Trajectory): number {
  const run = runs.stroke.findIndex((stroke) => stroke >= 0);
  return run < 0 ? Infinity : runs.startS[run];
}

const isAtHome = (state: BoardState | null): boolean => state?.steps1 === 0 && state.steps2 === 0;

const isWithinStroke = (strokes: StrokeSet, { stroke, alongMm }: StrokePosition): boolean =>
  alongMm > EDGE_MM && alongMm < strokeLengthMm(strokes, stroke) - EDGE_MM;
