/**
 * Runs for firmware before 2.5.3: SM at constant rates, in slices short enough to follow a ramp.
 *
 * SM takes whole milliseconds and whole steps and works out the rate itself, rounded down. Which slices is the search's
 * to find; how long each really takes is known to the tick, and the next one starts from there.
 */
import { TICKS_PER_MS } from "../../../units.js";
import type { FirmwareFeatures } from "../protocol/firmware.js";
import type { MotorPlace, RunWriter } from "./leg.js";
import { TOO_FAST } from "../protocol/limits.js";
import { RunSamples } from "./run-samples.js";
import type { RunWalk } from "./run-walk.js";
import { SliceSearch } from "./slice-search.js";
import type { StreamColumns } from "./stream-columns.js";

export class SliceRuns implements RunWriter {
  private readonly samples: RunSamples;
  private readonly search: SliceSearch;
  /** Ticks by which the last run ended after its plan; the next one sets out as much nearer to its own. */
  private lateTicks = 0;
  /** When the last slice written was over, board ticks. */
  private lastEndTick = NaN;

  constructor(
    features: FirmwareFeatures,
    private readonly walk: RunWalk,
    private readonly columns: StreamColumns,
    private readonly m1: MotorPlace,
    private readonly m2: MotorPlace,
  ) {
    this.samples = new RunSamples(walk);
    this.search = new SliceSearch(this.samples, features.arithmetic, features.idleTicks);
  }

  write(run: number): void {
    const { walk, samples, search, columns } = this;
    const startTick = columns.boardTicks;
    walk.begin(run, startTick - this.lateTicks);
    if (walk.first === walk.end) return;
    samples.begin(startTick);
    if (samples.isNothing(this.m1, this.m2)) return;
    search.begin(this.m1, this.m2, startTick === this.lastEndTick);
    let isOver = false;
    while (!isOver) {
      isOver = search.next();
      for (let i = 0; i < search.pathLength; i++) {
        const planS = samples.planS(columns.boardTicks - startTick);
        this.writeSlice(search.path[i]!, planS, run);
      }
    }
    this.lastEndTick = columns.boardTicks;
    const lateTicks = columns.boardTicks - startTick - samples.endTick;
    this.lateTicks = Math.max(-TICKS_PER_MS, Math.min(TICKS_PER_MS, lateTicks));
    if (samples.isSlowed) columns.warnOnce(TOO_FAST);
  }

  private writeSlice(way: number, planS: number, run: number): void {
    const { columns, m1, m2 } = this;
    const { text } = columns;
    const { ways } = this.search;
    text.name("SM");
    text.number(ways.ms[way]!);
    text.number(ways.steps1[way]! - m1.steps);
    text.number(ways.steps2[way]! - m2.steps);
    text.end();
    m1.steps = ways.steps1[way]!;
    m1.acc = ways.acc1[way]!;
    m2.steps = ways.steps2[way]!;
    m2.acc = ways.acc2[way]!;
    columns.add(ways.ticks[way]!, planS, run, m1.steps, m2.steps, m1.acc, m2.acc);
  }
}
