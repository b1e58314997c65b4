/** Computed style: inherited and declared properties, as values ready for drawing. */
import type { Declared, Property, Paint } from "./properties.js";
import type { Color, ColorParser } from "../../color.js";
import { computeTextStyle, INITIAL_TEXT_STYLE, type TextStyle } from "./text-style.js";
import { lengthPx, listIn, splitLength, type LengthBasis } from "./length.js";
import { clamp } from "../../../geometry/polyline.js";

/** The inherited properties. */
export interface Style {
  readonly fill: Paint;
  readonly fillOpacity: number;
  readonly fillRule: "nonzero" | "evenodd";
  readonly stroke: Paint;
  readonly strokeOpacity: number;
  /** User units, as are the dashes. */
  readonly strokeWidth: number;
  readonly dashes: readonly number[] | null;
  readonly dashOffset: number;
  readonly clipRule: "nonzero" | "evenodd";
  readonly color: Color;
  readonly isVisible: boolean;
  readonly fontFamily: string;
  /** px */
  readonly fontSize: number;
  readonly isItalic: boolean;
  readonly isBold: boolean;
  readonly textAnchor: "start" | "middle" | "end";
  readonly letterSpacing: number;
  readonly text: TextStyle;
  readonly markerStart: string | null;
  readonly markerMid: string | null;
  readonly markerEnd: string | null;
  /** Custom properties (`--x`); null where none is set. */
  readonly variables: ReadonlyMap<string, string> | null;
}

const NONE: Paint = { kind: "none" };
const BLACK: Color = { hex: "#000000", alpha: 1 };

/** CSS initial values. */
export const INITIAL_STYLE: Style = {
  fill: { kind: "color", color: BLACK },
  fillOpacity: 1,
  fillRule: "nonzero",
  stroke: NONE,
  strokeOpacity: 1,
  strokeWidth: 1,
  dashes: null,
  dashOffset: 0,
  clipRule: "nonzero",
  color: BLACK,
  isVisible: true,
  fontFamily: "sans-serif",
  fontSize: 16,
  isItalic: false,
  isBold: false,
  textAnchor: "start",
  letterSpacing: 0,
  text: INITIAL_TEXT_STYLE,
  markerStart: null,
  markerMid: null,
  markerEnd: null,
  variables: null,
};

type Mutable<T> = { -readonly [K in keyof T]: T[K] };

/** How a property is read into a field of the style. */
interface Reader {
  readonly field: keyof Style;
  /** Undefined for an invalid value: the inherited one stays, as if it were not declared. */
  readonly read: (
    value: string,
    basis: LengthBasis,
    parseColor: ColorParser,
  ) => Style[keyof Style] | undefined;
}

const reader = <Field extends keyof Style>(
  field: Field,
  read: (value: string, basis: LengthBasis, parseColor: ColorParser) => Style[Field] | undefined,
): Reader => ({ field, read });

const oneOf =
  <T extends string>(...keywords: readonly T[]) =>
  (value: string): T | undefined =>
    keywords.find((keyword) => keyword === value);

const opacityOf = (value: string): number | undefined => parseOpacity(value) ?? undefined;
const lengthOf = (value: string, basis: LengthBasis): number | undefined =>
  lengthPx(value, basis, "both") ?? undefined;

const paintOf = (value: string, _basis: LengthBasis, parseColor: ColorParser): Paint | undefined =>
  parsePaint(value, parseColor);

