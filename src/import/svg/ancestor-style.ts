/**
 * The style that an element inherits from its ancestors in the file. Markers and clip paths inherit from
 * there, not from the shape that refers to them (SVG 2, §13.7).
 */
import type { Cascade } from "./cascade.js";
import type { LengthBasis } from "./length.js";
import { computeStyle, INITIAL_STYLE, type Style } from "./style.js";
import type { SvgTree } from "./svg-tree.js";

export class AncestorStyles {
  /** Styles of elements whose children were looked up. */
  private readonly known = new Map<number, Style>();

  constructor(
    private readonly tree: SvgTree,
    private readonly cascade: Cascade,
  ) {}

  /** @param basis for lengths in %, since viewports in between are ignored */
  outside(element: number, basis: LengthBasis): Style {
    const path: number[] = [];
    let at = this.tree.parents[element];
    for (; at >= 0 && !this.known.has(at); at = this.tree.parents[at]) path.push(at);
    let style = this.known.get(at) ?? INITIAL_STYLE;
    for (const ancestor of path.reverse()) {
      style = computeStyle(style, this.cascade.declaredOf(ancestor), { ...basis, fontSize: style.fontSize });
      this.known.set(ancestor, style);
    }
    return style;
  }
}
