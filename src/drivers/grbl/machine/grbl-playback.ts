/**
 * One plot on a Grbl. A stop clears Grbl's queue, so the rest is planned again from the reported position. A Grbl cannot
 * switch to another plan in motion.
 */
import type { StrokeSet } from "../../../drawing/stroke-set.js";
import { PlotwrightError } from "../../../errors.js";
import { passesOf } from "../../../geometry/passes.js";
import { machineOf } from "../../../machines/profiles.js";
import { penMovesOf } from "../../../plan/pen/pen-moves.js";
import { stateAt, type StrokePosition, type Trajectory } from "../../../plan/trajectory.js";
import { endOfPlan, passOf } from "../../../position/on-plan.js";
import { drawnPosition, estimatedPosition } from "../../../position/pen-position.js";
import type { Machine, Playback, PlaybackEvents, PlaybackRequest } from "../../driver.js";
import type { MachineSettings, PlannedPlot } from "../../machine-job.js";
import { PlaybackProgress, type PenMoment, type PlotProgress } from "../../playback-progress.js";
import { grblCommandsOf, type GrblCommands } from "../grbl-job.js";
import { findsHome } from "../model/grbl-controller.js";
import { boardRestartedError, withUnsureHeight } from "../protocol.js";
import type { LineStream } from "./line-stream.js";

/** A stop farther from the plan than this shows that the Grbl counts from another place, because it has restarted. */
const LOST_MM = 2;

/** The parts of the machine that a run uses. */
interface GrblCarriage extends Pick<Machine, "penUp" | "movePen" | "positionMm" | "forgetPosition"> {
  /** Throws if the lines cannot be played. */
  stream(commands: GrblCommands): LineStream;
  /** Whether an unfinished plot moves the carriage, for the next connection. */
  noteRun(run: number | null): Promise<void>;
  /** Called after a job has been played to its end. */
  arrived(): Promise<void>;
  /**
   * Called after a play that did not reach its end. `penUp`: the pen at the end; null: unknown. Returns false if the Grbl
   * no longer knows the height of its pen.
   */
  recover(stream: LineStream, settings: MachineSettings, penUp: boolean | null): Promise<boolean>;
  /** Lifts the pen after a fault; returns the error, which also says if that failed. */
  liftAfter(error: PlotwrightError, settings: MachineSettings): Promise<PlotwrightError>;
}

interface Playing {
  readonly plot: PlannedPlot;
  readonly commands: GrblCommands;
  readonly stream: LineStream;
}

export class GrblPlayback implements Playback {
  readonly progress = new PlaybackProgress();
  stopped: { readonly place: StrokePosition | null } | null = null;
  readonly isSwitching = false;

  private current: Playing | null = null;
  /** The error with which a requested stop ends the current play. */
  private requested: PlotwrightError | null = null;
  private isEmergency = false;
  private failure: PlotwrightError | null = null;
  private isHeightKnown = true;
  /** `receivedPlace` and `sentAheadS` when the last play failed. */
  private receivedAtEnd: StrokePosition | undefined = undefined;
  private aheadAtEndS: number | undefined = undefined;
  private readonly strokes: StrokeSet;
  private readonly events: PlaybackEvents;

  constructor(
    private readonly machine: GrblCarriage,
    private readonly request: PlaybackRequest,
  ) {
    this.strokes = request.strokes;
    this.events = request.events;
  }

  get playing(): object | null {
    return this.current;
  }

  get receivedPlace(): StrokePosition | undefined {
    if (!this.current) return this.receivedAtEnd;
    const { plot, stream } = this.current;
    const planS = stream.receivedS;
    if (planS === null || planS <= firstStrokeS(plot.trajectory)) return undefined;
    return estimatedPosition(plot.trajectory, planS) ?? endOfPlan(this.strokes, plot.trajectory) ?? undefined;
  }

  sentAheadS(withinS: number): number | undefined {
    if (!this.current) return this.aheadAtEndS;
    const { stream } = this.current;
    return stream.sentS(withinS) - stream.boundsS[0];
  }

  now(): PlotProgress | null {
    if (!this.current) return null;
    const { commands, stream } = this.current;
    return this.progress.update({ stream: commands, planS: stream.planS });
  }

  ahead(stepS: number, count: number): readonly PenMoment[] {
    if (!this.current) return [];
    const { commands, stream } = this.current;
    return this.progress.ahead(stream.timesAhead(stepS, count).map((planS) => ({ stream: commands, planS })));
  }

