/**
 * Finds the winning declaration of each property on an element (CSS Cascade 4, §6): presentation attributes,
 * then rules by specificity and order, then the style attribute, then !important rules, then the !important
 * style attribute.
 */
import { attributeValue, type SvgTree } from "../svg-tree.js";
import type { Declaration } from "./css-rules.js";
import type { CssStyles } from "./css-styles.js";
import { IS_KEYWORD, type Declared, PRESENTATION, NOT_DRAWN_PROPERTIES, IS_PROPERTY } from "./properties.js";

const MARKERS = ["marker-start", "marker-mid", "marker-end"] as const;
const IS_PRESENTATION = new Set<string>([...PRESENTATION, ...NOT_DRAWN_PROPERTIES.keys()]);
const IS_COLLECTED = new Set<string>([...IS_PROPERTY, ...NOT_DRAWN_PROPERTIES.keys()]);

export class Cascade {
  constructor(
    private readonly tree: SvgTree,
    /** Null if the file has no styles. */
    private readonly styles: CssStyles | null,
  ) {}

  /** The winning values of `element`. */
  declaredOf(element: number): Declared {
    const values = new Map<string, string>();
    const { tree } = this;
    let style: string | undefined;
    let id: string | undefined;
    let classes: string | undefined;
    const end = tree.attributeOffsets[element + 1];
    for (let i = tree.attributeOffsets[element]; i < end; i++) {
      const name = tree.names[tree.attributeNames[i]];
      if (IS_PRESENTATION.has(name)) values.set(name, valueFor(name, attributeValue(tree, i)));
      else if (name === "style") style = attributeValue(tree, i);
      else if (name === "id") id = attributeValue(tree, i);
      else if (name === "class") classes = attributeValue(tree, i);
    }
    if (this.styles === null) return values;
    const rules = this.styles.match(element, id, classes);
    const inline = style === undefined ? [] : this.styles.inline(style);
    for (const rule of rules) apply(rule.declarations, false, values);
    apply(inline, false, values);
    for (const rule of rules) apply(rule.declarations, true, values);
    apply(inline, true, values);
    return values;
  }
}

function apply(declarations: readonly Declaration[], important: boolean, into: Map<string, string>): void {
  for (const { property, value, important: isImportant } of declarations) {
    if (isImportant !== important) continue;
    if (property === "marker") for (const part of MARKERS) into.set(part, value);
    else if (IS_COLLECTED.has(property) || property.startsWith("--"))
      into.set(property, valueFor(property, value));
  }
}

/** Keywords are case-insensitive. */
const valueFor = (property: string, value: string): string =>
  IS_KEYWORD.has(property) ? value.toLowerCase() : value;
