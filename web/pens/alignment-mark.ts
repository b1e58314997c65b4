/** A job that draws a small cross with one pen. The crosses of two pens show the offset between them. */
import { orientedPaper, type PlotPen } from "../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, type NewJob, type PlotSettings } from "../../src/schema/index.js";

export const CORNERS = ["topLeft", "topRight", "bottomLeft", "bottomRight"] as const;
export type Corner = (typeof CORNERS)[number];

const ARM_MM = 5;
/** Distance of its centre from the paper's edges: usually outside the drawing, but on the paper. */
const FROM_EDGE_MM = 10;

export const markPlace = (settings: PlotSettings, corner: Corner): { xMm: number; yMm: number } => {
  const { widthMm, heightMm } = orientedPaper(settings.prepare.paper, settings.prepare.landscape);
  return {
    xMm: corner.endsWith("Left") ? FROM_EDGE_MM : widthMm - FROM_EDGE_MM,
    yMm: corner.startsWith("top") ? FROM_EDGE_MM : heightMm - FROM_EDGE_MM,
  };
};

/** The mark as an SVG of the paper's size. It is plotted at true size, with the pen's offset and no other changes. */
export const alignmentJob = (
  settings: PlotSettings,
  pen: PlotPen,
  corner: Corner,
  name: string,
): NewJob & { readonly drawing: string; readonly settings: PlotSettings } => {
  const { paper, landscape } = settings.prepare;
  const { widthMm, heightMm } = orientedPaper(paper, landscape);
  const { xMm: x, yMm: y } = markPlace(settings, corner);
  const drawing =
    `<svg xmlns="http://www.w3.org/2000/svg" width="${widthMm}mm" height="${heightMm}mm" ` +
    `viewBox="0 0 ${widthMm} ${heightMm}" fill="none" stroke="${pen.color ?? "#000000"}">` +
    `<path d="M${x - ARM_MM} ${y}H${x + ARM_MM}M${x} ${y - ARM_MM}V${y + ARM_MM}"/></svg>`;
  return {
    name,
    drawing,
    settings: {
      ...settings,
      prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, ...PLAIN, paper, landscape },
      pens: [pen],
      layerPens: { all: pen.id },
      layerStops: {},
      penStops: "never",
    },
  };
};

const PLAIN = {
  marginMm: 0,
  fit: false,
  clipToMargins: false,
  layers: "all",
  order: "none",
} satisfies Partial<PlotSettings["prepare"]>;
