/** One run from rest to rest, in the mode and with the fit that the settings ask for. */
import { BlendPlanner } from "./blend.js";
import { BlockColumns } from "./block-columns.js";
import { AccelerationFitter } from "./fit-accelerations.js";
import { JerkFitter } from "./fit-jerks.js";
import { ShortRunFitter } from "./fit-short-runs.js";
import { writeJunctionRun } from "./junction.js";
import type { RunLimits } from "./limits.js";
import type { RunPath } from "./run-path.js";
import { SCurvePlanner } from "./scurve.js";
import type { FitSettings, MotionMode } from "../settings/motion.js";
import { writeSingle } from "./straight.js";

export class RunWriter {
  private readonly blend = new BlendPlanner();
  private readonly sCurve = new SCurvePlanner();
  private readonly fitter: AccelerationFitter | JerkFitter | null;
  private readonly shortFitter: ShortRunFitter | null;
  /** The run before fitting. */
  private readonly unfitted: BlockColumns;

  constructor(
    private readonly mode: MotionMode,
    fit: FitSettings | null,
  ) {
    this.fitter = fit && (mode === "scurve" ? new JerkFitter(fit) : new AccelerationFitter(fit, mode));
    this.shortFitter = fit && mode === "blend" ? new ShortRunFitter(fit) : null;
    this.unfitted = new BlockColumns(0, mode === "scurve");
  }

  write(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    // A single straight has no piece too many.
    if (path.segmentCount === 1 && this.mode === "blend") return writeSingle(path, limits, out);
    if (this.fitter === null || path.segmentCount < 2) return this.writeMode(path, limits, out);
    this.unfitted.clear();
    if (this.shortFitter?.takes(path, limits)) {
      this.writeMode(path, limits, this.unfitted);
      this.shortFitter.write(this.unfitted, path.end(), limits, out);
      return;
    }
    this.writeMode(path, isDense(path, limits.speed) ? this.withMargin(limits) : limits, this.unfitted);
    this.fitter.write(this.unfitted, path.end(), limits, out);
  }

  private withMargin(limits: RunLimits): RunLimits {
    // Pieces of constant acceleration slow down for V where they must, on their own; and they keep the floor.
    const speed = this.mode === "scurve" ? limits.speed * SPEED_MARGIN : limits.speed;
    return { ...limits, accel: limits.accel * ACCEL_MARGIN, speed, floorS: 0 };
  }

  private writeMode(path: RunPath, limits: RunLimits, out: BlockColumns): void {
    if (path.segmentCount === 0) return;
    if (this.mode === "junction") writeJunctionRun(path, limits, out);
    else if (this.mode === "blend") this.blend.write(path, limits, out);
    else this.sCurve.write(path, limits, out);
  }
}

/** Room that a dense curve's plan leaves for the fit: pieces longer than its own swing a little around it. */
const ACCEL_MARGIN = 0.98;
const SPEED_MARGIN = 0.985;

/** A segment passed in less than this is a sample of a curve, s. */
const DENSE_S = 0.03;

function isDense(path: RunPath, speed: number): boolean {
  let short = 0;
  for (let i = 0; i < path.segmentCount; i++) if (path.length[i]! < speed * DENSE_S) short++;
  return 2 * short > path.segmentCount;
}
