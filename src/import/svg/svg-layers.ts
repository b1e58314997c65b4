/**
 * Finds the groups that are the file's layers, and their names; adds them to the drawing.
 *
 * Layers are the top-level groups. A single wrapper around them (group, switch, link or nested svg) is
 * skipped, since many programs and scripts wrap everything once.
 */
import { attribute, isOtherProgramsData, tagOf, TEXT_NODE, type SvgTree, childrenOf } from "./svg-tree.js";
import type { DrawingBuilder } from "../drawing-builder.js";
import type { Warnings } from "../warnings.js";
import type { Context } from "./svg-context.js";

/**
 * More top-level groups than this are data, not layers: some charts have one per point. Groups that the file itself calls
 * layers may be more.
 */
const MAX_LAYERS = 200;
const MAX_MARKED_LAYERS = 2_000;

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
    isSplit: layers.length <= (marked.length > 0 ? MAX_MARKED_LAYERS : MAX_LAYERS),
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
  const content = [...childrenOf(tree, parent)].filter((child) => {
    const tag = tagOf(tree, child);
    return !NOT_CONTENT.has(tag) && !isOtherProgramsData(tag);
  });
  return content.length === 1 && WRAPPERS.has(tagOf(tree, content[0])) ? content[0] : -1;
}

const groupsIn = (tree: SvgTree, parent: number): number[] =>
  [...childrenOf(tree, parent)].filter((child) => tagOf(tree, child) === "g");

const isMarkedLayer = (tree: SvgTree, element: number): boolean =>
  attribute(tree, element, "inkscape:groupmode") === "layer";

/** Where programs keep a layer's name as it was typed: Inkscape, Affinity, Illustrator. */
const NAMES = ["inkscape:label", "serif:id", "data-name"];

/** The name as it was typed, or the id; null if it has none. */
function layerName(tree: SvgTree, element: number): string | null {
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

/** The drawing's group for each element: its layer, or one that shapes outside every layer share. */
export class LayerGroups {
  /** The group for shapes outside every layer; −1 until needed. */
  private looseGroup = -1;
  /** Of the top-level groups. */
  private count = 0;
  private readonly unseen: number[] = [];

  constructor(
    private readonly tree: SvgTree,
    private readonly layers: LayerPlan,
    private readonly builder: DrawingBuilder,
    private readonly warnings: Warnings,
  ) {}

  /** The group of an element inside `outer`; adds it if the element is a layer. */
  groupOf(element: number, tag: string, outer: Context): number {
    const { builder, tree, layers } = this;
    if (outer.uses !== null) return outer.group;
    if (tree.parents[element] !== layers.parent) {
      const isSublayer = tag === "g" && outer.group >= 0 && layers.isSplit && isMarkedLayer(tree, element);
      if (!isSublayer) return outer.group;
      const id = attribute(tree, element, "id") ?? `sublayer-${builder.groups.length}`;
      return builder.addGroup(id, layerName(tree, element) ?? id, false, outer.group);
    }
    const isLayer = tag === "g" && layers.isSplit && (!layers.onlyMarked || isMarkedLayer(tree, element));
    if (!isLayer && this.looseGroup >= 0) return this.looseGroup;
    const number = ++this.count;
    if (isLayer) {
      const name = layerName(tree, element) ?? `Layer ${number}`;
      return builder.addGroup(attribute(tree, element, "id") ?? `layer-${number}`, name, false);
    }
    this.looseGroup = builder.addGroup(`layer-${number}`, `Layer ${number}`, false);
    return this.looseGroup;
  }

  hide(group: number): void {
    const { groups } = this.builder;
    groups[group] = { ...groups[group], hidden: true };
    this.warnOfHidden(group);
  }

  /** The layer's `visibility` is hidden, but elements inside may be visible. */
  hideUnlessDrawn(group: number): void {
    this.unseen.push(group);
  }

  /** Call when everything is drawn. */
  finish(): void {
    for (const group of this.unseen) if (!this.builder.hasShapes(group)) this.warnOfHidden(group);
  }

  private warnOfHidden(group: number): void {
    this.warnings.add("hidden-layer", undefined, this.builder.groups[group].name);
  }
}
