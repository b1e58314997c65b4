/** The prepared drawing as an SVG that is true to the plot: same strokes, same order, same layers, in mm. */
import { strokeCount, type StrokeSet } from "../drawing/stroke-set.js";
import { linesOnPaper } from "./lines-on-paper.js";
import { mmText, pathData, svgOpening, xmlText } from "./svg-text.js";

export interface SvgOptions {
  /** The paper as it lies. */
  readonly widthMm: number;
  readonly heightMm: number;
  /** How wide strokes are shown; 0.3 if not given. */
  readonly penWidthMm?: number;
  /** By layer index, from its pen: how wide and in which colour it is shown; null as if there were none. */
  readonly pens?: readonly (LayerLook | null)[];
  /** Layer names by layer index, for example with the codes of `formatLayerName`; the strokes' own if not given. */
  readonly layerNames?: readonly string[];
}

export interface LayerLook {
  readonly color: string | null;
  readonly widthMm: number;
}

/** SVG text, one Inkscape layer for each layer that has strokes, one path for each stroke. */
export function toSvg(strokes: StrokeSet, options: SvgOptions): string {
  const parts = [svgOpening(options.widthMm, options.heightMm)];
  const count = strokeCount(strokes);
  const xy = linesOnPaper(strokes);
  for (let i = 0, next = 0; i < count; i = next) {
    const layer = strokes.layer[i];
    parts.push(layerOpening(strokes, layer, options));
    for (next = i; next < count && strokes.layer[next] === layer; next++) {
      parts.push(`<path d="${pathData(xy, strokes.offsets[next], strokes.offsets[next + 1])}"/>\n`);
    }
    parts.push("</g>\n");
  }
  parts.push("</svg>\n");
  return parts.join("");
}

function layerOpening(strokes: StrokeSet, layer: number, options: SvgOptions): string {
  const { name, color } = strokes.layers[layer];
  const pen = options.pens?.[layer];
  const label = xmlText(options.layerNames?.[layer] ?? name);
  return (
    `<g id="layer${layer + 1}" inkscape:groupmode="layer" inkscape:label="${label}" fill="none" ` +
    `stroke="${pen?.color ?? color ?? "#000000"}" ` +
    `stroke-width="${mmText(pen?.widthMm ?? options.penWidthMm ?? 0.3)}" ` +
    `stroke-linecap="round" stroke-linejoin="round">\n`
  );
}
