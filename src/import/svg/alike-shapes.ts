/**
 * Knows a shape that says of itself what the one before it said, its outline apart: its style, its place in the tree and
 * what follows from them are the same then and need not be found again. Large files are made of such runs.
 *
 * Compared is where values stand: `PlainLeaves` gives one that is written again the place where it was written first.
 */
import type { Cascade } from "./cascade.js";
import type { Declared } from "./declared.js";
import type { Look } from "../drawing-builder.js";
import { OUTLINE_ATTRIBUTES } from "./outline-attributes.js";
import type { Paint } from "./style.js";
import type { Context } from "./svg-context.js";
import { attribute, OWN_STRING, type SvgTree } from "./svg-tree.js";

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
    this.isOutline = Uint8Array.from(tree.names, (name) => (OUTLINE_ATTRIBUTES.has(name) ? 1 : 0));
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
    const { model } = this;
    return model !== null && model.outer === outer && this.isLike(element, model.element) ? model : null;
  }

  /**
   * How many paths from `element` on, which is like the model, one right after the other, are like it too, and drawn without
   * clip. Where their data stands in the text is written into `places`. No more than `most` are looked at.
   */
  pathsLike(model: Model, element: number, places: Uint32Array, most: number): number {
    const { tree } = this;
    if (model.pathAt < 0 || model.context.clip !== null) return 0;
    const { attributeOffsets, nextSiblings, values } = tree;
    let count = 0;
    for (let e = element; count < most && (e === element || this.isLike(e, model.element)); e++) {
      const place = values.places[attributeOffsets[e] + model.pathAt];
      if (place >= OWN_STRING) break;
      places[count++] = place;
      if (nextSiblings[e] !== e + 1) break;
    }
    return count;
  }

  private isLike(element: number, other: number): boolean {
    const { tree, isOutline } = this;
    const { attributeOffsets, attributeNames, values } = tree;
    if (tree.tags[element] !== tree.tags[other] || tree.parents[element] !== tree.parents[other])
      return false;
    const end = attributeOffsets[element + 1];
    const ahead = attributeOffsets[element] - attributeOffsets[other];
    if (end - ahead !== attributeOffsets[other + 1]) return false;
    for (let i = attributeOffsets[element]; i < end; i++) {
      const name = attributeNames[i];
      if (name !== attributeNames[i - ahead]) return false;
      if (isOutline[name] === 0 && values.places[i] !== values.places[i - ahead]) return false;
    }
    return true;
  }
}

/** Of a colour alone: servers warn where they are used, and what `context` means is not the shape's own. */
const isPlain = ({ kind }: Paint): boolean => kind === "none" || kind === "color" || kind === "currentColor";
