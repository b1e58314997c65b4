import type { StrokeSet } from "../../../src/index.js";
import { machineOf, type StrokeLayer } from "../../../src/internal.js";
import { planAndCompile } from "../../../host/planning/stages.js";
import type { PlannedPlot, PlanRequest, PlotPlanner } from "../../../host/planning/planning.js";

/** A planner without its worker thread: the same stages, in the test's own thread. */
export class LocalPlanner implements PlotPlanner {
  readonly requests: PlanRequest[] = [];

  constructor(readonly strokes: StrokeSet) {}

  plan(request: PlanRequest): Promise<PlannedPlot> {
    this.requests.push(request);
    return Promise.resolve(planAndCompile(this, request, machineOf(request.settings)));
  }

  close(): Promise<void> {
    return Promise.resolve();
  }
}

/** Strokes from lists of x, y, x, y … in mm, all in one layer. */
export function strokesOf(...lines: readonly (readonly number[])[]): StrokeSet {
  return layeredStrokes(
    [{ id: "all", name: "All", color: null }],
    lines.map((line) => [0, line] as const),
  );
}

/** The same, each with the index of its layer. */
export function layeredStrokes(
  layers: readonly StrokeLayer[],
  lines: readonly (readonly [layer: number, line: readonly number[]])[],
): StrokeSet {
  const offsets = new Uint32Array(lines.length + 1);
  lines.forEach(([, line], i) => (offsets[i + 1] = offsets[i] + line.length / 2));
  return {
    xy: Float64Array.from(lines.flatMap(([, line]) => line)),
    offsets,
    layer: Uint16Array.from(lines.map(([layer]) => layer)),
    layers,
  };
}
