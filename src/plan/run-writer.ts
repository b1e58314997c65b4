/**
 * One run from rest to rest: blocks of constant acceleration (junction.ts, blend.ts), merged if the settings
 * ask for it (merge.ts), and in `scurve` mode filtered over time (filter.ts).
 */
import { BlendPlanner } from "./blend.js";
import { BlockColumns } from "./block-columns.js";
import { writeFiltered } from "./filter.js";
import { writeJunctionRun } from "./junction.js";
import type { RunLimits } from "./limits.js";
import { mergeBlocks, type MergeRules } from "./merge.js";
import { RunPath } from "./run-path.js";
import { filteredPlan, stopsAreFaster } from "./scurve.js";
import type { FitSettings, MotionMode } from "../settings/motion.js";

/** Writes the blocks of one run, from rest to rest. Called once for each run, in order. */
export interface WritesRuns {
  write(path: RunPath, limits: RunLimits, out: BlockColumns): void;
}

export class RunWriter implements WritesRuns {
  private readonly blend = new BlendPlanner();
  /** The run before the filter. */
  private readonly unfiltered = new BlockColumns(0, false);
  private readonly straight = new RunPath();
  private readonly rules: MergeRules | null;

  constructor(
    private readonly mode: MotionMode,
    fit: FitSettings | null,
  ) {
    this.rules = fit && {
      toleranceMm: fit.toleranceMm,
      floorS: fit.floorMs / 1_000,
      isSmooth: mode !== "junction",
    };
  }

  write(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    if (path.segmentCount === 0) return;
    if (this.mode === "scurve") this.writeFiltered(path, limits, out);
    else this.writeBlocks(path, limits, out);
    out.addSegments(path.segmentCount);
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
    // A single straight has no corners, so its blocks are the same in both modes.
    if (this.mode === "junction" || path.segmentCount === 1) writeJunctionRun(path, limits, out);
    else this.blend.write(path, limits, out);
    if (this.rules !== null && path.segmentCount > 1) {
      mergeBlocks(out, first, path.end(), limits, this.rules);
    }
  }
}
