/** The inherited state of an element: passed down the tree, never changed. */
import { compose, IDENTITY, type Affine } from "../../geometry/affine.js";
import type { ClipNode } from "../clip-node.js";
import type { LengthBasis } from "./css/length.js";
import type { Paint } from "./css/properties.js";
import type { Style } from "./css/style.js";

export interface Context {
  /** User units to page mm. */
  readonly map: Affine;
  readonly style: Style;
  readonly basis: LengthBasis;
  /** Index into the drawing's groups. */
  readonly group: number;
  readonly clip: ClipNode | null;
  /** The share of the usual speed at which it is drawn. */
  readonly speedFactor: number;
  /** The enclosing `use` elements. */
  readonly uses: UseChain | null;
  /** The values of context-fill and context-stroke inside a marker. */
  readonly contextFill: Paint;
  readonly contextStroke: Paint;
}

export interface UseChain {
  readonly element: number;
  readonly target: number;
  /** Width and height of the `use`, if its target is a symbol or svg. */
  readonly size: { readonly width: number | null; readonly height: number | null };
  readonly outer: UseChain | null;
  /** Number of enclosing `use` elements, including this one. */
  readonly depth: number;
}

/** The values of context-fill and context-stroke inside content drawn for an element with this context. */
export function contextPaints({
  style,
  contextFill,
  contextStroke,
}: Context): Pick<Context, "contextFill" | "contextStroke"> {
  const resolved = (paint: Paint): Paint => {
    if (paint.kind === "currentColor") return { kind: "color", color: style.color };
    if (paint.kind === "context") return paint.of === "fill" ? contextFill : contextStroke;
    return paint;
  };
  return { contextFill: resolved(style.fill), contextStroke: resolved(style.stroke) };
}

/** Copies of copies deeper than this are a cycle or an attack. */
export const MAX_COPY_DEPTH = 200;

export const isInsideUseOf = (chain: UseChain | null, target: number): boolean => {
  for (let at = chain; at !== null; at = at.outer) if (at.target === target) return true;
  return false;
};

/** The context inside an element with this style and transform. */
export function withStyle(context: Context, style: Style, transform: Affine): Context {
  if (style === context.style && transform === IDENTITY) return context;
  const basis =
    style.fontSize === context.basis.fontSize
      ? context.basis
      : { ...context.basis, fontSize: style.fontSize };
  const map = transform === IDENTITY ? context.map : compose(context.map, transform);
  return { ...context, map, style, basis };
}

/** The context inside a new viewport; `map` converts its user units to those outside. */
export const withViewport = (context: Context, map: Affine, width: number, height: number): Context => ({
  ...context,
  map: compose(context.map, map),
  basis: { ...context.basis, viewportWidth: width, viewportHeight: height },
});

/** Elements that may have markers. */
const MARKED = new Set(["path", "line", "polyline", "polygon"]);

/** Whether the shape may have markers. */
export const isMarked = (tag: string, { style }: Context): boolean =>
  MARKED.has(tag) && (style.markerStart !== null || style.markerMid !== null || style.markerEnd !== null);

/** For results that depend only on an element and where its content is drawn. */
export const contentKey = (element: number, { map }: Context): string =>
  [element, map.a, map.b, map.c, map.d, map.e, map.f].join(" ");
