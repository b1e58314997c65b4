/** The prepared drawing as files. Fetched when the first one is saved, so the compiler is no part of the first load. */
import {
  compile,
  machineOf,
  motionForFirmware,
  plan,
  plotLines,
  svgOptionsOf,
  toJson,
  toSvg,
  withLayerCodes,
  type Prepared,
} from "../../src/index.js";
import type { ExportFormat, PlanSettings } from "./protocol.js";

export const exportText = (
  prepared: Prepared,
  settings: PlanSettings,
  format: ExportFormat,
  firmware: string,
): string => {
  const { strokes, paperWidthMm: widthMm, paperHeightMm: heightMm } = prepared;
  if (format === "svg") return toSvg(strokes, svgOptionsOf(prepared, settings));
  if (format === "json") return JSON.stringify(toJson(strokes, { widthMm, heightMm }));
  const machine = machineOf(settings);
  const { motion, pen } = withLayerCodes(settings, strokes.layers);
  const followed = motionForFirmware(motion, firmware);
  const trajectory = plan(strokes, followed, pen, { machine, liftFirst: true });
  const commands = compile(trajectory, { machine, firmware, pen });
  return `${plotLines(commands, { machine, firmware, pen }).join("\n")}\n`;
};
