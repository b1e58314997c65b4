/** The context inside a marker: its position, rotation, scale and clip (SVG 2, §11.6). */
import {
  compose,
  determinant,
  IDENTITY,
  isFiniteAffine,
  rotation,
  scaling,
  translation,
} from "../../geometry/affine.js";
import type { Declared } from "./properties.js";
import { lengthPx, type LengthBasis, type Side } from "./length.js";
import type { MarkerPlace } from "./markers.js";
import type { SvgClips } from "./svg-clips.js";
import { contextPaints, MAX_COPY_DEPTH, withViewport, type Context, type UseChain } from "./svg-context.js";
import type { SvgFile } from "./svg-file.js";
import { attribute } from "./svg-tree.js";
import { computeStyle, declaredValue, type Style } from "./style.js";
import { parseTransform } from "./transform.js";
import { isEmptyViewBox, parseViewBox, viewBoxMap } from "./svg-viewport.js";

function orientRad(text: string): number {
  const turn = parseTransform(`rotate(${text})`);
  return turn === null ? 0 : Math.atan2(turn.b, turn.a);
}

/**
 * A length, or left/center/right and top/center/bottom of the box. Percentages refer to the enclosing
 * viewport.
 */
function refPosition(text: string, start: number, length: number, basis: LengthBasis, side: Side): number {
  const share = { left: 0, top: 0, center: 0.5, right: 1, bottom: 1 }[text];
  return share === undefined ? (lengthPx(text, basis, side) ?? 0) : start + share * length;
}

export class SvgMarkers {
  constructor(
    private readonly file: SvgFile,
    private readonly clips: SvgClips,
  ) {}

  /**
   * The context for the content of `marker` at `place` on a shape drawn in `context`; null if nothing is
   * visible.
   */
  insideOf(marker: number, place: MarkerPlace, context: Context): Context | null {
    const { tree } = this.file;
    const text = (name: string): string | undefined => attribute(tree, marker, name);
    const length = (name: string, side: Side, normal: number): number =>
      lengthPx(text(name) ?? "", context.basis, side) ?? normal;
    const width = length("markerWidth", "width", 3);
    const height = length("markerHeight", "height", 3);
    if (!(width > 0 && height > 0) || isEmptyViewBox(text("viewBox"))) return null;
    const box = parseViewBox(text("viewBox"));
    const fit = box === null ? IDENTITY : viewBoxMap(box, width, height, text("preserveAspectRatio"));
    const orient = text("orient") ?? "0";
    const isReversed = orient === "auto-start-reverse" && place.kind === "start";
    const angle = orient.startsWith("auto") ? place.angle + (isReversed ? Math.PI : 0) : orientRad(orient);
    const size = text("markerUnits") === "userSpaceOnUse" ? 1 : context.style.strokeWidth;
    const refX = refPosition(text("refX") ?? "0", box?.x ?? 0, box?.width ?? width, context.basis, "width");
    const refY = refPosition(
      text("refY") ?? "0",
      box?.y ?? 0,
      box?.height ?? height,
      context.basis,
      "height",
    );
    const turned = compose(translation(place.x, place.y), compose(rotation(angle), scaling(size)));
    // The reference point lies on the vertex, not the viewBox's corner.
    const map = compose(turned, { ...fit, e: fit.a * -refX, f: fit.d * -refY });
    if (determinant(map) === 0 || !isFiniteAffine(map)) return null;
    const depth = (context.uses?.depth ?? 0) + 1;
    if (depth > MAX_COPY_DEPTH) return null;
    const uses: UseChain = {
      element: marker,
      target: marker,
      size: { width: null, height: null },
      outer: context.uses,
      depth,
    };
    const declared = this.file.cascade.declaredOf(marker);
    const outside = this.file.styleAround(marker, context.basis);
    const style = computeStyle(outside, declared, { ...context.basis, fontSize: outside.fontSize });
    const inside = {
      ...withViewport(context, map, box?.width ?? width, box?.height ?? height),
      style,
      uses,
      ...contextPaints(context),
    };
    const overflow = this.overflowOf(marker, declared, style);
    if (overflow === "visible" || overflow === "auto") return inside;
    // The marker's viewport, in its content's units.
    const x = -fit.e / fit.a;
    const y = -fit.f / fit.d;
    return { ...inside, clip: this.clips.rectangleClip(inside, x, y, width / fit.a, height / fit.d) };
  }

  /** `inherit` takes the value of the element around the marker. */
  private overflowOf(marker: number, declared: Declared, style: Style): string | undefined {
    if (declared.get("overflow") !== "inherit") return declaredValue(style, declared, "overflow");
    const around = this.file.cascade.declaredOf(this.file.tree.parents[marker]);
    return declaredValue(style, around, "overflow") ?? "visible";
  }
}
