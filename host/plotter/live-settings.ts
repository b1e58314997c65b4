/** The settings of a running plot, with the changes made while it runs. */
import type { PlotSettings } from "../../src/schema/index.js";
import type { PlotChange } from "./plotter-port.js";

export class LiveSettings {
  /** How many changes were made so far. */
  changeCount = 0;
  private speedPct = 100;

  constructor(public current: PlotSettings) {}

  change({ pen, motion, speedPct }: PlotChange): void {
    this.current = {
      ...this.current,
      pen: pen ?? this.current.pen,
      motion: motion ?? this.current.motion,
    };
    this.speedPct = speedPct ?? this.speedPct;
    this.changeCount++;
  }

  /** The settings for planning, with the speeds scaled by `speedPct`. */
  get planned(): PlotSettings {
    const factor = this.speedPct / 100;
    if (factor === 1) return this.current;
    const { draw, travel, layers = {} } = this.current.motion;
    const scaled = <T extends { readonly speedMmPerS?: number | undefined }>(limits: T): T =>
      limits.speedMmPerS === undefined ? limits : { ...limits, speedMmPerS: limits.speedMmPerS * factor };
    const scaledLayers = Object.entries(layers).map(([id, limits]) => [id, scaled(limits)] as const);
    return {
      ...this.current,
      motion: {
        ...this.current.motion,
        draw: scaled(draw),
        travel: scaled(travel),
        layers: Object.fromEntries(scaledLayers),
      },
    };
  }
}
