/**
 * The styles of a file: which rules of its style sheets match an element, and what its style attribute declares.
 * Imported only for files that have styles, because the two CSS packages are large.
 *
 * Rules are indexed by the id, class or type of their rightmost part, so an element is tested only against
 * rules that may match. css-select decides for selectors with more parts.
 */
import { compile } from "css-select";
import { getOrAdd } from "../../../get-or-add.js";
import { attribute, childrenOf, tagOf, TEXT_NODE, textOf, type SvgTree } from "../svg-tree.js";
import { parseInlineStyle, parseStyleSheet, type Rule } from "./css-rules.js";

/**
 * Max nodes that one selector may visit in the whole file, and all selectors together: `:has` in `:has`, or a chain of
 * `~`, visits the siblings of siblings again and again. A usual selector visits a few nodes for each element.
 */
const MAX_VISITS = 5_000_000;
const MAX_VISITS_PER_ELEMENT = 40;
const MAX_TOTAL_VISITS = 400_000_000;

interface FiledRule extends Rule {
  readonly order: number;
  readonly matches: (element: ElementRef) => boolean;
  visitsLeft: number;
}

/** Thrown while a selector is tested, to leave css-select. */
class TooManyVisits extends Error {}

/** A node for css-select, created only for elements that a longer selector is tested on. */
interface ElementRef {
  readonly index: number;
}

export class CssStyles {
  /** The declarations of a style attribute. */
  readonly inline = parseInlineStyle;
  readonly importCount: number;
  readonly faults: readonly string[];
  /** Selectors that need too much time: from some element on they match nothing. */
  readonly slowSelectors = new Set<string>();
  private totalVisitsLeft = MAX_TOTAL_VISITS;
  /** For the test that is running. */
  private visitsLeft = 0;
  private readonly byId = new Map<string, FiledRule[]>();
  private readonly byClass = new Map<string, FiledRule[]>();
  private readonly byType = new Map<string, FiledRule[]>();
  private readonly forAll: FiledRule[] = [];
  private readonly refs = new Map<number, ElementRef>();
  private readonly positions = new Map<number, number>();
  private readonly childLists = new Map<number, ElementRef[]>();

  constructor(private readonly tree: SvgTree) {
    const faults: string[] = [];
    let importCount = 0;
    let order = 0;
    for (const text of styleTexts(tree)) {
      const sheet = parseStyleSheet(text);
      importCount += sheet.importCount;
      faults.push(...sheet.faults);
      for (const rule of sheet.rules) this.file(rule, order++, faults);
    }
    this.importCount = importCount;
    this.faults = faults;
  }

  /** Matching rules, weakest first. */
  match(element: number, id: string | undefined, classes: string | undefined): FiledRule[] {
    const { forAll, byType, byId, byClass } = this;
    const filed = [forAll, byType.get(tagOf(this.tree, element))];
    if (id !== undefined) filed.push(byId.get(id));
    if (classes !== undefined) {
      for (const name of new Set(classes.split(/\s+/))) filed.push(byClass.get(name));
    }
    return filed
      .flatMap((rules = []) => rules)
      .filter((rule) => rule.isKeyAlone || this.isMatch(rule, element))
      .sort((a, b) => a.specificity - b.specificity || a.order - b.order);
  }

  private isMatch(rule: FiledRule, element: number): boolean {
    const allowed = Math.min(rule.visitsLeft, this.totalVisitsLeft);
    if (allowed <= 0) {
      this.slowSelectors.add(rule.selector);
      return false;
    }
    // Each test counts too, since there may be many rules.
    this.visitsLeft = allowed - 1;
    try {
      return rule.matches(this.ref(element));
    } catch (error) {
      if (!(error instanceof TooManyVisits)) throw error;
      this.slowSelectors.add(rule.selector);
      return false;
    } finally {
      rule.visitsLeft -= allowed - this.visitsLeft;
      this.totalVisitsLeft -= allowed - this.visitsLeft;
    }
  }

