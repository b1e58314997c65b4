/** The motion of one board: its position, its pen and its upkeep together. */
import { PlotwrightError } from "../../../errors.js";
import { machineOf } from "../../../machines/profiles.js";
import type { MachineEvents, PenBefore } from "../../driver.js";
import { boardRestarted, moveStopped, powerFailed, powerLost } from "../../faults.js";
import type { MachineSettings, PlannedPlot } from "../../machine-job.js";
import { MoveSignal } from "../../move-to.js";
import { streamOf, type BoardState } from "../compile/command-stream.js";
import { ebbOf, findsHome, STANDARD_PIN } from "../protocol/ebb-controller.js";
import { boardStateBefore } from "../stream/cut-streams.js";
import type { StreamReport } from "../stream/stream-types.js";
import type { Streamer } from "../stream/streamer.js";
import type { Connection } from "./connection.js";
import { EbbPen } from "./pen.js";
import { EbbPosition } from "./position.js";
import { EbbUpkeep } from "./upkeep.js";

export class Carriage {
  readonly position: EbbPosition;
  readonly pen: EbbPen;
  readonly upkeep: EbbUpkeep;
  stopSignal = new MoveSignal();
  private playing: Streamer | null = null;

  constructor(
    readonly connection: Connection,
    private readonly events: MachineEvents,
  ) {
    const changed = (): void => events.changed();
    this.position = new EbbPosition(connection, changed);
    this.pen = new EbbPen(connection, changed);
    this.upkeep = new EbbUpkeep(connection, this.position, events);
  }

  /** Called after connecting. A board that was not restarted still has the position in its counters. */
  async readKeptState(settings: MachineSettings, before: PenBefore | null): Promise<void> {
    const { position, pen, upkeep } = this;
    const { features } = this.connection;
    if (features.hasStepQuery) await position.untilAtRest();
    const reportsPen = ebbOf(machineOf(settings)).servoPin === STANDARD_PIN;
    const penUp = reportsPen ? await pen.liftIfDown() : before?.penUp === true;
    if (!reportsPen && before !== null && !penUp) await pen.move(true, settings);
    const isOurs = await upkeep.isConfigured();
    if (!isOurs) await position.mark.forgetOwn();
    // Before `configure`, which begins a new watch.
    if (features.hasSupplyLatch && (await upkeep.supply.hasFailed())) await position.mark.clear();
    await upkeep.configure();
    if (await position.isKept()) {
      // The board does not report such a pen, and an earlier program may have left it on the paper.
      if (!reportsPen && before === null) await pen.move(true, settings);
      await position.readBack();
      position.motorsOn = true;
    }
    // The place of a carriage that was moved since the plot, also by another program, says nothing about the plot.
    const run = position.state && isOurs ? await position.mark.unfinishedRun() : null;
    if (run !== null) position.foundMidPlot = { penUp, isOfRun: (other) => other === run };
  }

  /** Switches the motors on if they are off. Fails if the position was lost while the board was at rest. */
  async switchMotorsOn(settings: MachineSettings): Promise<BoardState> {
    const { position, upkeep } = this;
    // It may have restarted, or its supply may have failed, while it was at rest, when nothing is polled.
    if (position.state && (await position.mark.isGone())) return this.positionLost(boardRestarted, settings);
    // Asked also while the position is unknown: a failure before this does not concern the motion after it.
    const supply = this.connection.features.hasSupplyLatch ? await upkeep.supply.read() : "good";
    const why = supply === "low" ? powerLost : powerFailed;
    if (position.state && supply !== "good") return this.positionLost(why, settings);
    return position.switchOn(settings);
  }

  /** After the position is lost: lifts the pen and switches the motors off, so that the carriage can be pushed. */
  async liftAndFreeMotors(settings: MachineSettings): Promise<void> {
    await this.position.untilAtRest();
    await this.upkeep.configure();
    await this.pen.move(true, settings);
    await this.position.motorsOff();
  }

  /** Plays a plan on a streamer of this carriage, to its end or to a cut. */
  async play(streamer: Streamer, plot: PlannedPlot, settings: MachineSettings): Promise<StreamReport> {
    const { position } = this;
    const start = position.state!;
    position.foundMidPlot = null;
    position.motorsOn = true;
    this.pen.isUp = null;
    this.playing = streamer;
    try {
      const report = await streamer.play(streamOf(plot.commands));
      position.state = boardStateBefore(report.end.stream, report.end.commandIndex + 1, start);
      if (!report.exact) throw misplaced(report);
      return report;
    } catch (error) {
      if (!canReadBack(streamer, error)) position.state = null;
      const isGone = position.state !== null && (await position.mark.isGone().catch(() => false));
      if (!isGone && error !== this.upkeep.restart) throw error;
      return await this.positionLost(boardRestarted, settings);
    } finally {
      this.playing = null;
      this.events.changed();
    }
  }

  async perform(plot: PlannedPlot, settings: MachineSettings): Promise<void> {
    const streamer = this.upkeep.streamer(settings);
    this.position.mark.noteRun(null);
    try {
      await this.play(streamer, plot, settings);
    } catch (error) {
      if (this.position.state && canReadBack(streamer, error)) await this.position.readBack();
      throw error;
    }
    this.pen.setState(true);
  }

  /** Clears the board's queue. The current move rejects with `conflict`, and the position is read back. */
  stopAtOnce(): void {
    this.stopSignal.aborted = true;
    this.stopSignal = new MoveSignal();
    this.playing?.stopAtOnce(moveStopped());
  }

  /** Before the connection is closed during motion: stops and lifts the pen. */
  async stopAndLift(settings: MachineSettings): Promise<void> {
    this.stopAtOnce();
    await this.position.untilAtRest();
    await this.pen.move(true, settings);
  }

  async setHome(settings: MachineSettings): Promise<void> {
    await this.switchMotorsOn(settings);
    await this.position.setHome();
  }

  private async positionLost(
    why: (findsHome: boolean) => PlotwrightError,
    settings: MachineSettings,
  ): Promise<never> {
    this.position.state = null;
    await this.liftAndFreeMotors(settings).catch(() => undefined);
    throw why(findsHome(machineOf(settings)));
  }
}

/**
 * True if the motion ended early but the counters still give the position: it was stopped on purpose, or a
 * command was refused.
 */
const canReadBack = (streamer: Streamer, error: unknown): boolean =>
  streamer.refused.length > 0 || (error instanceof PlotwrightError && error.code === "conflict");

function misplaced({ end, steps1, steps2 }: StreamReport): PlotwrightError {
  const expected = `${end.stream.steps1[end.commandIndex]}, ${end.stream.steps2[end.commandIndex]}`;
  return new PlotwrightError(
    "board-error",
    `The board's motors are at ${steps1}, ${steps2} steps instead of ${expected}: it was reset ` +
      "or moved by another program. Set home again before the next plot.",
  );
}
