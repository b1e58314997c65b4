/**
 * Knows a shape that says of itself what the one before it said, its outline apart: its style, its place in the tree and
 * what follows from them are the same then and need not be found again. Large files are made of such runs.
 *
 * Compared is where values stand: `PlainLeaves` gives one that is written again the place where it was written first.
 */
import type { Cascade } from "./cascade.js";
import type { Declared } from "./declared.js";
import type { Look } from "./drawing-builder.js";
import type { Paint } from "./style.js";
import type { Context } from "./svg-context.js";
import { attribute, type SvgTree } from "./svg-tree.js";

/** What may differ: where a shape is, and what it is called. */
const OUTLINE = new Set([
  "id",
  "d",
  "points",
  "x",
  "y",
  "width",
  "height",
  "cx",
  "cy",
  "r",
  "rx",
  "ry",
  "x1",
  "y1",
  "x2",
  "y2",
]);

/** How a shape was drawn. */
export interface Drawn {
  readonly element: number;
  /** What it inherits. */
  readonly outer: Context;
  readonly tag: string;
  readonly context: Context;
  readonly look: Look;
}

/** A shape that others may be like. */
export interface Model extends Drawn {
  /** Of a path: which of its attributes is the path data, if nothing else says what is drawn; else −1. */
  readonly pathAt: number;
}

export class AlikeShapes {
  /** The shape that the next may be like; null for none. */
  model: Model | null = null;
  /** By name number: whether the attribute may differ. */
  private readonly isOutline: Uint8Array;

  constructor(
    private readonly tree: SvgTree,
    private readonly cascade: Cascade,
  ) {
    this.isOutline = Uint8Array.from(tree.names, (name) => (OUTLINE.has(name) ? 1 : 0));
  }

  /** Makes it the model, if others that say the same are drawn in the same way, and without a warning. */
  offer(drawn: Drawn, declared: Declared): void {
    const { style, uses } = drawn.context;
    const isModel =
      uses === null &&
      this.cascade.goesByAttributes &&
      isPlain(style.stroke) &&
      isPlain(style.fill) &&
      declared.get("transform") === undefined &&
      declared.get("clip-path") === undefined &&
      attribute(this.tree, drawn.element, "pathLength") === undefined;
    if (isModel) this.model = { ...drawn, pathAt: this.pathAt(drawn, declared) };
  }

  private pathAt({ element, tag }: Drawn, declared: Declared): number {
    if (tag !== "path" || declared.get("d") !== undefined) return -1;
    const { attributeOffsets, attributeNames, names } = this.tree;
    const from = attributeOffsets[element];
    for (let i = from; i < attributeOffsets[element + 1]; i++) {
      if (names[attributeNames[i]] === "d") return i - from;
    }
    return -1;
  }

  /** The model, if `element` is like it; else null. */
  modelOf(element: number, outer: Context): Model | null {
    const { model, tree, isOutline } = this;
    if (model === null || model.outer !== outer) return null;
    const { attributeOffsets, attributeNames, values } = tree;
    const other = model.element;
    if (tree.tags[element] !== tree.tags[other] || tree.parents[element] !== tree.parents[other]) return null;
    const end = attributeOffsets[element + 1];
    const ahead = attributeOffsets[element] - attributeOffsets[other];
    if (end - ahead !== attributeOffsets[other + 1]) return null;
    for (let i = attributeOffsets[element]; i < end; i++) {
      const name = attributeNames[i];
      if (name !== attributeNames[i - ahead]) return null;
      if (isOutline[name] === 0 && values.places[i] !== values.places[i - ahead]) return null;
    }
    return model;
  }
}

/** Of a colour alone: servers warn where they are used, and what `context` means is not the shape's own. */
const isPlain = ({ kind }: Paint): boolean => kind === "none" || kind === "color" || kind === "currentColor";
