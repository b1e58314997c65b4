// Ambient declarations apply only where a program includes them, and this project has several programs.
// eslint-disable-next-line @typescript-eslint/triple-slash-reference
/// <reference path="../../../packages.d.ts" />
/** Style sheets and `style` attributes to rules and declarations (parsing only; cascade.ts applies them). */
import { remembered } from "../../../get-or-add.js";
import { IS_PROPERTY } from "./properties.js";
import parseCss from "css-tree/parser";
import type { CssNode, List, Selector } from "css-tree";

export interface Declaration {
  readonly property: string;
  readonly value: string;
  readonly important: boolean;
}

export interface Rule {
  /** The text of one selector of the list. */
  readonly selector: string;
  /** ids × 2^20 + classes × 2^10 + types, so that one comparison orders them. */
  readonly specificity: number;
  /** The id, class or type of the rightmost compound selector: an element must have it to match. */
  readonly key: { readonly kind: "id" | "class" | "type" | "any"; readonly name: string };
  /** Whether `key` is the whole selector, so that nothing else needs testing. */
  readonly isKeyAlone: boolean;
  readonly declarations: readonly Declaration[];
}

interface StyleSheet {
  readonly rules: readonly Rule[];
  readonly importCount: number;
  /** Parse errors, in the parser's words. */
  readonly faults: readonly string[];
}

/** Deeper nesting would exhaust the parser's stack, and does not occur in real files. */
const MAX_NESTING = 200;

