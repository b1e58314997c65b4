/** A parsed SVG file, shared by all steps of its import. */
import type { ColorParser } from "../color.js";
import { Cascade } from "./css/cascade.js";
import type { CssStyles } from "./css/css-styles.js";
import type { LengthBasis } from "./css/length.js";
import { computeStyle, INITIAL_STYLE, type Style } from "./css/style.js";
import { planLayers, type LayerPlan } from "./svg-layers.js";
import { attribute, type SvgTree } from "./svg-tree.js";
import type { Declared } from "./css/properties.js";

export class SvgFile {
  readonly cascade: Cascade;
  readonly layers: LayerPlan;
  /** Styles of elements whose children were looked up. */
  private readonly innerStyles = new Map<number, Style>();

  constructor(
    readonly tree: SvgTree,
    /** Null if the file has none. */
    readonly styles: CssStyles | null,
    readonly parseColor: ColorParser,
    /** The user's languages, in lower case. */
    private readonly languages: readonly string[],
  ) {
    this.cascade = new Cascade(tree, styles);
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

  /** The style of an element that declares `declared` below `parent`; `parent` itself if nothing changes. */
  computeStyle(parent: Style, declared: Declared, basis: LengthBasis): Style {
    return computeStyle(parent, declared, basis, this.parseColor);
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
    for (; at >= 0 && !this.innerStyles.has(at); at = parents[at]) path.push(at);
    let style = this.innerStyles.get(at) ?? INITIAL_STYLE;
    for (const ancestor of path.reverse()) {
      style = this.computeStyle(style, this.cascade.declaredOf(ancestor), {
        ...basis,
        fontSize: style.fontSize,
      });
      this.innerStyles.set(ancestor, style);
    }
    return style;
  }
}
