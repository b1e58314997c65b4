/**
 * Writes one run, from rest to rest:
 *
 *   1. blocks of constant acceleration       a corner rule, look-ahead.ts, corner-blocks.ts
 *   2. fewer, longer blocks                  merge.ts, if the settings ask for it
 *   3. a filter over time                    filter.ts in mode `scurve`, impulse-filter.ts with a shaper
 *   4. a second merge, with a shaper         because its filter splits each block into several
 *   5. all again, slower, with a shaper      while wrong-springs.ts finds that the pen could swing too far
 */
import { AxisFrame } from "./axis-frame.js";
import { limitBlends } from "./corners/blend-rule.js";
import { BlockColumns } from "./block-columns.js";
import { writeCornerBlocks } from "./corners/corner-blocks.js";
import { writeFiltered } from "./shaping/filter.js";
import { ImpulseFilter, type Kernel } from "./shaping/impulse-filter.js";
import { limitJunctions } from "./corners/junction-rule.js";
import { capSegments, isStretched, shapedLimits, type RunLimits } from "./limits.js";
import { lookAhead } from "./corners/look-ahead.js";
import { mergeBlocks, SHAPED_RULES, type MergeRules } from "./merge.js";
import { CALM_ACCEL, WrongSprings } from "./shaping/wrong-springs.js";
import type { Springs } from "../machines/profile.js";
import { RunPath } from "./run-path.js";
import { filteredPlan, stopsAreFaster } from "./corners/scurve.js";
import { CORNER_RULES, type FitSettings, type MotionMode } from "../settings/motion.js";

/** Writes the blocks of one run, from rest to rest. Called once for each run, in order. */
export interface RunPlanner {
  /** @param planned gets the motion before the shaper, if there is one */
  write(path: RunPath, limits: RunLimits, out: BlockColumns, planned: BlockColumns): void;
}

/** Sets `v2`, `sine` and `tangent` of a path whose `cap2` is known, and may lower `cap2`. */
type CornerRule = (path: RunPath, limits: RunLimits) => void;

/** The rule of each mode. `scurve` filters the blocks of `blend`. */
const CORNER_PLANNERS: Readonly<Record<MotionMode, CornerRule>> = {
  junction: limitJunctions,
  blend: limitBlends,
  scurve: limitBlends,
};

/** A run that would sway on wrong springs is planned again with this share of its acceleration: another rhythm. */
const CALMER = 0.85;

export class RunWriter implements RunPlanner {
  /** The run before the filter. */
  private readonly unfiltered = new BlockColumns(0, false);
  private readonly shaper: ImpulseFilter | null;
  private readonly straight = new RunPath();
  private readonly frame = new AxisFrame();
  private readonly rules: MergeRules | null;
  private readonly wrongSprings: WrongSprings | null;

  /**
   * @param shaper null: none
   * @param springs those that it is for
   */
  constructor(
    private readonly mode: MotionMode,
    fit: FitSettings | null,
    shaper: Kernel | null,
    springs: Springs | null,
  ) {
    this.wrongSprings = springs && new WrongSprings(springs);
    this.shaper = shaper && new ImpulseFilter(shaper);
    this.rules = fit && {
      toleranceMm: fit.toleranceMm,
      shortToleranceMm: fit.toleranceMm,
      floorS: fit.floorMs / 1_000,
      isSmooth: CORNER_RULES[mode].isRounded,
      isShaped: false,
    };
  }

  write(path: RunPath, limits: RunLimits, out: BlockColumns, planned: BlockColumns): void {
    if (path.segmentCount === 0) return;
    if (!isStretched(limits)) this.writeRun(path, limits, out, planned);
    else {
      const [first, plannedFirst] = [out.count, planned.count];
      this.writeRun(this.frame.of(path, limits), limits, out, planned);
      this.frame.restore(out, first);
      this.frame.restore(planned, plannedFirst);
    }
    out.addSegments(path.segmentCount);
    planned.addSegments(path.segmentCount);
  }

  private writeRun(path: RunPath, limits: RunLimits, out: BlockColumns, planned: BlockColumns): void {
    if (this.shaper !== null) this.writeShaped(path, limits, this.shaper, out, planned);
    else if (this.mode === "scurve") this.writeFiltered(path, limits, out);
    else this.writeBlocks(path, limits, out);
  }

  private writeShaped(
    path: RunPath,
    limits: RunLimits,
    shaper: ImpulseFilter,
    out: BlockColumns,
    planned: BlockColumns,
  ): void {
    const first = out.count;
    const plannedFirst = planned.count;
    const startS = out.clockS;
    /** Writes the run with this acceleration and returns how far it sways: 1 is the limit. */
    const swayAt = (accel: number): number => {
      const calm = { ...limits, accel };
      out.count = first;
      planned.count = plannedFirst;
      planned.clockS = out.clockS = startS;
      this.writeBlocks(path, shapedLimits(path, calm), planned);
      const beginS = shaper.write(planned, plannedFirst, path.end(), out);
      if (beginS > 0) planned.shift(plannedFirst, -beginS);
      if (this.rules !== null) mergeBlocks(out, first, path.end(), calm, SHAPED_RULES);
      // A straight has no corners, so no rhythm. A path that grows keeps its rhythm.
      if (path.segmentCount === 1 || path.mayGrow || limits.accel <= CALM_ACCEL) return 0;
      return this.wrongSprings?.sway(out, first, limits) ?? 0;
    };
    let { accel } = limits;
    let sway = swayAt(accel);
    while (sway > 1 && accel > CALM_ACCEL) {
      const [before, swayBefore] = [accel, sway];
      accel = Math.max(CALM_ACCEL, CALMER * before);
      sway = swayAt(accel);
      // Between two steps, so that a point moved by 1 µm does not change the time by a step.
      if (sway < 1) swayAt(before + ((accel - before) * (swayBefore - 1)) / (swayBefore - sway));
    }
  }

  private writeFiltered(path: RunPath, runLimits: RunLimits, out: BlockColumns): void {
    const { limits, widthS } = filteredPlan(path, runLimits);
    const { unfiltered } = this;
    unfiltered.clear();
    this.writeBlocks(path, limits, unfiltered);
    if (
      path.segmentCount > 1 &&
      !path.mayGrow &&
      stopsAreFaster(path, runLimits, unfiltered.clockS + widthS)
    ) {
      this.writeWithStops(path, runLimits, out);
    } else writeFiltered(unfiltered, path.end(), widthS, out);
  }

  private writeWithStops(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    const { straight } = this;
    let along = path.startAlong;
    for (let i = 0; i < path.segmentCount; i++) {
      straight.setSegment(path, i, along);
      this.writeFiltered(straight, limits, out);
      along += path.drawn[i];
    }
  }

  private writeBlocks(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    const first = out.count;
    capSegments(path, limits);
    CORNER_PLANNERS[this.mode](path, limits);
    lookAhead(path, limits.accel);
    writeCornerBlocks(path, limits.accel, out);
    if (this.rules !== null && path.segmentCount > 1) {
      mergeBlocks(out, first, path.end(), limits, this.rules);
    }
  }
}
