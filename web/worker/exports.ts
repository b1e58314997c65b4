/** The prepared drawing as files. Fetched when the first one is saved, so the compiler is no part of the first load. */
import {
  machineOf,
  planJob,
  plotLines,
  svgOptionsOf,
  toJson,
  toSvg,
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
  const commands = planJob(prepared, settings, machine, { firmware, liftFirst: true }).commands();
  return `${plotLines(commands, { machine, firmware, pen: settings.pen }).join("\n")}\n`;
};
