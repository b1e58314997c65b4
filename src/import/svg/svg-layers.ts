/**
 * Finds the groups that are the file's layers, and their names.
 *
 * Layers are the top-level groups. A single wrapper around them (group, switch, link or nested svg) is
 * skipped, since many programs and scripts wrap everything once.
 */
import { attribute, childrenOf, tagOf, TEXT_NODE, type SvgTree } from "./svg-tree.js";

/** More top-level groups than this are data, not layers: some charts have one per point. */
const MAX_LAYERS = 200;

/** Max depth of wrappers, more than any program writes. */
const MAX_WRAPPERS = 32;

/** Elements that draw nothing by themselves. */
const NOT_CONTENT = new Set([
  TEXT_NODE,
  "defs",
  "style",
  "title",
  "desc",
  "metadata",
  "symbol",
  "clipPath",
  "mask",
  "marker",
  "pattern",
  "linearGradient",
  "radialGradient",
  "filter",
  "view",
  "script",
  "WCB",
  "plotdata",
  "eggbot",
  "MergeData",
  "namedview",
]);
const WRAPPERS = new Set(["g", "switch", "a", "svg"]);

export interface LayerPlan {
  /** The element whose children are layers. */
  readonly parent: number;
  /** Whether its child groups are separate layers; if not, everything is one layer. */
  readonly isSplit: boolean;
  /** The file has Inkscape layers: other groups beside them are not layers. */
  readonly onlyMarked: boolean;
  readonly groupCount: number;
}

export function planLayers(tree: SvgTree): LayerPlan {
  let parent = 0;
  for (let depth = 0; depth < MAX_WRAPPERS; depth++) {
    const wrapper = wrapperIn(tree, parent);
    if (wrapper < 0) break;
    const isWrapped = isMarkedLayer(tree, wrapper)
      ? groupsIn(tree, wrapper).some((element) => isMarkedLayer(tree, element))
      : leadsToGroups(tree, wrapper);
    if (!isWrapped) break;
    parent = wrapper;
  }
  const groups = groupsIn(tree, parent);
  const marked = groups.filter((element) => isMarkedLayer(tree, element));
  const layers = marked.length > 0 ? marked : groups;
  return {
    parent,
    isSplit: layers.length <= MAX_LAYERS,
    onlyMarked: marked.length > 0,
    groupCount: layers.length,
  };
}

/** Whether a wrapper contains groups, possibly inside further single wrappers. */
function leadsToGroups(tree: SvgTree, element: number): boolean {
  for (let at = element; ;) {
    const wrapper = tagOf(tree, at) === "g" ? -1 : wrapperIn(tree, at);
    if (wrapper < 0) return groupsIn(tree, at).length > 0;
    if (tagOf(tree, wrapper) === "g") return true;
    at = wrapper;
  }
}

/** The only child with content, if it may be a wrapper; otherwise −1. */
function wrapperIn(tree: SvgTree, parent: number): number {
  const content = [...childrenOf(tree, parent)].filter((child) => !NOT_CONTENT.has(tagOf(tree, child)));
  return content.length === 1 && WRAPPERS.has(tagOf(tree, content[0])) ? content[0] : -1;
}

const groupsIn = (tree: SvgTree, parent: number): number[] =>
  [...childrenOf(tree, parent)].filter((child) => tagOf(tree, child) === "g");

export const isMarkedLayer = (tree: SvgTree, element: number): boolean =>
  attribute(tree, element, "inkscape:groupmode") === "layer";

/** Where programs keep a layer's name as it was typed: Inkscape, Affinity, Illustrator. */
const NAMES = ["inkscape:label", "serif:id", "data-name"];

/** The name as it was typed, or the id; null if it has none. */
export function layerName(tree: SvgTree, element: number): string | null {
  for (const name of NAMES) {
    const typed = attribute(tree, element, name)?.trim() ?? "";
    if (typed !== "") return typed;
  }
  const id = attribute(tree, element, "id");
  return id === undefined || id.trim() === "" ? null : decodeId(id.trim());
}

/** Illustrator writes characters that are not allowed in an id as _xHEX_: "Layer_x5F_1", "_x31_0". */
const decodeId = (id: string): string =>
  id.replace(/_x([0-9A-Fa-f]{2,5})_/g, (whole, hex: string) => {
    const code = parseInt(hex, 16);
    return code >= 0x20 && code <= 0x10ffff && !(code >= 0xd800 && code <= 0xdfff)
      ? String.fromCodePoint(code)
      : whole;
  });
