import type { WarningCode } from "../../warnings.js";
import type { Color } from "../../color.js";

/** CSS properties that the importer uses; those in PRESENTATION may also be written as attributes. */
export const PRESENTATION = [
  "fill",
  "fill-opacity",
  "fill-rule",
  "stroke",
  "stroke-width",
  "stroke-opacity",
  "stroke-dasharray",
  "stroke-dashoffset",
  "clip-rule",
  "color",
  "visibility",
  "font-family",
  "font-size",
  "font-style",
  "font-weight",
  "text-anchor",
  "letter-spacing",
  "word-spacing",
  "writing-mode",
  "direction",
  "dominant-baseline",
  "alignment-baseline",
  "baseline-shift",
  "text-decoration",
  "text-decoration-line",
  "font-variant",
  "white-space",
  "marker-start",
  "marker-mid",
  "marker-end",
  "display",
  "opacity",
  "clip-path",
  "mask",
  "mask-type",
  "filter",
  "mix-blend-mode",
  "paint-order",
  "overflow",
  "transform",
  "transform-origin",
  "vector-effect",
  "stop-color",
  "stop-opacity",
] as const;
const CSS_ONLY = [
  "background",
  "background-color",
  "font",
  "font-kerning",
  "transform-box",
  "text-transform",
  "translate",
  "rotate",
  "scale",
  "x",
  "y",
  "width",
  "height",
  "cx",
  "cy",
  "r",
  "rx",
  "ry",
  "d",
] as const;

/** Properties that a browser draws and plotwright does not, with the warning for each. All may also be attributes. */
export const NOT_DRAWN_PROPERTIES: ReadonlyMap<string, WarningCode> = new Map<string, WarningCode>([
  ["backdrop-filter", "filter-ignored"],
  ["mask-image", "mask-ignored"],
  ["animation", "animation-ignored"],
  ["animation-name", "animation-ignored"],
  ["offset-path", "effect-ignored"],
  ["outline", "effect-ignored"],
  ["perspective", "effect-ignored"],
  ["zoom", "effect-ignored"],
  ["text-shadow", "effect-ignored"],
  ["text-emphasis", "text-style-ignored"],
  ["text-decoration-style", "text-style-ignored"],
  ["text-orientation", "text-style-ignored"],
  ["glyph-orientation-vertical", "text-style-ignored"],
  ["unicode-bidi", "text-style-ignored"],
  ["font-size-adjust", "text-style-ignored"],
  ["font-variant-ligatures", "text-style-ignored"],
  ["font-variant-numeric", "text-style-ignored"],
  ["font-variant-position", "text-style-ignored"],
  ["text-underline-offset", "text-style-ignored"],
  ["text-decoration-thickness", "text-style-ignored"],
  ["font-feature-settings", "text-style-ignored"],
  ["font-variation-settings", "text-style-ignored"],
  ["font-stretch", "text-style-ignored"],
  ["inline-size", "text-style-ignored"],
  ["shape-inside", "text-style-ignored"],
]);

export type Property = (typeof PRESENTATION)[number] | (typeof CSS_ONLY)[number];

export const IS_PROPERTY: ReadonlySet<string> = new Set<string>([...PRESENTATION, ...CSS_ONLY]);

/** Properties whose values are only keywords. */
export const IS_KEYWORD: ReadonlySet<string> = new Set<Property>([
  "display",
  "visibility",
  "overflow",
  "fill-rule",
  "clip-rule",
  "text-anchor",
  "vector-effect",
]);

/** The winning values of one element by property, including custom properties (`--x`). */
export type Declared = ReadonlyMap<string, string>;

export function isSameDeclared(a: Declared, b: Declared): boolean {
  if (a.size !== b.size) return false;
  for (const [property, value] of a) if (b.get(property) !== value) return false;
  return true;
}

/** What a shape is filled or stroked with. */
export type Paint =
  | { readonly kind: "none" }
  | { readonly kind: "color"; readonly color: Color }
  | { readonly kind: "currentColor" }
  | { readonly kind: "context"; readonly of: "fill" | "stroke" }
  /** A gradient or pattern, by id, and what to use where there is none. */
  | { readonly kind: "server"; readonly id: string; readonly fallback: Paint };