/** `svg|rect` and `*|rect` select elements of a namespace; here there is only one. */
const NAMESPACE = /(?<![\w"'\]])(?:\*|[A-Za-z][\w-]*)\|(?=[A-Za-z*])/g;

export function parseStyleSheet(sheetText: string): StyleSheet {
  const text = sheetText.replace(NAMESPACE, "");
  const rules: Rule[] = [];
  const faults: string[] = [];
  let importCount = 0;
  if (nestingDepth(text) > MAX_NESTING) return { rules, importCount, faults: ["it is nested too deeply"] };
  const sheet = parseCss(text, {
    positions: true,
    parseValue: false,
    parseCustomProperty: false,
    onParseError: (error) => faults.push(error.message),
  });
  const pending: CssNode[] = sheet.type === "StyleSheet" ? sheet.children.toArray() : [];
  for (let i = 0; i < pending.length; i++) {
    const node = pending[i];
    if (node.type === "Rule") addRule(rules, text, node.prelude, node.block.children);
    if (node.type !== "Atrule") continue;
    if (node.name === "import") importCount++;
    const applies =
      node.name === "layer" ||
      (node.name === "media" && isForScreen(text, node.prelude)) ||
      (node.name === "supports" && isSupported(sourceOf(text, node.prelude)));
    // Insert them in place of the at-rule, to preserve the order.
    if (applies && node.block !== null) pending.splice(i + 1, 0, ...node.block.children.toArray());
  }
  return { rules, importCount, faults };
}

function nestingDepth(text: string): number {
  let depth = 0;
  let deepest = 0;
  for (let i = 0; i < text.length; i++) {
    const c = text.charCodeAt(i);
    if (c === 40 || c === 91 || c === 123) deepest = Math.max(deepest, ++depth);
    else if (c === 41 || c === 93 || c === 125) depth = Math.max(0, depth - 1);
  }
  return deepest;
}

/**
 * Media conditions that are true on a wide screen with light colours: a drawing has no dark mode and no
 * window width.
 */
const TRUE_CONDITION =
  /^\(\s*(min-(width|height|resolution)\s*:[^()]*|prefers-color-scheme\s*:\s*light)\s*\)$/;

function holdsOnScreen(query: string): boolean {
  const [first, ...others] = query.trim().split(/\s+and\s+/);
  return (
    (/^(only\s+)?(all|screen)$/.test(first) || TRUE_CONDITION.test(first)) &&
    others.every((part) => TRUE_CONDITION.test(part))
  );
}

function isForScreen(text: string, prelude: CssNode | null): boolean {
  const query = sourceOf(text, prelude).trim().toLowerCase();
  return query === "" || query.split(",").some(holdsOnScreen);
}

/** Whether an `@supports` condition is true: "not" and "and" are evaluated, and one true part of an "or" is enough. */
function isSupported(condition: string): boolean {
  const parts = [...condition.matchAll(/(not\s*)?\(\s*([\w-]+)\s*:[^()]*(?:\([^()]*\)[^()]*)*\)/g)];
  const holds = parts.map(
    ([, not, property]) => IS_PROPERTY.has(property.toLowerCase()) === (not === undefined),
  );
  return / or /.test(condition) ? holds.includes(true) : holds.length > 0 && !holds.includes(false);
}

function sourceOf(text: string, node: CssNode | null): string {
  const loc = node?.loc;
  return loc ? text.slice(loc.start.offset, loc.end.offset) : "";
}

function addRule(rules: Rule[], text: string, prelude: CssNode, block: List<CssNode>): void {
  if (prelude.type !== "SelectorList") return;
  const declarations: Declaration[] = [];
  block.forEach((node) => {
    if (node.type === "Declaration") {
      const value = node.value.type === "Raw" ? node.value.value : sourceOf(text, node.value);
      declarations.push(declare(node.property, value, node.important !== false));
    }
  });
  if (declarations.length === 0) return;
  prelude.children.forEach((selector) => {
    if (selector.type !== "Selector") return;
    const { key, isKeyAlone } = keyOf(selector);
    rules.push({
      selector: sourceOf(text, selector),
      specificity: specificityOf(selector),
      key,
      isKeyAlone,
      declarations,
    });
  });
}

const withoutComments = (text: string): string => text.replace(/\/\*[\s\S]*?(\*\/|$)/g, " ");

function declare(property: string, value: string, important: boolean): Declaration {
  const name = property.startsWith("--") ? property : property.toLowerCase();
  return { property: name, value: withoutComments(value).trim(), important };
}

/** Selectors Level 4, §17: ids, then classes, attributes and pseudo-classes, then types. */
function specificityOf(selector: Selector): number {
  let total = 0;
  selector.children.forEach((node) => {
    total += specificityOfPart(node);
  });
  return total;
}

function specificityOfPart(node: CssNode): number {
  switch (node.type) {
    case "IdSelector":
      return 1 << 20;
    case "ClassSelector":
    case "AttributeSelector":
      return 1 << 10;
    case "TypeSelector":
      return node.name === "*" || node.name.endsWith("|*") ? 0 : 1;
    case "PseudoElementSelector":
      return 1;
    case "PseudoClassSelector":
      if (node.name === "where") return 0;
      if (["not", "is", "has", "matches"].includes(node.name)) return mostSpecific(node.children);
      return 1 << 10;
    default:
      return 0;
  }
}

function mostSpecific(children: List<CssNode> | null): number {
  let max = 0;
  children?.forEach((list) => {
    if (list.type !== "SelectorList") return;
    list.children.forEach((selector) => {
      if (selector.type === "Selector") max = Math.max(max, specificityOf(selector));
    });
  });
  return max;
}

function keyOf(selector: Selector): Pick<Rule, "key" | "isKeyAlone"> {
  const parts = selector.children.toArray();
  let key: Rule["key"] = { kind: "any", name: "" };
  const rank = { any: 0, type: 1, class: 2, id: 3 };
  for (let i = parts.length - 1; i >= 0 && parts[i].type !== "Combinator"; i--) {
    const found = keyOfPart(parts[i]);
    if (rank[found.kind] > rank[key.kind]) key = found;
  }
  const isPlain = parts.length === 1 && (key.kind !== "any" || isStar(parts[0]));
  return { key, isKeyAlone: isPlain };
}

const isStar = (node: CssNode): boolean => node.type === "TypeSelector" && node.name === "*";

function keyOfPart(node: CssNode): Rule["key"] {
  if (node.type === "IdSelector") return { kind: "id", name: node.name };
  if (node.type === "ClassSelector") return { kind: "class", name: node.name };
  if (node.type === "TypeSelector" && node.name !== "*" && !node.name.includes("|")) {
    return { kind: "type", name: node.name };
  }
  return { kind: "any", name: "" };
}

const STYLE_CACHE_LIMIT = 2048;

/** The declarations of a `style` attribute, in order. */
export const parseInlineStyle = remembered(STYLE_CACHE_LIMIT, (text): readonly Declaration[] => {
  const declarations: Declaration[] = [];
  if (nestingDepth(text) > MAX_NESTING) return declarations;
  const list = parseCss(text, {
    context: "declarationList",
    parseValue: false,
    parseCustomProperty: false,
    onParseError: () => undefined,
  });
  if (list.type !== "DeclarationList") return declarations;
  list.children.forEach((node) => {
    if (node.type !== "Declaration" || node.value.type !== "Raw" || node.value.value.trim() === "") return;
    declarations.push(declare(node.property, node.value.value, node.important !== false));
  });
  return declarations;
});
