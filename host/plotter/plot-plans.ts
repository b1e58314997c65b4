/** Plans the parts of a plot, each from where the pen is to the next change of pens, and the times of the whole. */
import { PlotwrightError, type StrokePosition } from "../../src/index.js";
import {
  machineOf,
  PositionTimes,
  type Machine,
  type MachineState,
  type Playback,
} from "../../src/internal.js";
import type { PlanRequest, PlannedPlot, PlotPlanner } from "../planning/planning.js";
import type { LiveFeed } from "./live-feed.js";
import type { LiveSettings } from "./live-settings.js";
import type { PenStops } from "./pen-stops.js";

interface PlanParts {
  readonly machine: Machine;
  readonly planner: PlotPlanner;
  readonly stream: Playback;
  readonly settings: LiveSettings;
  readonly stops: PenStops;
  /** Null: the drawing is complete. */
  readonly feed: LiveFeed | null;
  /** Where an earlier run of this plot stopped. */
  readonly start: StrokePosition | null;
}

export class PlotPlans {
  /** Planned time of the plot after the part planned last. */
  afterPartS = 0;
  /** How long the last planning took. */
  planningS = 0;
  /** Times of the whole plot, if it is drawn in several parts. */
  private whole: Promise<PositionTimes> | null = null;
  private cancelPlanning: ((error: PlotwrightError) => void) | null = null;

  constructor(private readonly parts: PlanParts) {}

  /** Ends `fromRest`, which rejects with `cancelled`. */
  cancel(): void {
    this.cancelPlanning?.(cancelled());
  }

  /** From the carriage's position; rejects with `cancelled` if the plot should no longer run. */
  async fromRest(place: StrokePosition | null, shouldRun: () => boolean): Promise<PlannedPlot> {
    const { machine } = this.parts;
    const settings = this.parts.settings.current;
    const board = await machine.prepareMotors(settings);
    // A request meanwhile, when there was no planning to cancel yet.
    if (!shouldRun()) throw cancelled();
    const { x, y } = machine.positionMm(machineOf(settings))!;
    const planning = this.from(place, x, y, board);
    const cancel = new Promise<never>((_, reject) => {
      this.cancelPlanning = reject;
    });
    try {
      return await Promise.race([planning, cancel]);
    } finally {
      this.cancelPlanning = null;
      planning.catch(() => undefined);
    }
  }

  /** From a place to the next pen change. */
  async from(from: StrokePosition | null, x: number, y: number, board: MachineState): Promise<PlannedPlot> {
    const { machine, planner, stops, feed, start } = this.parts;
    if (feed) return feed.planFrom(from, x, y, board);
    const until = stops.nextAfter(from);
    const times = until === null && !start ? null : await this.timesOfWhole();
    this.afterPartS = until === null ? 0 : times!.leftFrom({ stroke: until, alongMm: 0 });
    const startS = machine.clock.nowS();
    const plot = await planner.plan({ ...this.request(x, y), from, until, board });
    this.planningS = machine.clock.nowS() - startS;
    return plot;
  }

  /** Times of the whole plot, since progress refers to the whole even if only a part is being drawn. */
  timesOfWhole(): Promise<PositionTimes> {
    const { planner, stream, start } = this.parts;
    this.whole ??= planner.plan(this.request(0, 0)).then(({ trajectory }) => {
      const times = new PositionTimes(trajectory);
      stream.progress.setWhole(trajectory, times, start);
      return times;
    });
    return this.whole;
  }

  /** The whole plot, with the carriage at that position. */
  private request(startXMm: number, startYMm: number): PlanRequest {
    const { machine, settings } = this.parts;
    const { firmware } = machine;
    return { from: null, until: null, startXMm, startYMm, settings: settings.planned, firmware };
  }
}

const cancelled = (): PlotwrightError => new PlotwrightError("cancelled", "The plot was cancelled.");
