/** The context inside a marker: where it stands, how it is turned, scaled and cut (SVG 2, §11.6). */
import {
  compose,
  determinant,
  IDENTITY,
  isFiniteAffine,
  rotation,
  scaling,
  translation,
} from "../../geometry/affine.js";
import type { Cascade } from "./cascade.js";
import { Declared } from "./declared.js";
import { lengthPx, type Side } from "./length.js";
import type { MarkerPlace } from "./markers.js";
import type { SvgClips } from "./svg-clips.js";
import { MAX_COPY_DEPTH, withViewport, type Context, type UseChain } from "./svg-context.js";
import { attribute, type SvgTree } from "./svg-tree.js";
import { computeStyle, declaredValue, INITIAL_STYLE } from "./style.js";
import { parseTransform } from "./transform.js";
import { parseViewBox, viewBoxMap } from "./view-box.js";

const MARKED = new Set(["path", "line", "polyline", "polygon"]);

export const isMarked = (tag: string, { style }: Context): boolean =>
  MARKED.has(tag) && (style.markerStart !== null || style.markerMid !== null || style.markerEnd !== null);

function orientRad(text: string): number {
  const turn = parseTransform(`rotate(${text})`);
  return turn === null ? 0 : Math.atan2(turn.b, turn.a);
}

/** A number, a share of the box, or left/center/right and top/center/bottom. */
function refPosition(text: string | undefined, start: number, length: number): number {
  const share = { left: 0, top: 0, center: 0.5, right: 1, bottom: 1 }[text ?? ""];
  if (share !== undefined) return start + share * length;
  const basis = { fontSize: 16, rootFontSize: 16, viewportWidth: length, viewportHeight: length };
  return lengthPx(text ?? "0", basis, "width") ?? 0;
}

export class SvgMarkers {
  private readonly declared = new Declared();

  constructor(
    private readonly tree: SvgTree,
    private readonly cascade: Cascade,
    private readonly clips: SvgClips,
  ) {}

  /** For the content of `marker` at `place` on a shape drawn in `context`; null where it shows nothing. */
  insideOf(marker: number, place: MarkerPlace, context: Context): Context | null {
    const { tree, declared } = this;
    const text = (name: string): string | undefined => attribute(tree, marker, name);
    const length = (name: string, side: Side, normal: number): number =>
      lengthPx(text(name) ?? "", context.basis, side) ?? normal;
    const width = length("markerWidth", "width", 3);
    const height = length("markerHeight", "height", 3);
    if (!(width > 0 && height > 0)) return null;
    const box = parseViewBox(text("viewBox"));
    const fit = box === null ? IDENTITY : viewBoxMap(box, width, height, text("preserveAspectRatio"));
    const orient = text("orient") ?? "0";
    const isReversed = orient === "auto-start-reverse" && place.kind === "start";
    const angle = orient.startsWith("auto") ? place.angle + (isReversed ? Math.PI : 0) : orientRad(orient);
    const size = text("markerUnits") === "userSpaceOnUse" ? 1 : context.style.strokeWidth;
    const refX = refPosition(text("refX"), box?.x ?? 0, box?.width ?? width);
    const refY = refPosition(text("refY"), box?.y ?? 0, box?.height ?? height);
    const turned = compose(translation(place.x, place.y), compose(rotation(angle), scaling(size)));
    // The reference point, not the viewBox's corner, lies on the vertex.
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
    this.cascade.collect(marker, declared);
    const style = computeStyle(INITIAL_STYLE, declared, context.basis);
    if (declaredValue(style, declared, "display") === "none") return null;
    const inside = {
      ...withViewport(context, map, box?.width ?? width, box?.height ?? height),
      style,
      uses,
      contextFill: context.style.fill,
      contextStroke: context.style.stroke,
    };
    const overflow = declaredValue(style, declared, "overflow");
    if (overflow === "visible" || overflow === "auto") return inside;
    const edge = box ?? { x: 0, y: 0, width, height };
    return { ...inside, clip: this.clips.rectangleClip(inside, edge.x, edge.y, edge.width, edge.height) };
  }
}
