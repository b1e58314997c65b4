/** A parsed SVG file, shared by all steps of its import. */
import type { TextFont } from "../text/text-font.js";
import { Cascade } from "./css/cascade.js";
import type { LengthBasis } from "./css/length.js";
import { computeStyle, INITIAL_STYLE, type Style } from "./css/style.js";
import { planLayers, type LayerPlan } from "./svg-layers.js";
import { attribute, type SvgTree } from "./svg-tree.js";

export class SvgFile {
  readonly cascade: Cascade;
  readonly layers: LayerPlan;
  /** Styles of elements whose children were looked up. */
  private readonly styles = new Map<number, Style>();

  constructor(
    readonly tree: SvgTree,
    /** The font for text; null if text is only reported. */
    readonly font: TextFont | null,
    /** The user's languages, in lower case. */
    private readonly languages: readonly string[],
  ) {
    this.cascade = new Cascade(tree);
    this.layers = planLayers(tree);
  }

  /** Conditional processing: `requiredExtensions` and `systemLanguage`, on `switch` children and all other elements. */
  meetsConditions(element: number): boolean {
    const extensions = attribute(this.tree, element, "requiredExtensions");
    // No extension is supported; an empty list is not met either (SVG 2, §5.8.4).
    if (extensions !== undefined) return false;
    const language = attribute(this.tree, element, "systemLanguage");
    if (language === undefined) return true;
    const wanted = language.split(",").map((part) => part.trim().toLowerCase());
    return this.languages.some((own) => wanted.some((tag) => tag === own || tag.startsWith(`${own}-`)));
  }

  /**
   * The style that an element inherits from its ancestors in the file. Markers and clip paths inherit from
   * there, not from the shape that refers to them (SVG 2, §13.7).
   *
   * @param basis for lengths in %, since viewports in between are ignored
   */
  styleAround(element: number, basis: LengthBasis): Style {
    const { parents } = this.tree;
    const path: number[] = [];
    let at = parents[element];
    for (; at >= 0 && !this.styles.has(at); at = parents[at]) path.push(at);
    let style = this.styles.get(at) ?? INITIAL_STYLE;
    for (const ancestor of path.reverse()) {
      style = computeStyle(style, this.cascade.declaredOf(ancestor), { ...basis, fontSize: style.fontSize });
      this.styles.set(ancestor, style);
    }
    return style;
  }
}
