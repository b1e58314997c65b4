/**
 * Converts codes in layer names to settings of those layers. A value that the settings already have for a layer
 * overrides its code.
 *
 *   +h40   pen-down height 40 %            ignored unless it is below the up height
 *   +s25   pen-down speed, percent         on the AxiDraw scale: 110 is 8.6979 inches per second
 *   +v50   half the speed                  of the layer, or of all layers
 *   +d500  wait 500 ms before the layer
 *
 * Scale of +s: speed_lim_xy_hr and its use in AxiDraw's axidraw_conf.py and axidraw.py.
 */
import { MM_PER_INCH } from "../units.js";
import { settingsIdOf, type StrokeLayer, type StrokeSet } from "../drawing/stroke-set.js";
import { parseLayerName, type LayerCodes } from "../prepare/layers/layer-codes.js";
import { penOfLayer } from "./pen/pen-times.js";
import type { LayerMotion, MotionSettings } from "../settings/motion.js";
import type { LayerPen, PenSettings } from "../settings/pen.js";

/** mm/s per percent. */
const SPEED_OF_PCT = (8.6979 * MM_PER_INCH) / 110;
const LONGEST_WAIT_MS = 60_000;

export const speedOfCode = (pct: number): number => Math.round(pct * SPEED_OF_PCT * 10) / 10;
/** The nearest percentage that a code can express. */
export const codeOfSpeed = (mmPerS: number): number =>
  Math.min(110, Math.max(1, Math.round(mmPerS / SPEED_OF_PCT)));

/** Adds the codes in these layers' names to the settings. Idempotent. */
export function withLayerCodes<S extends { readonly motion: MotionSettings; readonly pen: PenSettings }>(
  settings: S,
  layers: readonly StrokeLayer[],
): S {
  const motionLayers: Record<string, LayerMotion> = {};
  const penLayers: Record<string, LayerPen> = {};
  for (const layer of layers) {
    const codes = parseLayerName(layer.name);
    const id = settingsIdOf(layer);
    const { drawSpeedPct, speedSharePct } = codes;
    if (drawSpeedPct !== null || speedSharePct !== null) {
      motionLayers[id] = {
        ...(drawSpeedPct === null ? {} : { speedMmPerS: speedOfCode(drawSpeedPct) }),
        ...(speedSharePct === null ? {} : { speedFactor: speedSharePct / 100 }),
        ...settings.motion.layers?.[id],
      };
    }
    const pen = penOfCodes(settings.pen, id, codes);
    if (pen !== null) penLayers[id] = { ...pen, ...settings.pen.layers?.[id] };
  }
  if (Object.keys(motionLayers).length + Object.keys(penLayers).length === 0) return settings;
  return {
    ...settings,
    motion: { ...settings.motion, layers: { ...settings.motion.layers, ...motionLayers } },
    pen: { ...settings.pen, layers: { ...settings.pen.layers, ...penLayers } },
  };
}

/** The pen settings with which a stroke is drawn. */
export function penOfStroke(
  { pen, motion }: { readonly pen: PenSettings; readonly motion: MotionSettings },
  { layer, layers }: StrokeSet,
  stroke: number,
): PenSettings {
  return penOfLayer(withLayerCodes({ pen, motion }, layers).pen, settingsIdOf(layers[layer[stroke]]));
}

function penOfCodes(pen: PenSettings, id: string, { penDownPct, delayMs }: LayerCodes): LayerPen | null {
  const usable = penDownPct !== null && penDownPct < penOfLayer(pen, id).upPct;
  if (!usable && delayMs === null) return null;
  return {
    ...(usable ? { downPct: penDownPct } : {}),
    ...(delayMs === null ? {} : { beforeMs: Math.min(delayMs, LONGEST_WAIT_MS) }),
  };
}
