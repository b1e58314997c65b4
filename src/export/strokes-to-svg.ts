/** The prepared drawing as an SVG that matches the plot: same strokes, order and layers, in mm. */
import { checkObject } from "../check-arguments.js";
import { checkStrokes, strokeCount, type StrokeSet, inkXy } from "../drawing/stroke-set.js";
import { mmText, pathData, svgOpening, xmlText } from "./svg-text.js";

/** What the SVG of `toSvg` shows besides the lines. */
export interface SvgOptions {
  /** Paper size as placed. */
  readonly widthMm: number;
  readonly heightMm: number;
  /** Shown stroke width; default 0.3. */
  readonly penWidthMm?: number;
  /** By layer index: width and colour from the layer's pen; null if it has no pen. */
  readonly pens?: readonly (LayerLook | null)[];
  /** Layer names by layer index, for example with the codes of `formatLayerName`; default: the names in `strokes`. */
  readonly layerNames?: readonly string[];
}

/** How the lines of a layer look. */
export interface LayerLook {
  readonly color: string | null;
  readonly widthMm: number;
}

/** SVG text with one Inkscape layer per layer that has strokes, and one path per stroke. */
export function toSvg(strokes: StrokeSet, options: SvgOptions): string {
  checkStrokes("toSvg", strokes);
  checkObject(
    "toSvg",
    "the options object",
    options,
    ["widthMm", "heightMm"],
    "{ widthMm, heightMm }, the paper's size",
  );
  const parts = [svgOpening(options.widthMm, options.heightMm)];
  const count = strokeCount(strokes);
  const xy = inkXy(strokes);
  for (let i = 0, next = 0; i < count; i = next) {
    const layer = strokes.layer[i];
    parts.push(layerOpening(strokes, layer, options));
    for (next = i; next < count && strokes.layer[next] === layer; next++) {
      const factor = strokes.speedFactor?.[next] ?? 1;
      const speed = factor === 1 ? "" : ` data-plotwright-speed="${factor}"`;
      parts.push(`<path${speed} d="${pathData(xy, strokes.offsets[next], strokes.offsets[next + 1])}"/>\n`);
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
