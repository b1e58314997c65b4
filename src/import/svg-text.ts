/**
 * SVG text to places of letters (SVG 2, chapter 11, for horizontal text).
 *
 * The text's characters are gathered with the style and the x, y, dx, dy, rotate that fall on each;
 * every absolute x or y begins a chunk, which is laid out along the line and then anchored.
 */
import type { Cascade } from "./cascade.js";
import { Declared } from "./declared.js";
import { lengthPx, type LengthBasis, type Side } from "./length.js";
import { attributeValue, attribute, tagOf, TEXT_NODE, type SvgTree } from "./svg-tree.js";
import { computeStyle, declaredValue, type Style } from "./style.js";
import type { TextFont } from "./text-font.js";

/** One letter: its path in em, put at x, y in user units and turned. */
export interface PlacedLetter {
  readonly path: string;
  readonly x: number;
  readonly y: number;
  /** rad */
  readonly angle: number;
  readonly style: Style;
}

export interface PlacedText {
  readonly letters: readonly PlacedLetter[];
  readonly missing: readonly string[];
  /** textPath and other kinds that are not laid out. */
  readonly unsupported: readonly string[];
  /** Where the text begins, in user units. */
  readonly x: number;
  readonly y: number;
}

interface Char {
  text: string;
  readonly style: Style;
  x: number | null;
  y: number | null;
  dx: number;
  dy: number;
  angle: number | null;
}

const MAX_CHARS = 100_000;
const RAD_PER_DEG = Math.PI / 180;

export function placeText(
  tree: SvgTree,
  cascade: Cascade,
  element: number,
  style: Style,
  basis: LengthBasis,
  font: TextFont,
): PlacedText {
  const gatherer = new Gatherer(tree, cascade, basis);
  gatherer.gather(element, style);
  const chars = collapseBlanks(gatherer.chars, attribute(tree, element, "xml:space") === "preserve");
  gatherer.assignPositions(chars);
  return { ...layOutChunks(chars, font), unsupported: gatherer.unsupported };
}

class Gatherer {
  readonly chars: Char[] = [];
  readonly unsupported: string[] = [];
  /** Elements with positions, and which characters lie in them: [first, last). */
  private readonly spans: { element: number; style: Style; from: Char | null; chars: Char[] }[] = [];
  private readonly declared = new Declared();

  constructor(
    private readonly tree: SvgTree,
    private readonly cascade: Cascade,
    private readonly basis: LengthBasis,
  ) {}

  gather(root: number, rootStyle: Style): void {
    const { tree } = this;
    const stack: { node: number; style: Style; open: number[] }[] = [];
    const pushChildren = (element: number, style: Style, open: number[]): void => {
      this.spans.push({ element, style, from: null, chars: [] });
      const within = [...open, this.spans.length - 1];
      const children: number[] = [];
      for (let child = tree.firstChildren[element]; child >= 0; child = tree.nextSiblings[child])
        children.push(child);
      for (const node of children.reverse()) stack.push({ node, style, open: within });
    };
    pushChildren(root, rootStyle, []);
    while (stack.length > 0) {
      const { node, style, open } = stack.pop()!;
      const tag = tagOf(tree, node);
      if (tag === TEXT_NODE) this.addText(attributeValue(tree, tree.attributeOffsets[node]), style, open);
      else if (tag === "tspan" || tag === "a") {
        this.cascade.collect(node, this.declared);
        const own = computeStyle(style, this.declared, { ...this.basis, fontSize: style.fontSize });
        // Deep nesting of spans has no use; what is that deep is not laid out.
        if (declaredValue(own, this.declared, "display") !== "none" && open.length < 64)
          pushChildren(node, own, open);
      } else if (tag === "textPath" || tag === "tref") this.unsupported.push(tag);
    }
  }

  private addText(text: string, style: Style, open: readonly number[]): void {
    for (const char of text) {
      if (this.chars.length >= MAX_CHARS) return;
      const entry: Char = { text: char, style, x: null, y: null, dx: 0, dy: 0, angle: null };
      this.chars.push(entry);
      for (const span of open) this.spans[span].chars.push(entry);
    }
  }

