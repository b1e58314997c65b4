/**
 * SVG text to places of letters (SVG 2, chapter 11, for horizontal text): the characters are gathered with the
 * style, the path and the x, y, dx, dy, rotate that fall on each, and then laid out.
 */
import type { Cascade } from "./cascade.js";
import { Declared } from "./declared.js";
import { lengthPx, type LengthBasis, type Side } from "./length.js";
import { attribute, tagOf, textOf, TEXT_NODE, type SvgTree } from "./svg-tree.js";
import { computeStyle, declaredValue, type Style } from "./style.js";
import type { Context } from "./svg-context.js";
import { layOutText, type Char, type LaidOutText } from "./svg-text-layout.js";
import type { SvgTextPaths, TextPath } from "./svg-text-path.js";
import type { TextFont } from "../text/text-font.js";

export interface PlacedText extends LaidOutText {
  /** What is not laid out: a textPath without a path, and other kinds. */
  readonly unsupported: readonly string[];
  /** Where the text begins, in user units. */
  readonly x: number;
  readonly y: number;
}

const MAX_CHARS = 100_000;
const RAD_PER_DEG = Math.PI / 180;

export function placeText(
  tree: SvgTree,
  cascade: Cascade,
  paths: SvgTextPaths,
  element: number,
  context: Context,
  font: TextFont,
): PlacedText {
  const gatherer = new Gatherer(tree, cascade, paths, context);
  gatherer.gather(element);
  const chars = collapseBlanks(gatherer.chars, attribute(tree, element, "xml:space") === "preserve");
  gatherer.assignPositions(chars);
  const { x, y } = chars[0] ?? {};
  return { ...layOutText(chars, font), unsupported: gatherer.unsupported, x: x ?? 0, y: y ?? 0 };
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
    private readonly paths: SvgTextPaths,
    private readonly context: Context,
  ) {}

  gather(root: number): void {
    const { tree } = this;
    const stack: { node: number; style: Style; open: number[]; path: TextPath | null }[] = [];
    const pushChildren = (element: number, style: Style, open: number[], path: TextPath | null): void => {
      this.spans.push({ element, style, from: null, chars: [] });
      const within = [...open, this.spans.length - 1];
      const children: number[] = [];
      for (let child = tree.firstChildren[element]; child >= 0; child = tree.nextSiblings[child])
        children.push(child);
      for (const node of children.reverse()) stack.push({ node, style, open: within, path });
    };
    pushChildren(root, this.context.style, [], null);
    while (stack.length > 0) {
      const { node, style, open, path } = stack.pop()!;
      const tag = tagOf(tree, node);
      if (tag === TEXT_NODE) {
        this.addText(textOf(tree, node), style, path, open);
        continue;
      }
      const onPath = tag === "textPath" ? this.paths.of(node, this.context) : path;
      if (tag === "tref" || (tag === "textPath" && onPath === null)) this.unsupported.push(tag);
      else if (tag === "tspan" || tag === "a" || tag === "textPath") {
        this.cascade.collect(node, this.declared);
        const own = computeStyle(style, this.declared, this.basisOf(style));
        // Deep nesting of spans has no use; what is that deep is not laid out.
        if (declaredValue(own, this.declared, "display") !== "none" && open.length < 64)
          pushChildren(node, own, open, onPath);
      }
    }
  }

  private basisOf({ fontSize }: Style): LengthBasis {
    return { ...this.context.basis, fontSize };
  }

  private addText(text: string, style: Style, path: TextPath | null, open: readonly number[]): void {
    for (const char of text) {
      if (this.chars.length >= MAX_CHARS) return;
      const entry: Char = { text: char, style, path, x: null, y: null, dx: 0, dy: 0, angle: null };
      this.chars.push(entry);
      for (const span of open) this.spans[span].chars.push(entry);
    }
  }

  /** Gives the n-th number of each list to the n-th character left in its element; inner elements win. */
  assignPositions(kept: readonly Char[]): void {
    const isKept = new Set(kept);
    for (const { element, style, chars } of this.spans) {
      const left = chars.filter((char) => isKept.has(char));
      const basis = this.basisOf(style);
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