  async play(plot: PlannedPlot, afterS: number, begun: () => void): Promise<void> {
    const { machine, progress } = this;
    this.stopped = null;
    this.requested = null;
    this.isEmergency = false;
    this.receivedAtEnd = this.aheadAtEndS = undefined;
    await machine.noteRun(this.request.run);
    // `fail` may have been called while the pen was lifted.
    if (this.failure) throw this.failure;
    const commands = grblCommandsOf(plot.commands);
    const stream = machine.stream(commands);
    progress.add({ commands, trajectory: plot.trajectory, afterS });
    this.current = { plot, commands, stream };
    const played = stream.play();
    begun();
    let left: StrokePosition | null = null;
    try {
      await played;
      await machine.arrived();
      await machine.noteRun(null);
      this.events.progressed(progress.update({ stream: commands, planS: plot.trajectory.totalS }));
      left = progress.place;
    } catch (error) {
      // Before the stream is asked to stop.
      this.receivedAtEnd = this.receivedPlace;
      this.aheadAtEndS = this.sentAheadS(0);
      left = certainPosition(this.current) ?? progress.place;
      // The caller of `fail` takes care of the machine.
      if (this.failure || !(error instanceof PlotwrightError)) throw error;
      left = await this.whereStopped(this.current);
      const settings = this.request.settings();
      const isLost = machine.positionMm(machineOf(settings)) === null;
      // The Grbl may have failed before the stop was requested.
      if (isLost || error !== this.requested) {
        const lost = boardRestartedError(findsHome(machineOf(settings)));
        const cause = error === this.requested ? lost : error;
        throw await machine.liftAfter(this.isHeightKnown ? cause : withUnsureHeight(cause), settings);
      }
      this.stopped = { place: left };
      // Of the next plan, which may only go home, this is all that is known.
      if (left) progress.place = left;
    } finally {
      this.current = null;
      this.events.ended(left);
    }
    if (this.wasStopped()) await machine.movePen(true, this.request.settings());
  }

  slowToRest(): void {
    this.current?.stream.slowDown((this.requested ??= stopped()));
  }

  stopAtOnce(): void {
    this.isEmergency = true;
    this.current?.stream.stop((this.requested ??= stopped()));
  }

  fail(error: PlotwrightError): void {
    this.failure = error;
    this.current?.stream.abandon(error);
  }

  placeAhead(): null {
    return null;
  }

  /** Clears Grbl's queue. Its position shows how far it drew; if that is lost, the place is forgotten. */
  private async whereStopped(current: Playing): Promise<StrokePosition | null> {
    const { machine, progress, strokes } = this;
    const { plot, commands, stream } = current;
    const settings = this.request.settings();
    this.isHeightKnown = await machine.recover(stream, settings, penBetween(plot.trajectory, stream.boundsS));
    if (stream.wasMoved) return certainPosition(current) ?? progress.place;
    const at = machine.positionMm(machineOf(settings));
    const { trajectory } = plot;
    const [fromS, toS] = stream.boundsS;
    const pass = at && passOf([{ trajectory, fromS, toS, estimateS: stream.planS }], at);
    const cut = stream.shortCutS;
    const isAway = pass !== null && pass.awayMm > LOST_MM;
    if (!pass || (isAway && !(cut && awayFromCut(trajectory, at, cut) <= LOST_MM))) {
      await machine.forgetPosition();
      return certainPosition(current) ?? progress.place;
    }
    const planS = Math.min(pass.planS, stream.missedS ?? Infinity);
    this.events.progressed({ ...progress.update({ stream: commands, planS }), xMm: at.x, yMm: at.y });
    // After missed lines the carriage is not at the position from which to draw.
    const carriage = planS < pass.planS ? stateAt(trajectory, planS) : at;
    const position = drawnPosition(strokes, trajectory, planS, carriage);
    return position ?? (this.isEmergency ? (endOfPlan(strokes, trajectory) ?? progress.place) : null);
  }

  // A method because TypeScript does not know that events may set `stopped` during `play`.
  private wasStopped(): boolean {
    return this.stopped !== null;
  }
}

/** When the first stroke of a plan begins. */
function firstStrokeS({ runs }: Trajectory): number {
  const run = runs.stroke.findIndex((stroke) => stroke >= 0);
  return run < 0 ? Infinity : runs.startS[run];
}

/** Everything before it is certainly drawn. The line may overlap where it resumes. */
const certainPosition = ({ plot, stream }: Playing): StrokePosition | null =>
  estimatedPosition(plot.trajectory, Math.min(stream.boundsS[0], stream.missedS ?? Infinity));

/** How far a point is from the straight line between the points at two times of the plan, mm. */
function awayFromCut(
  trajectory: Trajectory,
  { x, y }: { readonly x: number; readonly y: number },
  [fromS, toS]: readonly [number, number],
): number {
  const [from, to] = [stateAt(trajectory, fromS), stateAt(trajectory, toS)];
  return passesOf([from.x, from.y, to.x, to.y], x, y)[0].awayMm;
}

/** Whether the pen is up, at rest, at all times between the two; null if it moves or may have moved. */
function penBetween(trajectory: Trajectory, [fromS, toS]: readonly [number, number]): boolean | null {
  let isUp = true;
  for (const { up, startS, moveS } of penMovesOf(trajectory)) {
    if (startS > toS) break;
    if (startS + moveS > fromS) return null;
    isUp = up;
  }
  return isUp;
}

const stopped = (): PlotwrightError => new PlotwrightError("conflict", "The plot was stopped.");