  /** Gives the n-th number of each list to the n-th character left in its element; inner elements win. */
  assignPositions(kept: readonly Char[]): void {
    const isKept = new Set(kept);
    for (const { element, style, chars } of this.spans) {
      const left = chars.filter((char) => isKept.has(char));
      const basis = { ...this.basis, fontSize: style.fontSize };
      const list = (name: string, side: Side): (number | null)[] =>
        (attribute(this.tree, element, name) ?? "")
          .split(/[\s,]+/)
          .filter((part) => part !== "")
          .map((part) => lengthPx(part, basis, side));
      list("x", "width").forEach((x, i) => i < left.length && x !== null && (left[i].x = x));
      list("y", "height").forEach((y, i) => i < left.length && y !== null && (left[i].y = y));
      list("dx", "width").forEach((dx, i) => i < left.length && (left[i].dx = dx ?? 0));
      list("dy", "height").forEach((dy, i) => i < left.length && (left[i].dy = dy ?? 0));
      const angles = list("rotate", "both");
      // The last angle holds for all that follow.
      if (angles.length > 0) {
        left.forEach((char, i) => (char.angle = (angles[Math.min(i, angles.length - 1)] ?? 0) * RAD_PER_DEG));
      }
    }
  }
}

/** Line breaks and tabs are blanks; runs of blanks are one; none at the ends. */
function collapseBlanks(chars: readonly Char[], isPreserved: boolean): Char[] {
  const kept: Char[] = [];
  for (const char of chars) {
    const isBlank = /[ \t\r\n]/.test(char.text);
    if (isBlank) char.text = " ";
    if (isBlank && !isPreserved && (kept.length === 0 || kept[kept.length - 1].text === " ")) continue;
    kept.push(char);
  }
  if (!isPreserved && kept.length > 0 && kept[kept.length - 1].text === " ") kept.pop();
  return kept;
}

function layOutChunks(chars: readonly Char[], font: TextFont): Omit<PlacedText, "unsupported"> {
  const letters: PlacedLetter[] = [];
  const missing: string[] = [];
  let x = 0;
  let y = 0;
  let at = 0;
  while (at < chars.length) {
    let end = at + 1;
    while (end < chars.length && chars[end].x === null && chars[end].y === null) end++;
    x = chars[at].x ?? x;
    y = chars[at].y ?? y;
    const startX = x;
    const chunk: PlacedLetter[] = [];
    for (const run of runsOf(chars.slice(at, end))) {
      const { style, angle, dx, dy } = run[0];
      x += dx;
      y += dy;
      const laid = font.layout(run.map((char) => char.text).join(""), { family: style.fontFamily });
      missing.push(...laid.missing);
      for (const glyph of laid.glyphs) {
        const size = style.fontSize;
        if (glyph.path !== "") {
          chunk.push({
            path: glyph.path,
            x: x + glyph.x * size,
            y: y + glyph.y * size,
            angle: angle ?? 0,
            style,
          });
        }
        x += glyph.advance * size + style.letterSpacing;
      }
    }
    const anchor = { start: 0, middle: 0.5, end: 1 }[chars[at].style.textAnchor];
    const shift = -(x - startX) * anchor;
    for (const letter of chunk) letters.push(shift === 0 ? letter : { ...letter, x: letter.x + shift });
    x += shift;
    at = end;
  }
  const first = chars[0];
  return { letters, missing, x: first?.x ?? 0, y: first?.y ?? 0 };
}

/** Stretches of one style without shifts inside, so that a font may join and kern within them. */
function runsOf(chars: readonly Char[]): Char[][] {
  const runs: Char[][] = [];
  for (const char of chars) {
    const run = runs[runs.length - 1];
    const goesOn =
      run !== undefined &&
      run[0].style === char.style &&
      run[0].angle === char.angle &&
      char.dx === 0 &&
      char.dy === 0 &&
      (char.angle === null || char.angle === 0);
    if (goesOn) run.push(char);
    else runs.push([char]);
  }
  return runs;
}
