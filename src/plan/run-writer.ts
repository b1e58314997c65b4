/**
 * One run from rest to rest: blocks of constant acceleration (junction.ts, blend.ts), merged if the settings
 * ask for it (merge.ts). In `scurve` mode they are filtered over time (filter.ts); so they are with a shaper,
 * and then merged once more, because the filter makes several blocks of each.
 */
import { BlendPlanner } from "./blend.js";
import { BlockColumns } from "./block-columns.js";
import { writeFiltered, type Kernel } from "./filter.js";
import { writeJunctionRun } from "./junction.js";
import { shapedLimits, type RunLimits } from "./limits.js";
import { mergeBlocks, type MergeRules } from "./merge.js";
import { RunPath } from "./run-path.js";
import { filteredPlan, stopsAreFaster } from "./scurve.js";
import type { FitSettings, MotionMode } from "../settings/motion.js";

/** Merged blocks of a shaped motion deviate from it by at most this, mm: a jolt of that size swings too. */
const SHAPED_TOLERANCE_MM = 0.005;
/** By this if they are too short for the gantry to follow. */
const SHAPED_SHORT_MM = 0.02;
/** Shorter blocks are merged, s: a command takes the board up to 5 ms. */
const SHAPED_FLOOR_S = 0.006;

/** Writes the blocks of one run, from rest to rest. Called once for each run, in order. */
export interface WritesRuns {
  /** @param planned gets the motion before the shaper, if there is one */
  write(path: RunPath, limits: RunLimits, out: BlockColumns, planned: BlockColumns): void;
}

/** Writes the blocks of one run with corners, before any filter. */
interface WritesBlocks {
  write(path: RunPath, limits: RunLimits, out: BlockColumns): void;
}

/** A planner for each corner rule. `scurve` filters the blocks of `blend`. */
const CORNERS: Readonly<Record<MotionMode, () => WritesBlocks>> = {
  junction: () => ({ write: writeJunctionRun }),
  blend: () => new BlendPlanner(),
  scurve: () => new BlendPlanner(),
};

export class RunWriter implements WritesRuns {
  private readonly corners: WritesBlocks;
  /** The run before the filter. */
  private readonly unfiltered = new BlockColumns(0, false);
  private readonly filtered = new BlockColumns(0, false);
  private readonly straight = new RunPath();
  private readonly rules: MergeRules | null;
  private readonly shapedRules: MergeRules;

  /** @param shaper null: none */
  constructor(
    private readonly mode: MotionMode,
    fit: FitSettings | null,
    private readonly shaper: Kernel | null,
  ) {
    this.corners = CORNERS[mode]();
    this.rules = fit && {
      toleranceMm: fit.toleranceMm,
      shortToleranceMm: fit.toleranceMm,
      floorS: fit.floorMs / 1_000,
      isSmooth: mode !== "junction",
      isShaped: false,
    };
    this.shapedRules = {
      toleranceMm: SHAPED_TOLERANCE_MM,
      shortToleranceMm: SHAPED_SHORT_MM,
      floorS: SHAPED_FLOOR_S,
      isSmooth: false,
      isShaped: true,
    };
  }

  /** @param planned gets the motion before the shaper, if there is one */
  write(path: RunPath, limits: RunLimits, out: BlockColumns, planned: BlockColumns): void {
    if (path.segmentCount === 0) return;
    if (this.shaper !== null) this.writeShaped(path, limits, this.shaper, out, planned);
    else if (this.mode === "scurve") this.writeFiltered(path, limits, out);
    else this.writeBlocks(path, limits, out);
    out.addSegments(path.segmentCount);
  }

  private writeShaped(
    path: RunPath,
    limits: RunLimits,
    shaper: Kernel,
    out: BlockColumns,
    planned: BlockColumns,
  ): void {
    const { unfiltered, filtered } = this;
    const first = out.count;
    unfiltered.clear();
    this.writeBlocks(path, shapedLimits(path, limits), unfiltered);
    const plannedCount = unfiltered.count;
    filtered.clear();
    writeFiltered(unfiltered, path.end(), shaper, filtered);
    // Along an axis whose impulses come later and end sooner, the carriage rests at both ends of the run.
    let from = 0;
    let end = filtered.count;
    while (from < end && isRest(filtered, from)) from++;
    while (end > from && isRest(filtered, end - 1)) end--;
    planned.clockS = out.clockS - filtered.startS[from];
    for (let k = 0; k < plannedCount; k++) planned.pushFrom(unfiltered, k);
    for (let k = from; k < end; k++) out.pushFrom(filtered, k);
    if (this.rules !== null) mergeBlocks(out, first, path.end(), limits, this.shapedRules);
  }

  private writeFiltered(path: RunPath, runLimits: RunLimits, out: BlockColumns): void {
    const { limits, kernel } = filteredPlan(path, runLimits);
    const { unfiltered } = this;
    unfiltered.clear();
    this.writeBlocks(path, limits, unfiltered);
    if (path.segmentCount > 1 && stopsAreFaster(path, runLimits, unfiltered.clockS + kernel.lengthS)) {
      this.writeWithStops(path, runLimits, out);
    } else writeFiltered(unfiltered, path.end(), kernel, out);
  }

  private writeWithStops(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    const { straight } = this;
    let along = path.startAlong;
    for (let i = 0; i < path.segmentCount; i++) {
      straight.setSegment(path, i, along);
      this.writeFiltered(straight, limits, out);
      along += path.length[i];
    }
  }

  private writeBlocks(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    const first = out.count;
    // A single straight has no corners, so its blocks are the same in all modes.
    if (path.segmentCount === 1) writeJunctionRun(path, limits, out);
    else this.corners.write(path, limits, out);
    if (this.rules !== null && path.segmentCount > 1) {
      mergeBlocks(out, first, path.end(), limits, this.rules);
    }
  }
}

const isRest = ({ vx, vy, ax, ay }: BlockColumns, k: number): boolean =>
  vx[k] === 0 && vy[k] === 0 && ax[k] === 0 && ay[k] === 0;
