/** The prepared drawing as files. Loaded when the first one is saved, so the compiler is not part of the first load. */
import { planJob, toSvg, type Prepared } from "../../src/index.js";
import { machineOf, svgOptionsOf, tilesOf, toJson } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { ExportFormat } from "./protocol.js";

export const exportText = (
  prepared: Prepared,
  settings: PlotSettings,
  format: ExportFormat,
  firmware: string,
): string => {
  const { strokes, paperWidthMm: widthMm, paperHeightMm: heightMm } = prepared;
  if (format === "svg") return toSvg(strokes, svgOptionsOf(prepared, settings));
  if (format === "json") return JSON.stringify(toJson(strokes, { widthMm, heightMm }));
  if (tilesOf(settings.prepare).length > 1) {
    throw new Error(
      "The commands are those of one sheet: choose one of the sheets (Paper, Over several sheets).",
    );
  }
  const job = planJob(prepared, settings, machineOf(settings), { firmware, liftFirst: true });
  return `${job.lines().join("\n")}\n`;
};
