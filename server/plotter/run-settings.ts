/** The settings of a plot under way, as they were changed on the way. */
import {
  drawLimitsOf,
  penOfLayer,
  settingsIdOf,
  type PenSettings,
  type Place,
  type StrokeSet,
} from "../../src/index.js";
import { followedSettings } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { PlotChange } from "./types.js";

export class RunSettings {
  private speedPct = 100;

  constructor(
    public current: PlotSettings,
    private readonly strokes: StrokeSet,
    private readonly firmware: string,
  ) {}

  change({ pen, motion, speedPct }: PlotChange): void {
    this.current = {
      ...this.current,
      pen: pen ?? this.current.pen,
      motion: motion ?? this.current.motion,
    };
    this.speedPct = speedPct ?? this.speedPct;
  }

  /** The settings for planning, with the speeds scaled by the percentage. */
  get planned(): PlotSettings {
    const share = this.speedPct / 100;
    if (share === 1) return this.current;
    const { draw, travel, layers = {} } = this.current.motion;
    const scaled = <T extends { readonly speedMmPerS?: number | undefined }>(limits: T): T =>
      limits.speedMmPerS === undefined ? limits : { ...limits, speedMmPerS: limits.speedMmPerS * share };
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

  /** What the layer of a place brakes and lifts with: as it was planned. */
  at(place: Place | null): { limits: { drawAccel: number; travelAccel: number }; pen: PenSettings } {
    const { layer, layers } = this.strokes;
    const { motion, pen } = followedSettings(this.current, layers, this.firmware);
    const own = place ? layers[layer[place.stroke]!] : undefined;
    const travelAccel = motion.travel.accelMmPerS2;
    if (!own) return { limits: { drawAccel: motion.draw.accelMmPerS2, travelAccel }, pen };
    const id = settingsIdOf(own);
    return {
      limits: { drawAccel: drawLimitsOf(motion, id).accelMmPerS2, travelAccel },
      pen: penOfLayer(pen, id),
    };
  }
}
