/**
 * A plot on a virtual board that can be interrupted, in thought, at any instant: from what its host has stored and the
 * board can have received, where it would resume, and where the board would really have stopped.
 */
import { resumePosition } from "../../../host/plotter/resume-position.js";
import { MachinePlot } from "../../../host/plotter/machine-plot.js";
import type { JournalEntry } from "../../../host/plotter/plotter-port.js";
import { streamOf } from "../../../src/drivers/ebb/compile/command-stream.js";
import { driver as ebbDriver } from "../../../src/drivers/ebb/driver.js";
import {
  commandLine,
  VirtualBoard,
  type StrokePosition,
  type StrokeSet,
  type Transport,
} from "../../../src/index.js";
import { machineOf, type Playback } from "../../../src/internal.js";
import { positionFromMotors } from "../../../src/machines/motors.js";
import { isPenUpBefore } from "../../../src/plan/pen/pen-moves.js";
import { strokeLengthMm } from "../../../src/position/on-drawing.js";
import { nextPosition } from "../../../src/position/on-plan.js";
import { stateAt } from "../../../src/plan/trajectory.js";
import type { PlotSettings } from "../../../src/schema/index.js";
import { ManualClock } from "../clocks/manual-clock.js";
import { KeepingPlanner, mmOf } from "../drawings/stop-truth.js";

export interface Resumption {
  /** Drawn by the board but not by the resumed plot, mm along the drawing; negative if drawn twice. */
  readonly missingMm: number;
  /** What the board may have drawn after the last place that it certainly had. */
  readonly unsureMm: number;
}

/** Of sums of lengths. */
const ROUNDED_MM = 1e-6;

const NO_EVENTS = {
  changed: () => undefined,
  buttonPressed: () => undefined,
  supplyRead: () => undefined,
  lost: () => undefined,
};

export class InterruptiblePlot {
  /** The plot has ended. */
  isDone = false;
  private readonly journal: JournalEntry[] = [];
  private readonly planner: KeepingPlanner;
  private readonly board: VirtualBoard;
  private run: Playback | null = null;
  /** Commands of the plan that were written. */
  private writtenCount = 0;

  private constructor(
    private readonly strokes: StrokeSet,
    private readonly settings: PlotSettings,
    firmware: string,
    private readonly world = new ManualClock(),
  ) {
    this.planner = new KeepingPlanner(strokes);
    this.board = new VirtualBoard({ clock: world, firmware });
  }

  static async begin(
    strokes: StrokeSet,
    settings: PlotSettings,
    firmware: string,
  ): Promise<InterruptiblePlot> {
    const plot = new InterruptiblePlot(strokes, settings, firmware);
    await plot.begin();
    return plot;
  }

  /** Planned time, s. */
  get totalS(): number {
    return this.planner.plots[0].trajectory.totalS;
  }

  async advance(s: number): Promise<void> {
    await this.world.advance(s);
  }

  /** kill -9, now: the board plays everything that was written. */
  killed(): Resumption {
    return this.resumedFrom(this.journal[this.journal.length - 1], this.writtenCount);
  }

  /**
   * The connection is lost now. Of what was not acknowledged, the board has received some part, so each is tried.
   */
  disconnected(): Resumption[] {
    const { receivedPlace: received, progress } = this.run!;
    if (!progress.place) return [];
    const entry = { ...this.journal[this.journal.length - 1], place: progress.place, received };
    const { trajectory, commands } = this.planner.plots[0];
    const stream = streamOf(commands);
    const receivedMm = mmOf(this.strokes, received ?? progress.place);
    const { stroke, startS } = trajectory.runs;
    const firstS = startS[stroke.findIndex((one) => one >= 0)];
    const resumptions: Resumption[] = [];
    for (let count = this.writtenCount; count > 0; count--) {
      if (this.drawnMm(count) < receivedMm - ROUNDED_MM || stream.planS[count] <= firstS) break;
      resumptions.push(this.resumedFrom(entry, count));
    }
    return resumptions;
  }

  private async begin(): Promise<void> {
    const { world, board } = this;
    const machine = await world.run(
      ebbDriver.identify(this.counted(board.transport()), {
        clock: world,
        machineClock: world,
        speed: 1,
        events: NO_EVENTS,
      }),
    );
    await world.run(machine.readKeptState(this.settings, null));
    const startRun = machine.startPlayback.bind(machine);
    machine.startPlayback = (request) => (this.run = startRun(request));
    const record = (entry: JournalEntry): void => void this.journal.push(entry);
    const plot = new MachinePlot(machine, this.planner, this.settings, { journal: { record } });
    plot.finished.then(
      () => (this.isDone = true),
      () => undefined,
    );
    while (this.journal.length === 0) await world.advance(0.005);
  }

  /** Counts the commands of the plan among the lines that are written. */
  private counted(transport: Transport): Transport {
    const write = transport.write.bind(transport);
    let partial = "";
    transport.write = (bytes) => {
      const lines = (partial + Buffer.from(bytes).toString("latin1")).split("\r");
      partial = lines.pop()!;
      const stream = this.planner.plots[0] && streamOf(this.planner.plots[0].commands);
      for (const line of lines) {
        if (stream && this.writtenCount < stream.count && line === commandLine(stream, this.writtenCount)) {
          this.writtenCount++;
        }
      }
      return write(bytes);
    };
    return transport;
  }

  /** The plot is resumed after the board has played its first `count` commands. */
  private resumedFrom({ place: from, received }: JournalEntry, count: number): Resumption {
    const { strokes, settings } = this;
    const { trajectory, commands } = this.planner.plots[0];
    const stream = streamOf(commands);
    const last = count - 1;
    const at = positionFromMotors(machineOf(settings), stream.steps1[last], stream.steps2[last]);
    const penUp = isPenUpBefore(trajectory, stream.planS[count]);
    const machine = { foundMidPlot: { penUp, isOfRun: () => true }, speed: 1, positionMm: () => at };
    const found = resumePosition(machine, strokes, settings, [], { from, received });
    const drawnMm = this.drawnMm(count);
    const sure: StrokePosition = received ?? from;
    return { missingMm: mmOf(strokes, found) - drawnMm, unsureMm: drawnMm - mmOf(strokes, sure) };
  }

  /** mm of the drawing that the first `count` commands draw. */
  private drawnMm(count: number): number {
    const { strokes } = this;
    const { trajectory, commands } = this.planner.plots[0];
    const planS = streamOf(commands).planS[count];
    const { stroke, alongMm } = stateAt(trajectory, planS);
    const last = strokes.offsets.length - 2;
    const end: StrokePosition = { stroke: last, alongMm: strokeLengthMm(strokes, last) };
    return mmOf(strokes, stroke >= 0 ? { stroke, alongMm } : (nextPosition(trajectory, planS) ?? end));
  }
}
