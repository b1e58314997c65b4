/** CSS and SVG properties of text: baselines, spaces, decorations, directions. */
import type { Declared } from "./declared.js";
import type { Property } from "./properties.js";
import type { Paint } from "./paint.js";

/** Approximate metrics of browser fonts: above and below the baseline, and x-height. */
const ASCENT_EM = 0.9;
const DESCENT_EM = 0.21;
const X_HEIGHT_EM = 0.46;
const CENTRAL_EM = (ASCENT_EM - DESCENT_EM) / 2;

export interface TextStyle {
  /** px after each blank. */
  readonly wordSpacing: number;
  readonly isVertical: boolean;
  readonly isRightToLeft: boolean;
  readonly isSmallCaps: boolean;
  readonly transform: string;
  /** Whether blanks are preserved; null if CSS does not specify it. */
  readonly keepsBlanks: boolean | null;
  readonly dominantBaseline: string;
  readonly alignmentBaseline: string;
  /** px upwards, summed over all enclosing elements. */
  readonly baselineShift: number;
  readonly decorations: readonly Decoration[];
}

/** A line along the text, in the colours of the element that declares it. */
export interface Decoration {
  readonly kind: DecorationKind;
  readonly fill: Paint;
  readonly stroke: Paint;
}

const DECORATIONS = ["underline", "overline", "line-through"] as const;
type DecorationKind = (typeof DECORATIONS)[number];

/** em below the baseline. */
export const DECORATION_EM: Readonly<Record<DecorationKind, number>> = {
  underline: 0.12,
  overline: -ASCENT_EM,
  "line-through": -X_HEIGHT_EM / 2,
};

export const INITIAL_TEXT_STYLE: TextStyle = {
  wordSpacing: 0,
  isVertical: false,
  isRightToLeft: false,
  isSmallCaps: false,
  transform: "none",
  keepsBlanks: null,
  dominantBaseline: "auto",
  alignmentBaseline: "auto",
  baselineShift: 0,
  decorations: [],
};

const HEIGHT_EM = ASCENT_EM + DESCENT_EM;

/** em by which letters move down, so that this baseline lies on the text's line. */
const BASELINES: Readonly<Record<string, number>> = {
  middle: X_HEIGHT_EM / 2,
  central: CENTRAL_EM,
  hanging: 0.8 * ASCENT_EM,
  mathematical: ASCENT_EM / 2,
  "before-edge": ASCENT_EM,
  "text-before-edge": ASCENT_EM,
  "after-edge": -DESCENT_EM,
  "text-after-edge": -DESCENT_EM,
  ideographic: -DESCENT_EM,
};

/** px downwards: offset of the letters from the text's line. */
export function baselineOffset(text: TextStyle, fontSize: number): number {
  const usual = text.isVertical ? CENTRAL_EM : 0;
  const own = BASELINES[text.alignmentBaseline] ?? BASELINES[text.dominantBaseline] ?? usual;
  return own * fontSize - text.baselineShift;
}

const PROPERTIES: ReadonlySet<string> = new Set<Property>([
  "word-spacing",
  "writing-mode",
  "direction",
  "font-variant",
  "text-transform",
  "white-space",
  "dominant-baseline",
  "alignment-baseline",
  "baseline-shift",
  "text-decoration",
  "text-decoration-line",
]);

/** Whether `computeTextStyle` would change anything. */
export function declaresTextStyle(declared: Declared): boolean {
  for (let i = 0; i < declared.size; i++) if (PROPERTIES.has(declared.nameAt(i))) return true;
  return false;
}

/**
 * @param valueOf the element's declared values
 * @param style the element's own style
 * @param lengthOf px; null if malformed
 */
export function computeTextStyle(
  parent: TextStyle,
  valueOf: (property: Property) => string | undefined,
  style: { readonly fill: Paint; readonly stroke: Paint; readonly fontSize: number },
  lengthOf: (text: string) => number | null,
): TextStyle {
  const changes: { -readonly [K in keyof TextStyle]?: TextStyle[K] } = {};
  const spacing = valueOf("word-spacing");
  if (spacing !== undefined) {
    changes.wordSpacing = spacing === "normal" ? 0 : (lengthOf(spacing) ?? parent.wordSpacing);
  }
  const mode = valueOf("writing-mode");
  if (mode !== undefined) changes.isVertical = /^(tb|tb-rl|vertical-.*|sideways-.*)$/.test(mode);
  const direction = valueOf("direction");
  if (direction !== undefined) changes.isRightToLeft = direction === "rtl";
  const variant = valueOf("font-variant");
  if (variant !== undefined) changes.isSmallCaps = /\bsmall-caps\b/.test(variant);
  changes.transform = valueOf("text-transform") ?? parent.transform;
  const space = valueOf("white-space");
  if (space !== undefined) changes.keepsBlanks = /^(pre|pre-wrap|break-spaces)$/.test(space);
  const dominant = valueOf("dominant-baseline");
  if (dominant !== undefined && dominant !== "auto") changes.dominantBaseline = dominant;
  changes.alignmentBaseline = valueOf("alignment-baseline") ?? parent.alignmentBaseline;
  const shift = valueOf("baseline-shift");
  if (shift !== undefined)
    changes.baselineShift = parent.baselineShift + shiftOf(shift, style.fontSize, lengthOf);
  const decoration = `${valueOf("text-decoration") ?? ""} ${valueOf("text-decoration-line") ?? ""}`;
  const added = DECORATIONS.filter((kind) => decoration.split(/\s+/).includes(kind));
  if (added.length > 0) {
    const { fill, stroke } = style;
    changes.decorations = [...parent.decorations, ...added.map((kind) => ({ kind, fill, stroke }))];
  }
  const isSame = (Object.keys(changes) as (keyof TextStyle)[]).every((key) => changes[key] === parent[key]);
  return isSame ? parent : { ...parent, ...changes };
}

function shiftOf(text: string, fontSize: number, lengthOf: (text: string) => number | null): number {
  if (text === "baseline") return 0;
  if (text === "sub") return (-HEIGHT_EM / 2) * fontSize;
  if (text === "super") return (HEIGHT_EM / 2) * fontSize;
  if (text.endsWith("%")) return (parseFloat(text) / 100) * fontSize || 0;
  return lengthOf(text) ?? 0;
}
