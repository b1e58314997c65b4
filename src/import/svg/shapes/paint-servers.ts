/** The single colour that replaces a gradient or pattern. */
import type { Context } from "../svg-context.js";
import type { SvgFile } from "../svg-file.js";
import { attribute, childrenOf, HREF, tagOf } from "../svg-tree.js";
import { declaredValue, INITIAL_STYLE } from "../css/style.js";

const SERVERS = new Set(["linearGradient", "radialGradient", "pattern"]);
const MAX_HREF_STEPS = 32;

export class SvgPaintServers {
  private readonly serverColors = new Map<string, string | null | undefined>();

  constructor(private readonly file: SvgFile) {}

  /** The colour that replaces a paint server; null if it paints nothing, undefined if it does not exist. */
  serverColor(id: string, context: Context): string | null | undefined {
    if (!this.serverColors.has(id)) this.serverColors.set(id, this.findServerColor(id, context));
    return this.serverColors.get(id);
  }

  isPattern(id: string): boolean {
    const element = this.file.tree.elementById.get(id);
    return element !== undefined && tagOf(this.file.tree, element) === "pattern";
  }

  /** The first stop's colour. Gradients may share stops, so their hrefs are followed. */
  private findServerColor(id: string, context: Context): string | null | undefined {
    const { tree } = this.file;
    let element = tree.elementById.get(id);
    if (element === undefined || !SERVERS.has(tagOf(tree, element))) return undefined;
    if (tagOf(tree, element) === "pattern") return this.patternColor(element);
    for (let step = 0; step < MAX_HREF_STEPS && element !== undefined; step++) {
      for (const child of childrenOf(tree, element)) {
        if (tagOf(tree, child) === "stop") return this.stopColor(child, context);
      }
      const href = attribute(tree, element, HREF) ?? "";
      const next = tree.elementById.get(href.slice(1));
      element = next !== undefined && SERVERS.has(tagOf(tree, next)) ? next : undefined;
    }
    // A gradient without stops paints nothing.
    return null;
  }

  /** Whether its units refer to the shape's box: then it paints nothing on a shape without width or height. */
  isOfBox(id: string): boolean {
    const { tree } = this.file;
    const element = tree.elementById.get(id);
    if (element === undefined) return false;
    const name = tagOf(tree, element) === "pattern" ? "patternUnits" : "gradientUnits";
    return attribute(tree, element, name) !== "userSpaceOnUse";
  }

  /** Patterns are not drawn: black replaces them, unless they are empty. */
  private patternColor(pattern: number): string | undefined {
    const { tree } = this.file;
    const inherited = (has: (element: number) => boolean): boolean => {
      let element: number | undefined = pattern;
      for (let step = 0; step < MAX_HREF_STEPS && element !== undefined; step++) {
        if (has(element)) return true;
        element = tree.elementById.get((attribute(tree, element, HREF) ?? "").slice(1));
      }
      return false;
    };
    const isSized = ["width", "height"].every((side) =>
      inherited((element) => parseFloat(attribute(tree, element, side) ?? "") > 0),
    );
    return isSized && inherited((element) => tree.firstChildren[element] >= 0)
      ? INITIAL_STYLE.color.hex
      : undefined;
  }

  private stopColor(stop: number, context: Context): string {
    const text = declaredValue(context.style, this.file.cascade.declaredOf(stop), "stop-color");
    if (text === undefined) return INITIAL_STYLE.color.hex;
    if (text.toLowerCase() === "currentcolor") return context.style.color.hex;
    return (this.file.parseColor(text) ?? INITIAL_STYLE.color).hex;
  }
}

/** Somewhere between light and dark. */
const GRADIENT_GREY = "#808080";

/** Inside a mask, where a gradient shows with less contrast whatever its first colour is. */
export class MaskPaintServers extends SvgPaintServers {
  override serverColor(id: string, context: Context): string | null | undefined {
    const color = super.serverColor(id, context);
    return typeof color === "string" && !this.isPattern(id) ? GRADIENT_GREY : color;
  }
}
