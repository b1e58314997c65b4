/** A plotter's connection on Node, with the manual moves by name. */
import type { Clock } from "../../../src/index.js";
import { PlotterConnection } from "../../../host/plotter/plotter-connection.js";
import type { PlotterOptions } from "../../../host/plotter/plotter-state.js";
import type { PlotSettings } from "../../../src/schema/index.js";
import { NODE_PARTS } from "../../../server/plotter/node-parts.js";

export type { PlotterState } from "../../../host/plotter/plotter-state.js";

export interface NodePlotterOptions extends Omit<PlotterOptions, "clock" | "devices"> {
  readonly clock?: Clock | undefined;
}

export class NodePlotter extends PlotterConnection {
  constructor(options: NodePlotterOptions) {
    super({ ...NODE_PARTS, ...options, clock: options.clock ?? NODE_PARTS.clock });
  }

  /** Lifts the pen and moves home; a machine with limit switches finds it with them. */
  home(settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "home" }, settings);
  }

  /** Makes the current position home. */
  setHome(settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "set-home" }, settings);
  }

  /** Moves to a position in mm from home, pen up. */
  moveTo(xMm: number, yMm: number, settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "move-to", xMm, yMm }, settings);
  }

  /** Moves by a distance in mm, pen up. May go beyond home, since this is how the user finds home. */
  jog(dxMm: number, dyMm: number, settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "jog", dxMm, dyMm }, settings);
  }

  /** Lowers the pen and lifts it again, to check the heights. */
  cyclePen(settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "cycle-pen" }, settings);
  }

  /** Moves around a rectangle (mm from home) with the pen up, and back to the previous position. */
  traceFrame(x0Mm: number, y0Mm: number, x1Mm: number, y1Mm: number, settings?: PlotSettings): Promise<void> {
    const boxMm = {
      xMm: Math.min(x0Mm, x1Mm),
      yMm: Math.min(y0Mm, y1Mm),
      widthMm: Math.abs(x1Mm - x0Mm),
      heightMm: Math.abs(y1Mm - y0Mm),
    };
    return this.move({ kind: "frame", boxMm }, settings);
  }

  /** Draws a small pattern at the current position with the given settings, and comes back. */
  drawTestPatch(settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "test-patch" }, settings);
  }

  /** Draws a square at the current position; its measured size gives the motor steps per mm. */
  drawSquare(sizeMm: number, settings?: PlotSettings): Promise<void> {
    return this.move({ kind: "square", sizeMm }, settings);
  }
}
