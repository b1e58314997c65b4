/** Layer names with codes for the layers' settings, so that other software plots the file the same way. */
import { settingsIdOf, type StrokeLayer, type StrokeSet } from "../drawing/stroke-set.js";
import { codeOfSpeed, withLayerCodes } from "../plan/coded-layers.js";
import type { MotionSettings } from "../settings/motion.js";
import type { PenSettings } from "../settings/pen.js";
import { formatLayerName, parseLayerName } from "../prepare/layers/layer-codes.js";
import type { Prepared } from "../prepare/prepare.js";
import { penOf, penStopsOf, type PenSetup } from "../prepare/layers/pens.js";
import type { SvgOptions } from "./strokes-to-svg.js";

type Settings = PenSetup & { readonly motion: MotionSettings; readonly pen: PenSettings };

/**
 * A name for each layer of `strokes`: "!" if the plot pauses before it; "+h", "+s", "+v" and "+d" if it has its own
 * height, speed, share of the speed or wait. Heights and speeds are whole percents.
 */
export function codedLayerNames(strokes: StrokeSet, settings: Settings): string[] {
  const stops = new Set(penStopsOf(strokes, settings).map(({ strokeIndex }) => strokes.layer[strokeIndex]));
  const { motion, pen } = withLayerCodes(settings, strokes.layers);
  const nameOf = (layer: StrokeLayer, index: number): string => {
    const { number, text } = parseLayerName(layer.name);
    const id = settingsIdOf(layer);
    const { speedMmPerS, speedFactor } = motion.layers?.[id] ?? {};
    const { downPct, beforeMs = 0 } = pen.layers?.[id] ?? {};
    return formatLayerName({
      skip: false,
      pause: stops.has(index),
      number,
      penDownPct: downPct === undefined ? null : Math.round(downPct),
      drawSpeedPct: speedMmPerS === undefined ? null : codeOfSpeed(speedMmPerS),
      speedSharePct: speedFactor === undefined ? null : Math.max(1, Math.round(100 * speedFactor)),
      delayMs: beforeMs >= 1 && layer.partOf === undefined ? Math.round(beforeMs) : null,
      text,
    });
  };
  return strokes.layers.map(nameOf);
}

/** Options for `toSvg` to write a job's prepared drawing: coded layer names, pen widths and pen colours. */
export function svgOptionsOf(
  { strokes, paperWidthMm, paperHeightMm }: Pick<Prepared, "strokes" | "paperWidthMm" | "paperHeightMm">,
  settings: Settings,
): SvgOptions {
  return {
    widthMm: paperWidthMm,
    heightMm: paperHeightMm,
    layerNames: codedLayerNames(strokes, settings),
    pens: strokes.layers.map((layer) => penOf(settings, layer)),
  };
}
