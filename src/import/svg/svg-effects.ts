/** Effects that a browser draws and a pen cannot: each gives a warning. */
import type { Box } from "../../geometry/box.js";
import type { ColorParser } from "../color.js";
import { isFontLength } from "./css/length.js";
import { NOT_DRAWN_PROPERTIES, type Declared, type Property } from "./css/properties.js";
import { declaredValue, isUnknownPaint, parseOpacity, parseUrl, type Style } from "./css/style.js";
import { tagOf, type SvgTree } from "./svg-tree.js";
import type { WarningCode, Warnings } from "../warnings.js";

/** Effects of one element: codes, and details for the message. */
export type Effects = readonly (readonly [code: WarningCode, detail?: string])[];

const WHITE = "#ffffff";

/** Values of NOT_DRAWN_PROPERTIES that change nothing, so that they need no warning. */
const DRAWS_AS_USUAL =
  /^\s*(none|normal|auto|initial|inherit|unset|revert|solid|mixed|[01](px|%)?|100%)?\s*$/;

/** Values of font-weight below the usual one. */
const LIGHT = /^(lighter|[123]00)$/;

/** The effects of the element to which `declared` belongs. */
export function effectsOf(style: Style, declared: Declared, parseColor: ColorParser): Effects {
  const valueOf = (property: Property): string | null => {
    const value = declaredValue(style, declared, property);
    return value === undefined || value === "none" || value === "normal" ? null : value;
  };
  const effects: [WarningCode, string?][] = [];
  for (const [name, text] of declared) {
    const code = NOT_DRAWN_PROPERTIES.get(name);
    if (code !== undefined && !DRAWS_AS_USUAL.test(text)) effects.push([code, name]);
    if (isFontLength(text)) effects.push(["length-approximate", text.trim()]);
  }
  for (const property of ["fill", "stroke"] as const) {
    const value = valueOf(property);
    if (value !== null && isUnknownPaint(value, parseColor))
      effects.push(["color-unknown", value.slice(0, 40)]);
  }
  if (LIGHT.test(valueOf("font-weight") ?? "")) effects.push(["text-style-ignored", "light"]);
  if (valueOf("mask") !== null) effects.push(["mask-ignored"]);
  if (valueOf("filter") !== null) effects.push(["filter-ignored"]);
  const blend = valueOf("mix-blend-mode");
  if (blend !== null) effects.push(["blend-ignored", blend.slice(0, 40)]);
  const order = valueOf("paint-order");
  const opacity = parseOpacity(valueOf("opacity") ?? "1") ?? 1;
  if (opacity > 0 && opacity < 1) effects.push(["opacity-ignored"]);
  if (order !== null && /^(stroke|markers)/.test(order))
    effects.push(["paint-order-ignored", order.slice(0, 40)]);
  return effects;
}

/** The root element's background. White, like most paper, needs no warning. */
export function backgroundOf(style: Style, declared: Declared, parseColor: ColorParser): Effects {
  return (["background", "background-color"] as const).flatMap((name): [WarningCode, string][] => {
    const value = declaredValue(style, declared, name) ?? "none";
    const color = parseColor(value);
    const isPainted = color === null ? value.includes("url(") : color.alpha > 0 && color.hex !== WHITE;
    return isPainted ? [["effect-ignored", name]] : [];
  });
}

/** Whether a mask or filter without content hides the element completely, as in browsers. */
export function isErased(tree: SvgTree, style: Style, declared: Declared): boolean {
  return (["mask", "filter"] as const).some((name) => {
    const id = parseUrl(declaredValue(style, declared, name) ?? "");
    const target = id === null ? undefined : tree.elementById.get(id);
    return target !== undefined && tagOf(tree, target) === name && tree.firstChildren[target] < 0;
  });
}

export function warnOf(effects: Effects, box: Box, warnings: Warnings): void {
  for (const [code, detail] of effects) warnings.add(code, box, detail);
}

/** For what has no letters: browsers show nothing of such a style there. */
export const withoutTextStyles = (effects: Effects): Effects =>
  effects.filter(([code]) => code !== "text-style-ignored");
