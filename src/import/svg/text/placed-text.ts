/**
 * SVG text to positioned letters (SVG 2, chapter 11): collects the characters with their style, path and x,
 * y, dx, dy, rotate values, then lays them out. Imported only for files that have text.
 */
import type { Declared } from "../css/properties.js";
import { lengthPx, listIn, type LengthBasis, type Side } from "../css/length.js";
import { attribute, childrenOf, tagOf, textOf, TEXT_NODE } from "../svg-tree.js";
import { type Effects, effectsOf } from "../svg-effects.js";
import { declaredValue, type Style } from "../css/style.js";
import { getOrAdd } from "../../../get-or-add.js";
import { withoutAlignment, withoutShift } from "../css/text-style.js";
import type { Context } from "../svg-context.js";
import type { SvgFile } from "../svg-file.js";
import { type Char, type LaidOutText, type Stretch, layOutText } from "./text-layout.js";
import { SvgTextPaths } from "./text-path.js";
import type { SvgGeometry } from "../shapes/basic-shapes.js";
import type { ImportOptions } from "../../import-options.js";
import { fontOf } from "../../text/single-stroke-font.js";
import type { TextFont } from "../../text/text-font.js";
import { RAD_PER_DEG } from "../../../units.js";

export interface PlacedText extends LaidOutText {
  /** Elements that are not laid out: a textPath without a path, and unsupported kinds. */
  readonly unsupported: readonly string[];
  /** Effects of the spans that a browser draws and a pen cannot. */
  readonly effects: Effects;
  /** Start of the text, in user units. */
  readonly x: number;
  readonly y: number;
}

/** What the characters inside an element have in common. */
interface Inside extends Pick<Char, "style" | "path" | "keepsBlanks" | "stretch"> {
  /** Indices of the spans around them. */
  readonly open: readonly number[];
}

/** Three or more combining marks in a row: few fonts place all of them correctly. */
const STACKED_ACCENTS = /\p{M}{3}/u;
const MAX_CHARS = 100_000;
const MAX_DEPTH = 64;
/** Size of synthetic small capitals, as a share of the font size. */
const SMALL_CAPS = 0.7;

/** Places text in the letters of a font. */
export class TextPlacer {
  constructor(readonly font: TextFont) {}

  place(file: SvgFile, geometry: SvgGeometry, element: number, context: Context): PlacedText {
    const { font } = this;
    const paths = new SvgTextPaths(file, geometry);
    const gatherer = new Gatherer(file, paths, context, font.hasSmallCaps ?? false);
    gatherer.gather(element);
    const chars = collapseBlanks(gatherer.chars);
    gatherer.assignPositions(chars);
    const { x, y } = chars[0] ?? {};
    const { unsupported, effects } = gatherer;
    return { ...layOutText(chars, font), unsupported, effects, x: x ?? 0, y: y ?? 0 };
  }
}

/** Null if text is not drawn. */
export function textPlacerOf(options: ImportOptions): TextPlacer | null {
  const font = fontOf(options);
  return font === null ? null : new TextPlacer(font);
}

class Gatherer {
  readonly chars: Char[] = [];
  readonly unsupported: string[] = [];
  readonly effects: Effects[number][] = [];
  /** Elements that may have positions, and the characters inside each. */
  private readonly spans: { element: number; style: Style; chars: Char[] }[] = [];
  private readonly smallCaps = new Map<Style, Style>();

  constructor(
    private readonly file: SvgFile,
    private readonly paths: SvgTextPaths,
    private readonly context: Context,
    private readonly fontHasSmallCaps: boolean,
  ) {}

  gather(root: number): void {
    const { style: around } = this.context;
    const style = { ...around, text: withoutShift(around.text) };
    const keepsBlanks = this.keepsBlanksAround(root);
    this.gatherChildren(root, { style, open: [], path: null, keepsBlanks, stretch: null });
  }

  /** `outside` has the element's own style and path already. */
  private gatherChildren(element: number, outside: Inside): void {
    const { tree } = this.file;
    const { style } = outside;
    const space = attribute(tree, element, "xml:space");
    const inside = {
      ...outside,
      open: [...outside.open, this.spans.length],
      keepsBlanks:
        style.text.keepsBlanks ?? (space === undefined ? outside.keepsBlanks : space === "preserve"),
      stretch: this.stretchOf(element, style) ?? outside.stretch,
    };
    this.spans.push({ element, style, chars: [] });
    for (const child of childrenOf(tree, element)) this.gatherNode(child, inside);
  }

  private gatherNode(node: number, inside: Inside): void {
    const { tree } = this.file;
    const tag = tagOf(tree, node);
    if (tag === TEXT_NODE) {
      if (STACKED_ACCENTS.test(textOf(tree, node)))
        this.effects.push(["text-style-ignored", "exact places of stacked accents"]);
      this.addText(textOf(tree, node), inside);
      return;
    }
    const path = tag === "textPath" ? this.paths.of(node, this.context) : inside.path;
    // A textPath is allowed only in a text or a link.
    const isMisplaced = tag === "textPath" && !["text", "a"].includes(tagOf(tree, tree.parents[node]));
    if (tag === "tref" || isMisplaced || (tag === "textPath" && path === null)) {
      this.unsupported.push(tag);
      return;
    }
    if (!["tspan", "a", "textPath"].includes(tag) || !this.file.meetsConditions(node)) return;
    const declared = this.file.cascade.declaredOf(node);
    const style = this.styleInside(inside.style, declared);
    // No real file nests spans deeper than this: deeper ones are not laid out.
    if (declaredValue(style, declared, "display") === "none" || inside.open.length >= MAX_DEPTH) return;
    this.effects.push(...effectsOf(style, declared, this.file.parseColor));
    const clip = declaredValue(style, declared, "clip-path") ?? "none";
    if (attribute(tree, node, "side")?.trim() === "right")
      this.effects.push(["text-style-ignored", "textPath side"]);
    if (clip !== "none") this.effects.push(["clip-ignored", `${clip.slice(0, 40)} on ${tag}`]);
    this.gatherChildren(node, { ...inside, style, path });
  }

