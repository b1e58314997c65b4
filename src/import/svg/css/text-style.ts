/** CSS and SVG properties of text: baselines, spaces, decorations, directions. */
import type { Property, Paint } from "./properties.js";
import type { FontMetrics } from "../../text/text-font.js";

export interface TextStyle {
  /** px after each blank. */
  readonly wordSpacing: number;
  readonly isVertical: boolean;
  readonly isRightToLeft: boolean;
  readonly isSmallCaps: boolean;
  readonly hasKerning: boolean;
  readonly transform: string;
  /** Whether blanks are preserved; null if CSS does not specify it. */
  readonly keepsBlanks: boolean | null;
  readonly dominantBaseline: string;
  readonly alignmentBaseline: string;
  /** px upwards, summed over the enclosing spans. */
  readonly baselineShift: number;
  /** Font sizes in px of the enclosing subscripts and superscripts, summed: the font says how far each shifts. */
  readonly subscriptPx: number;
  readonly superscriptPx: number;
  readonly decorations: readonly Decoration[];
}

/** A line along the text, in the colours of the element that declares it. */
interface Decoration {
  readonly kind: DecorationKind;
  readonly fill: Paint;
  readonly stroke: Paint;
}

const DECORATIONS = ["underline", "overline", "line-through"] as const;
type DecorationKind = (typeof DECORATIONS)[number];

/** em of the line's middle above the baseline. */
export function decorationHeight(kind: DecorationKind, metrics: FontMetrics): number {
  if (kind === "overline") return metrics.ascent;
  return kind === "underline" ? metrics.underline : metrics.strikeout;
}

export const INITIAL_TEXT_STYLE: TextStyle = {
  wordSpacing: 0,
  isVertical: false,
  isRightToLeft: false,
  isSmallCaps: false,
  hasKerning: true,
  transform: "none",
  keepsBlanks: null,
  dominantBaseline: "auto",
  alignmentBaseline: "auto",
  baselineShift: 0,
  subscriptPx: 0,
  superscriptPx: 0,
  decorations: [],
};

/** em by which letters move down, so that this baseline lies on the text's line. */
const BASELINES: Readonly<Record<string, (metrics: FontMetrics) => number>> = {
  middle: ({ xHeight }) => xHeight / 2,
  central: ({ ascent, descent }) => (ascent - descent) / 2,
  hanging: ({ ascent }) => 0.8 * ascent,
  mathematical: ({ ascent }) => ascent / 2,
  "before-edge": ({ ascent }) => ascent,
  "text-before-edge": ({ ascent }) => ascent,
  "after-edge": ({ descent }) => -descent,
  "text-after-edge": ({ descent }) => -descent,
  ideographic: ({ descent }) => -descent,
};

/** px downwards: offset of the letters from the text's line. */
export function baselineOffset(text: TextStyle, fontSize: number, metrics: FontMetrics): number {
  const usual = text.isVertical ? BASELINES["central"] : (): number => 0;
  const own = BASELINES[text.alignmentBaseline] ?? BASELINES[text.dominantBaseline] ?? usual;
  const { baselineShift, subscriptPx, superscriptPx } = text;
  const shift = baselineShift + superscriptPx * metrics.superscript - subscriptPx * metrics.subscript;
  return own(metrics) * fontSize - shift;
}

/** What an element passes on to its children: `alignment-baseline` is its own. */
export const withoutAlignment = (text: TextStyle): TextStyle =>
  text.alignmentBaseline === "auto" ? text : { ...text, alignmentBaseline: "auto" };

/** `baseline-shift` applies only to the spans inside a text, not to the text itself or what is around it. */
export const withoutShift = (text: TextStyle): TextStyle =>
  text.baselineShift === 0 && text.subscriptPx === 0 && text.superscriptPx === 0
    ? text
    : { ...text, baselineShift: 0, subscriptPx: 0, superscriptPx: 0 };

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
  const kerning = valueOf("font-kerning");
  if (kerning !== undefined) changes.hasKerning = kerning !== "none";
  changes.transform = valueOf("text-transform") ?? parent.transform;
  const space = valueOf("white-space");
  if (space !== undefined) changes.keepsBlanks = /^(pre|pre-wrap|break-spaces)$/.test(space);
  const dominant = valueOf("dominant-baseline");
  if (dominant !== undefined && dominant !== "auto") changes.dominantBaseline = dominant;
  changes.alignmentBaseline = valueOf("alignment-baseline") ?? parent.alignmentBaseline;
  const shift = valueOf("baseline-shift");
  if (shift === "sub") changes.subscriptPx = parent.subscriptPx + style.fontSize;
  else if (shift === "super") changes.superscriptPx = parent.superscriptPx + style.fontSize;
  else if (shift !== undefined) {
    changes.baselineShift = parent.baselineShift + shiftOf(shift, style.fontSize, lengthOf);
  }
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
  if (text.endsWith("%")) return (parseFloat(text) / 100) * fontSize || 0;
  return lengthOf(text) ?? 0;
}
