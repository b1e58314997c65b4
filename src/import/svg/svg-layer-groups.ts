/** The drawing's group for each element: its layer, or one that shapes outside every layer share. */
import type { DrawingBuilder } from "../drawing-builder.js";
import type { Warnings } from "../warnings.js";
import type { Context } from "./svg-context.js";
import type { SvgFile } from "./svg-file.js";
import { isMarkedLayer, layerName } from "./svg-layers.js";
import { attribute } from "./svg-tree.js";

export class LayerGroups {
  /** The group for shapes outside every layer; −1 until needed. */
  private looseGroup = -1;
  private readonly unseen: number[] = [];

  constructor(
    private readonly file: SvgFile,
    private readonly builder: DrawingBuilder,
    private readonly warnings: Warnings,
  ) {}

  /** The group of an element inside `outer`; adds it if the element is a layer. */
  groupOf(element: number, tag: string, outer: Context): number {
    const { builder } = this;
    const { tree, layers } = this.file;
    if (outer.uses !== null) return outer.group;
    if (tree.parents[element] !== layers.parent) {
      const isSublayer = tag === "g" && outer.group >= 0 && layers.isSplit && isMarkedLayer(tree, element);
      if (!isSublayer) return outer.group;
      const id = attribute(tree, element, "id") ?? `sublayer-${builder.groups.length}`;
      return builder.addGroup(id, layerName(tree, element) ?? id, false, outer.group);
    }
    const isLayer = tag === "g" && layers.isSplit && (!layers.onlyMarked || isMarkedLayer(tree, element));
    const number = builder.groups.filter(({ parent }) => parent === undefined).length + 1;
    if (isLayer) {
      const name = layerName(tree, element) ?? `Layer ${number}`;
      return builder.addGroup(attribute(tree, element, "id") ?? `layer-${number}`, name, false);
    }
    if (this.looseGroup < 0) this.looseGroup = builder.addGroup(`layer-${number}`, `Layer ${number}`, false);
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
