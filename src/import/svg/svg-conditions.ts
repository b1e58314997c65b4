/**
 * Conditional processing: `requiredExtensions` and `systemLanguage`, on `switch` children and all other
 * elements.
 */
import { attribute, type SvgTree } from "./svg-tree.js";

export class SvgConditions {
  /** @param languages the user's languages, in lower case */
  constructor(
    private readonly tree: SvgTree,
    private readonly languages: readonly string[],
  ) {}

  areMet(element: number): boolean {
    const extensions = attribute(this.tree, element, "requiredExtensions");
    // No extension is supported; an empty list is not met either (SVG 2, §5.8.4).
    if (extensions !== undefined) return false;
    const language = attribute(this.tree, element, "systemLanguage");
    if (language === undefined) return true;
    const wanted = language.split(",").map((part) => part.trim().toLowerCase());
    return this.languages.some((own) => wanted.some((tag) => tag === own || tag.startsWith(`${own}-`)));
  }
}