  /** The style of an element that declares `declared` inside an element with `style`. */
  private styleInside(style: Style, declared: Declared): Style {
    const passedOn = withoutAlignment(style.text);
    const parent = passedOn === style.text ? style : { ...style, text: passedOn };
    const own = this.file.computeStyle(parent, declared, this.basisOf(style));
    const { isVertical } = this.context.style.text;
    // The writing mode is that of the whole text.
    return own.text.isVertical === isVertical ? own : { ...own, text: { ...own.text, isVertical } };
  }

  private basisOf({ fontSize }: Style): LengthBasis {
    return { ...this.context.basis, fontSize };
  }

  private keepsBlanksAround(root: number): boolean {
    for (let at = this.file.tree.parents[root]; at >= 0; at = this.file.tree.parents[at]) {
      const space = attribute(this.file.tree, at, "xml:space");
      if (space !== undefined) return space === "preserve";
    }
    return false;
  }

  /** The `textLength` of the characters in an element. */
  private stretchOf(element: number, style: Style): Stretch | null {
    const text = attribute(this.file.tree, element, "textLength");
    const length = text === undefined ? null : lengthPx(text, this.basisOf(style), "width");
    if (length === null || length <= 0) return null;
    return { length, ofGlyphs: attribute(this.file.tree, element, "lengthAdjust") === "spacingAndGlyphs" };
  }

  private addText(text: string, { open, ...common }: Inside): void {
    for (const written of transformed(text, common.style.text.transform)) {
      if (this.chars.length >= MAX_CHARS) return;
      const isSmall =
        !this.fontHasSmallCaps && common.style.text.isSmallCaps && written !== written.toUpperCase();
      const style = isSmall ? this.smallCapsOf(common.style) : common.style;
      const char = isSmall ? written.toUpperCase() : written;
      const entry: Char = { ...common, text: char, style, x: null, y: null, dx: 0, dy: 0, angle: null };
      this.chars.push(entry);
      for (const span of open) this.spans[span].chars.push(entry);
    }
  }

  private smallCapsOf(style: Style): Style {
    return getOrAdd(this.smallCaps, style, () => ({ ...style, fontSize: SMALL_CAPS * style.fontSize }));
  }

  /**
   * Assigns the n-th number of each list to the n-th remaining character of its element; inner elements
   * override outer ones.
   */
  assignPositions(kept: readonly Char[]): void {
    const isKept = new Set(kept);
    for (const { element, style, chars } of this.spans) {
      // Its letters are placed along the path.
      if (tagOf(this.file.tree, element) === "textPath") continue;
      const left = chars.filter((char) => isKept.has(char));
      const basis = this.basisOf(style);
      const list = (name: string, side: Side): (number | null)[] =>
        listIn(attribute(this.file.tree, element, name) ?? "").map((part) => lengthPx(part, basis, side));
      list("x", "width").forEach((x, i) => i < left.length && x !== null && (left[i].x = x));
      list("y", "height").forEach((y, i) => i < left.length && y !== null && (left[i].y = y));
      list("dx", "width").forEach((dx, i) => i < left.length && (left[i].dx = dx ?? 0));
      list("dy", "height").forEach((dy, i) => i < left.length && (left[i].dy = dy ?? 0));
      const angles = listIn(attribute(this.file.tree, element, "rotate") ?? "").map(Number);
      // The last angle applies to all following characters.
      if (angles.length > 0 && !angles.some(Number.isNaN)) {
        left.forEach((char, i) => (char.angle = angles[Math.min(i, angles.length - 1)] * RAD_PER_DEG));
      }
    }
  }
}

function transformed(text: string, how: string): string {
  if (how === "uppercase") return text.toUpperCase();
  if (how === "lowercase") return text.toLowerCase();
  return how === "capitalize"
    ? text.replace(/(?<![\p{L}\p{N}])\p{L}/gu, (letter) => letter.toUpperCase())
    : text;
}

/**
 * Line breaks and tabs count as blanks. Unless blanks are preserved, runs of them become one, and those at
 * both ends are removed.
 */
function collapseBlanks(chars: readonly Char[]): Char[] {
  const kept: Char[] = [];
  for (const char of chars) {
    const isBlank = /[ \t\r\n]/.test(char.text);
    if (isBlank) char.text = " ";
    if (isBlank && !char.keepsBlanks && (kept.length === 0 || kept[kept.length - 1].text === " ")) continue;
    kept.push(char);
  }
  const last = kept.at(-1);
  if (last?.text === " " && !last.keepsBlanks) kept.pop();
  return kept;
}