const READERS: Partial<Record<Property, Reader>> = {
  fill: reader("fill", paintOf),
  stroke: reader("stroke", paintOf),
  "fill-opacity": reader("fillOpacity", opacityOf),
  "stroke-opacity": reader("strokeOpacity", opacityOf),
  "fill-rule": reader("fillRule", oneOf("nonzero", "evenodd")),
  "clip-rule": reader("clipRule", oneOf("nonzero", "evenodd")),
  "stroke-width": reader("strokeWidth", (value, basis) => {
    const width = lengthOf(value, basis);
    return width !== undefined && width >= 0 ? width : undefined;
  }),
  "stroke-dasharray": reader("dashes", parseDashes),
  "stroke-dashoffset": reader("dashOffset", lengthOf),
  color: reader("color", (value, _basis, parseColor) => parseColor(value) ?? undefined),
  visibility: reader("isVisible", (value) =>
    /^(visible|hidden|collapse)$/.test(value) ? value === "visible" : undefined,
  ),
  "font-family": reader("fontFamily", (value) => value),
  "font-style": reader("isItalic", (value) => value === "italic" || value.startsWith("oblique")),
  "font-weight": reader("isBold", (value) => value === "bold" || value === "bolder" || Number(value) >= 600),
  "text-anchor": reader("textAnchor", oneOf("start", "middle", "end")),
  "letter-spacing": reader("letterSpacing", (value, basis) =>
    value === "normal" ? 0 : (lengthPx(value, basis, "width") ?? undefined),
  ),
  "marker-start": reader("markerStart", parseUrl),
  "marker-mid": reader("markerMid", parseUrl),
  "marker-end": reader("markerEnd", parseUrl),
};

/** The style of an element that declares `declared` below `parent`; `parent` itself if nothing changes. */
export function computeStyle(
  parent: Style,
  declared: Declared,
  basis: LengthBasis,
  parseColor: ColorParser,
): Style {
  if (declared.size === 0) return parent;
  const style: Mutable<Style> = { ...parent };
  setVariables(style, declared);
  // Font size first, since em in the other properties refers to it; em in font-size refers to the parent's.
  const font = declared.get("font");
  if (font !== undefined) setFont(style, resolve(style, font) ?? "", basis);
  const size = declared.get("font-size");
  if (size !== undefined) style.fontSize = parseFontSize(resolve(style, size) ?? "", parent, basis);
  const own = style.fontSize === basis.fontSize ? basis : { ...basis, fontSize: style.fontSize };
  for (const [property, declaredText] of declared) {
    const known = READERS[property as Property];
    if (known === undefined) continue;
    const { field, read } = known;
    const text = resolve(style, declaredText);
    if (text === null) continue;
    const origin = originOf(text, parent);
    const value = origin === null ? read(text, own, parseColor) : origin[field];
    if (value !== undefined) Object.assign(style, { [field]: value });
  }
  style.text = computeTextStyle(
    parent.text,
    (property) => declaredValue(style, declared, property),
    style,
    (length) => lengthPx(length, own, "width"),
  );
  return style;
}

/** The value of a non-inherited property with its variables resolved; undefined if it is not declared. */
export function declaredValue(style: Style, declared: Declared, property: Property): string | undefined {
  const raw = declared.get(property);
  if (raw === undefined) return undefined;
  const value = resolve(style, raw);
  return value === null || /^(inherit|initial|unset|revert)$/.test(value) ? undefined : value;
}

function setVariables(style: Mutable<Style>, declared: Declared): void {
  let own: Map<string, string> | null = null;
  for (const [property, value] of declared) {
    if (!property.startsWith("--")) continue;
    own ??= new Map(style.variables ?? []);
    own.set(property, value);
  }
  if (own !== null) style.variables = own;
}

const MAX_VARIABLE_STEPS = 32;
const MAX_VALUE_CHARS = 100_000;

/** Resolves var(--x, fallback); null if a variable is missing, circular or grows without limit. */
function resolve(style: Style, raw: string): string | null {
  let value = raw.trim();
  for (let step = 0; value.includes("var("); step++) {
    if (step === MAX_VARIABLE_STEPS || value.length > MAX_VALUE_CHARS) return null;
    const match = /var\(\s*(--[^\s,()]+)\s*(?:,((?:[^()]|\([^()]*\))*))?\)/.exec(value);
    if (match === null) return null;
    const filled = style.variables?.get(match[1]) ?? match[2];
    if (filled === undefined) return null;
    value = (value.slice(0, match.index) + filled.trim() + value.slice(match.index + match[0].length)).trim();
  }
  return value;
}

