/**
 * What a board needs beside its motion: the settings that it forgets when it restarts, and the polls during a stream that
 * notice its faults and its button.
 */
import type { PlotwrightError } from "../../../errors.js";
import { machineOf } from "../../../machines/profiles.js";
import { sFromTicks } from "../../../units.js";
import type { MachineEvents } from "../../driver.js";
import { boardRestarted, stuck } from "../../faults.js";
import type { MachineSettings } from "../../machine-job.js";
import { MAX_TICKS } from "../compile/leg.js";
import { penCommand, penMoveOf } from "../protocol/commands.js";
import { findsHome } from "../protocol/ebb-controller.js";
import { queueDepthOf } from "../protocol/firmware.js";
import type { PollTime } from "../stream/stream-types.js";
import { maxAheadS } from "../stream/send-window.js";
import { Streamer } from "../stream/streamer.js";
import { AdvanceWatch } from "./advance-watch.js";
import type { Connection } from "./connection.js";
import type { EbbPosition } from "./position.js";
import {
  CounterPolls,
  isButtonPressed,
  isPowerLow,
  MotorSupply,
  pollLines,
  SUPPLY_LINES,
  SupplyPolls,
} from "./readings.js";

/** Allowance for the connection, the board and this computer. */
const ANSWER_MS = 30;
/** Interval at which the board's button and queue are polled during a plot. */
const POLL_S = 0.25;
/** The same for the supply, if the board does not notice its failures by itself. */
const SUPPLY_S = 0.05;
/** Tolerated overrun of the planned time, seconds of this computer. */
const STUCK_S = 2;

export class EbbUpkeep {
  readonly supply: MotorSupply;
  /** The error that stopped a stream because a poll has shown that the board restarted. */
  restart: PlotwrightError | null = null;
  private readonly queueDepth: number;

  constructor(
    private readonly connection: Connection,
    private readonly position: EbbPosition,
    private readonly events: MachineEvents,
  ) {
    const { session, features } = connection;
    this.supply = new MotorSupply(session, features, (state) => events.supplyRead(state));
    this.queueDepth = queueDepthOf(features);
  }

  /** False if the board has restarted, or another program has used it, since `configure`, as far as the board shows that. */
  async isConfigured(): Promise<boolean> {
    const { session } = this.connection;
    return this.queueDepth === 1 || depthFrom(await session.query("QU,3")) === this.queueDepth;
  }

  /** Sets what the board forgets when it restarts, and what another program may have left. */
  async configure(): Promise<void> {
    const { session, features } = this.connection;
    if (features.hasLimitSwitches) for (const line of ["CU,51,0", "CU,50,1"]) await session.send(line);
    if (this.queueDepth > 1) await session.send(`CU,4,${this.queueDepth}`);
    if (features.hasSupplyLatch) await this.supply.watch();
  }

  /**
   * How long the motors may keep running after an emergency stop. A board with a queue of one command reads nothing
   * while the queue is full, so it plays everything that was sent ahead before it reads the stop.
   */
  emergencyStopMs({ sendAheadMs }: MachineSettings): number {
    if (this.queueDepth > 1) return ANSWER_MS;
    const windowS = sendAheadMs / 1_000 + (this.connection.boardClock.latenessS?.() ?? 0);
    return Math.round(1_000 * maxAheadS(windowS, sFromTicks(MAX_TICKS))) + ANSWER_MS;
  }

  /** For the log that users send with a report. */
  noteEmergencyStop(settings: MachineSettings): void {
    const { session, features } = this.connection;
    const takesMs = this.emergencyStopMs(settings);
    session.log.add("note", `emergency stop: takes up to ${takesMs} ms on firmware ${features.version}`);
  }

  /** `certain` is called with step counters that the motors certainly reached with power, and when they were asked for. */
  streamer(
    settings: MachineSettings,
    certain: (steps: readonly [number, number], asked: PollTime) => void = () => undefined,
  ): Streamer {
    const { session, features, boardClock, speed, waitSpeed } = this.connection;
    const { mark, origin } = this.position;
    const watch = new AdvanceWatch(boardClock, waitSpeed);
    const lines = pollLines(features, mark.query);
    const lastLine = lines[lines.length - 1];
    const counters = new CounterPolls(origin, lastLine);
    const supply = new SupplyPolls(session, features, lastLine);
    const streamer = new Streamer(session, {
      clock: boardClock,
      windowS: (settings.sendAheadMs / 1_000) * speed,
      queueDepth: this.queueDepth,
      poll: { lines, everyS: POLL_S * speed },
      between: features.hasSupplyLatch ? undefined : { lines: SUPPLY_LINES, everyS: SUPPLY_S * speed },
      stuckS: STUCK_S * waitSpeed,
      liftLine: penCommand(machineOf(settings), penMoveOf(settings.pen, true), 0),
      origin,
      onPoll: (line, reply, asked) => {
        const failure = supply.answered(line, reply);
        if (line === mark.query && Number(reply) === 0) void this.checkRestart(streamer, settings);
        else {
          const steps = counters.answered(line, reply);
          if (steps && !failure) certain(steps, asked);
        }
        if (failure === "failed") this.events.supplyRead(failure);
        if (isButtonPressed(line, reply)) this.events.buttonPressed();
        if (line === "QC") this.events.supplyRead(isPowerLow(line, reply) ? "low" : "good");
        if (line === "QS" && streamer.playing && watch.isStalled(reply, asked, streamer.position()))
          streamer.stopAtOnce(stuck());
      },
    });
    return streamer;
  }

  /** Call when a poll reports that the mark is gone. */
  private async checkRestart(streamer: Streamer, settings: MachineSettings): Promise<void> {
    const isGone = await this.position.mark.isGone().catch(() => false);
    if (!isGone || !streamer.playing) return;
    this.restart = boardRestarted(findsHome(machineOf(settings)));
    streamer.stopAtOnce(this.restart);
  }
}

/** Firmware before 3.0.2 repeats the number of the question. */
const depthFrom = (reply: string): number => Number(reply.split(",").pop());
