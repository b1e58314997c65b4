import { compile, machineOf, plan, withLayerCodes, type StrokeSet } from "../../src/index.js";
import type { PlannedPlot, PlanRequest, PlotPlanner } from "../../server/plotter/types.js";

/** A planner without its worker thread: the same stages, in the test's own thread. */
export class LocalPlanner implements PlotPlanner {
  readonly requests: PlanRequest[] = [];

  constructor(readonly strokes: StrokeSet) {}

  plan(request: PlanRequest): Promise<PlannedPlot> {
    this.requests.push(request);
    const { from } = request;
    const settings = withLayerCodes(request.settings, this.strokes.layers);
    const trajectory = plan(this.strokes, settings.motion, settings.pen, {
      ...(from ? { from } : {}),
      startX: request.startXMm,
      startY: request.startYMm,
    });
    const commands = compile(trajectory, {
      machine: machineOf(settings),
      firmware: request.firmware,
      pen: settings.pen,
      start: request.board,
    });
    return Promise.resolve({ trajectory, commands });
  }

  close(): Promise<void> {
    return Promise.resolve();
  }
}

/** Strokes from lists of x, y, x, y … in mm, all in one layer. */
export function strokesOf(...lines: readonly (readonly number[])[]): StrokeSet {
  const offsets = new Uint32Array(lines.length + 1);
  lines.forEach((line, i) => (offsets[i + 1] = offsets[i]! + line.length / 2));
  return {
    xy: Float64Array.from(lines.flat()),
    offsets,
    layer: new Uint16Array(lines.length),
    layers: [{ id: "all", name: "All", color: null }],
  };
}
