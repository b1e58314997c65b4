/** What elements refer to: clip regions, and the colour that stands for a gradient or pattern. */
import { RULE_NONZERO, VERB_CLOSE, VERB_LINE, VERB_MOVE } from "../drawing/drawing.js";
import { applyX, applyY } from "../geometry/affine.js";
import { boxOfPoints, type Box } from "../geometry/box.js";
import { Cascade, type Declared } from "./cascade.js";
import { ClipNode } from "./clip-node.js";
import { parseColor } from "./color.js";
import type { Context } from "./svg-context.js";
import { attribute, HREF, tagOf, type SvgTree } from "./svg-tree.js";
import { declaredValue, INITIAL_STYLE } from "./style.js";

const SERVERS = new Set(["linearGradient", "radialGradient", "pattern", "meshgradient", "hatch"]);
const RECTANGLE_VERBS = Uint8Array.of(VERB_MOVE, VERB_LINE, VERB_LINE, VERB_LINE, VERB_CLOSE);
const MAX_HREF_STEPS = 32;

export class SvgDefinitions {
  private readonly serverColors = new Map<string, string | null | undefined>();

  constructor(
    private readonly tree: SvgTree,
    private readonly cascade: Cascade,
  ) {}

  /** The clip of an element inside `context`; "empty" where it hides everything. */
  clipOf(_element: number, _value: string | undefined, context: Context): ClipNode | null | "empty" {
    return context.clip;
  }

  /** A clip to a rectangle in user units: the edge of a viewport. */
  rectangleClip(context: Context, x: number, y: number, width: number, height: number): ClipNode {
    const { map } = context;
    const coords = new Float64Array(8);
    const corners = [x, y, x + width, y, x + width, y + height, x, y + height];
    for (let i = 0; i < 8; i += 2) {
      coords[i] = applyX(map, corners[i], corners[i + 1]);
      coords[i + 1] = applyY(map, corners[i], corners[i + 1]);
    }
    const isAlongAxes = (map.b === 0 && map.c === 0) || (map.a === 0 && map.d === 0);
    const rectangle: Box | null = isAlongAxes ? boxOfPoints(coords) : null;
    const shapes = {
      verbs: RECTANGLE_VERBS,
      coords,
      rule: Uint8Array.of(RULE_NONZERO),
      shape: Uint32Array.of(0),
    };
    return new ClipNode(context.clip, shapes, rectangle);
  }

  /** The colour that stands for a paint server; null for an invisible one, undefined where there is none. */
  serverColor(id: string, context: Context): string | null | undefined {
    if (!this.serverColors.has(id)) this.serverColors.set(id, this.findServerColor(id, context));
    return this.serverColors.get(id);
  }

  /** The first stop's colour, found through the chain of hrefs that gradients may share stops by. */
  private findServerColor(id: string, context: Context): string | null | undefined {
    const { tree } = this;
    let element = tree.elementById.get(id);
    if (element === undefined || !SERVERS.has(tagOf(tree, element))) return undefined;
    for (let step = 0; step < MAX_HREF_STEPS && element !== undefined; step++) {
      for (let child = tree.firstChildren[element]; child >= 0; child = tree.nextSiblings[child]) {
        if (tagOf(tree, child) === "stop") return this.stopColor(child, context);
      }
      const href = attribute(tree, element, HREF) ?? "";
      element = tree.elementById.get(href.slice(1));
    }
    return INITIAL_STYLE.color.hex;
  }

  private stopColor(stop: number, context: Context): string {
    const declared: Declared = new Map();
    this.cascade.collect(stop, declared);
    const text = declaredValue(context.style, declared, "stop-color");
    if (text === undefined) return INITIAL_STYLE.color.hex;
    if (text.toLowerCase() === "currentcolor") return context.style.color.hex;
    return (parseColor(text) ?? INITIAL_STYLE.color).hex;
  }
}