  private file(rule: Rule, order: number, faults: string[]): void {
    let matches = (_element: ElementRef): boolean => true;
    if (!rule.isKeyAlone) {
      try {
        matches = compile<ElementRef, ElementRef>(rule.selector, {
          adapter: this.adapter,
          pseudos: this.pseudos,
          xmlMode: true,
          cacheResults: false,
        });
      } catch (error) {
        faults.push(`the selector "${rule.selector.slice(0, 80)}" (${(error as Error).message})`);
        return;
      }
    }
    const visitsLeft = Math.max(MAX_VISITS, MAX_VISITS_PER_ELEMENT * this.tree.count);
    const filed = { ...rule, order, matches, visitsLeft };
    const { kind, name } = rule.key;
    if (kind === "any") this.forAll.push(filed);
    else {
      const map = kind === "id" ? this.byId : kind === "class" ? this.byClass : this.byType;
      getOrAdd(map, name, () => []).push(filed);
    }
  }

  private ref(index: number): ElementRef {
    return getOrAdd(this.refs, index, () => ({ index }));
  }

  private children(parent: number): ElementRef[] {
    const { tree } = this;
    return getOrAdd(this.childLists, parent, () => {
      const elements = [...childrenOf(tree, parent)].filter((child) => tagOf(tree, child) !== TEXT_NODE);
      elements.forEach((child, place) => this.positions.set(child, place));
      return elements.map((child) => this.ref(child));
    });
  }

  /**
   * Index among the siblings, and how many follow. Stored, not counted, since there may be many thousands of
   * siblings.
   */
  private place(node: ElementRef): { readonly before: number; readonly after: number } {
    const siblings = this.adapter.getSiblings(node);
    const before = this.positions.get(node.index) ?? 0;
    return { before, after: siblings.length - 1 - before };
  }

  private readonly pseudos = {
    "first-child": (node: ElementRef): boolean => this.place(node).before === 0,
    "last-child": (node: ElementRef): boolean => this.place(node).after === 0,
    "nth-child": (node: ElementRef, formula?: string | null): boolean =>
      isNth(formula ?? "", this.place(node).before + 1),
    "nth-last-child": (node: ElementRef, formula?: string | null): boolean =>
      isNth(formula ?? "", this.place(node).after + 1),
  };

  private readonly adapter = {
    // css-select asks this about each node that it visits.
    isTag: (_node: ElementRef): _node is ElementRef => {
      if (--this.visitsLeft < 0) throw new TooManyVisits();
      return true;
    },
    getAttributeValue: (node: ElementRef, name: string): string | undefined =>
      attribute(this.tree, node.index, name),
    hasAttrib: (node: ElementRef, name: string): boolean =>
      attribute(this.tree, node.index, name) !== undefined,
    getName: (node: ElementRef): string => tagOf(this.tree, node.index),
    getText: (): string => "",
    getParent: (node: ElementRef): ElementRef | null => {
      const parent = this.tree.parents[node.index];
      return parent < 0 ? null : this.ref(parent);
    },
    getChildren: (node: ElementRef): ElementRef[] => this.children(node.index),
    getSiblings: (node: ElementRef): ElementRef[] => {
      const parent = this.tree.parents[node.index];
      return parent < 0 ? [node] : this.children(parent);
    },
    prevElementSibling: (node: ElementRef): ElementRef | null => {
      const { before } = this.place(node);
      return before === 0 ? null : this.adapter.getSiblings(node)[before - 1];
    },
    removeSubsets: (nodes: ElementRef[]): ElementRef[] => nodes,
  };
}

/** Whether n ≥ 1 matches a k + b, k ≥ 0, of a formula like "2n+1", "odd" or "3" (Selectors 4, §6.6.5). */
function isNth(formula: string, n: number): boolean {
  const text = formula.replace(/\s+/g, "").toLowerCase();
  const match = /^([+-]?\d*)n([+-]\d+)?$/.exec(text === "odd" ? "2n+1" : text === "even" ? "2n" : text);
  if (match === null) return Number(text) === n;
  const step = match[1] === "" || match[1] === "+" ? 1 : match[1] === "-" ? -1 : Number(match[1]);
  const rest = n - Number(match[2] ?? 0);
  return step === 0 ? rest === 0 : rest % step === 0 && rest / step >= 0;
}

function* styleTexts(tree: SvgTree): Generator<string> {
  for (let element = 0; element < tree.count; element++) {
    if (tagOf(tree, element) !== "style") continue;
    const type = attribute(tree, element, "type") ?? "";
    if (type !== "" && type.toLowerCase() !== "text/css") continue;
    yield Array.from(childrenOf(tree, element), (child) => textOf(tree, child)).join("");
  }
}