/** The style that one of CSS's global keywords refers to. All these properties inherit, so unset = inherit. */
function originOf(value: string, parent: Style): Style | null {
  if (value === "inherit" || value === "unset" || value === "revert") return parent;
  return value === "initial" ? INITIAL_STYLE : null;
}

/** Whether a fill or stroke is not a paint, so that the inherited one applies. */
export const isUnknownPaint = (text: string, parseColor: ColorParser): boolean =>
  parsePaint(text, parseColor) === undefined;

function parsePaint(text: string, parseColor: ColorParser): Paint | undefined {
  const value = text.trim();
  if (value.toLowerCase() === "none") return NONE;
  if (value.toLowerCase() === "currentcolor") return { kind: "currentColor" };
  if (value === "context-fill") return { kind: "context", of: "fill" };
  if (value === "context-stroke") return { kind: "context", of: "stroke" };
  const server = /^url\(([^)]*)\)\s*(.*)$/s.exec(value);
  if (server !== null) {
    const fallback = server[2] === "" ? NONE : (parsePaint(server[2], parseColor) ?? NONE);
    return { kind: "server", id: parseUrl(value) ?? "", fallback };
  }
  const color = parseColor(value);
  return color === null ? undefined : { kind: "color", color };
}

/** The id in url(#id), with or without quotes; null for `none` and for other documents. */
export function parseUrl(text: string): string | null {
  const match = /^\s*url\(\s*["']?#([^"')]*)["']?\s*\)/.exec(text);
  return match === null ? null : match[1].trim();
}

/** 0 … 1; null if malformed. */
export function parseOpacity(text: string): number | null {
  const parts = splitLength(text);
  if (parts === null || (parts.unit !== "" && parts.unit !== "%")) return null;
  const value = parts.unit === "%" ? parts.value / 100 : parts.value;
  return clamp(value, 0, 1);
}

/** An even number of lengths; null for a solid line; undefined if malformed. */
function parseDashes(text: string, basis: LengthBasis): readonly number[] | null | undefined {
  if (text === "none") return null;
  if (/,\s*,/.test(text)) return undefined;
  const lengths = listIn(text).map((part) => lengthPx(part, basis, "both"));
  if (lengths.some((length) => length === null || length < 0)) return undefined;
  const known = lengths as number[];
  const sum = known.reduce((total, length) => total + length, 0);
  if (!(sum > 0) || !Number.isFinite(sum)) return null;
  return known.length % 2 === 0 ? known : [...known, ...known];
}

/** CSS Fonts 4, §2.5: the usual sizes of the keywords in px. */
const FONT_SIZES: Readonly<Record<string, number>> = {
  "xx-small": 9,
  "x-small": 10,
  small: 13,
  medium: 16,
  large: 18,
  "x-large": 24,
  "xx-large": 32,
};

function parseFontSize(text: string, parent: Style, basis: LengthBasis): number {
  if (Object.hasOwn(FONT_SIZES, text)) return FONT_SIZES[text];
  if (text === "smaller") return parent.fontSize / 1.2;
  if (text === "larger") return parent.fontSize * 1.2;
  if (text === "initial") return INITIAL_STYLE.fontSize;
  const percent = splitLength(text);
  if (percent?.unit === "%") return (percent.value / 100) * parent.fontSize;
  const size = lengthPx(text, { ...basis, fontSize: parent.fontSize }, "height");
  return size !== null && size >= 0 ? size : parent.fontSize;
}

/** The shorthand: [style weight …] size[/line-height] family. */
function setFont(style: Mutable<Style>, text: string, basis: LengthBasis): void {
  const match =
    /^(.*?)\s*(?<![\w-])([\d.]+(?:px|pt|pc|mm|cm|in|em|rem|%|q)|[a-z]+-?(?:small|large)|medium)(?:\/\S+)?\s+(.+)$/i.exec(
      text,
    );
  if (match === null) return;
  style.isItalic = /italic|oblique/.test(match[1]);
  style.isBold = /bold|[6-9]00/.test(match[1]);
  style.fontSize = parseFontSize(match[2], style, basis);
  style.fontFamily = match[3];
}
