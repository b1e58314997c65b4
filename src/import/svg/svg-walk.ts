/**
 * Walks the tree: every rendered element in paint order, each with its inherited context.
 *
 * An explicit stack of frames is used, so that depth costs memory and never the call stack. `use` is followed
 * as a frame with one child. The chain of enclosing targets stops cycles, and a limit on visits stops copies
 * of copies from growing without end.
 */
import { isSpeedFactor } from "../../drawing/drawing.js";
import { PlotwrightError } from "../../errors.js";
import { compose, determinant, IDENTITY, translation, type Affine } from "../../geometry/affine.js";
import type { Box } from "../../geometry/box.js";
import { SHAPE_TAGS, type SvgGeometry } from "./shapes/basic-shapes.js";
import { isSameDeclared, type Declared } from "./css/properties.js";
import { elementTransform } from "./css/transform.js";
import { lengthPx, type Side } from "./css/length.js";
import {
  isInsideUseOf,
  MAX_COPY_DEPTH,
  withStyle,
  type Context,
  isMarked,
  contextPaints,
} from "./svg-context.js";
import { effectsOf, isErased, warnOf, withoutTextStyles, type Effects, backgroundOf } from "./svg-effects.js";
import type { SvgFile } from "./svg-file.js";
import type { ClipNode } from "../clip-node.js";
import type { DrawApart, MaskClip } from "./masks/masks.js";
import type { Referenced } from "./referenced.js";
import type { ElementBoxes } from "./element-boxes.js";
import { LayerGroups } from "./svg-layers.js";
import type { SvgPainter } from "./svg-painter.js";
import type { TextPainter } from "./text/text-painter.js";
import {
  attribute,
  HREF,
  isOtherProgramsData,
  tagOf,
  TEXT_NODE,
  type SvgTree,
  childrenOf,
} from "./svg-tree.js";
import { declaredValue, parseOpacity, type Style } from "./css/style.js";
import { withoutAlignment, withoutShift } from "./css/text-style.js";
import { viewportInside } from "./svg-viewport.js";
import { Warnings } from "../warnings.js";
import { DrawingBuilder } from "../drawing-builder.js";

/**
 * Max elements visited through `use`, and max coordinates that they may add: anything beyond is an attack or
 * a mistake.
 */
const MAX_COPIED_ELEMENTS = 500_000;
const MAX_COPIED_COORDS = 50_000_000;

/** How fast an element is drawn, as a share of the usual speed; what is inside it inherits that. */
const SPEED_ATTRIBUTE = "data-plotwright-speed";

const CONTAINERS = new Set(["g", "a", "svg", "switch", "use", "symbol"]);
/**
 * Elements that draw nothing at their place in the file. All others that are not drawn are reported, except other
 * programs' data.
 */
const INVISIBLE = new Set(
  `clipPath color-profile cursor defs desc discard filter font font-face hatch linearGradient marker mask
   meshgradient metadata mpath pattern radialGradient script solidcolor solidColor stop style symbol title view`.split(
    /\s+/,
  ),
);
/** Not drawn either, but a `switch` may choose them. */
const EMBEDDED = new Set(["image", "video", "audio", "canvas", "iframe"]);
const ANIMATIONS = new Set(["animate", "animateTransform", "animateMotion", "animateColor", "set"]);

interface Frame {
  readonly context: Context;
  next: number;
  /** Visit only `next`, not its siblings. */
  readonly isSingle: boolean;
  /** Effects that are missing from everything drawn inside: reported when the frame ends. */
  readonly effects: Effects;
  readonly firstShape: number;
  readonly firstText: number;
}

export class SvgWalk {
  /** The last computed context, and what it was computed from. */
  private last: { readonly outer: Context; readonly declared: Declared; readonly inner: Context } | null =
    null;
  private readonly stack: Frame[] = [];
  private copiedElements = 0;
  private copiedCoords = 0;
  /** The texts drawn so far. */
  private textCount = 0;
  private readonly layerGroups: LayerGroups;
  private subtreeEnds: Uint32Array | null = null;

  constructor(
    private readonly file: SvgFile,
    private readonly svgGeometry: SvgGeometry,
    private readonly boxes: ElementBoxes,
    /** Null: no shape of the file refers to any. */
    private readonly referenced: Referenced | null,
    private readonly painter: SvgPainter,
    /** Null: the file has no text. */
    private readonly texts: TextPainter | null,
    private readonly builder: DrawingBuilder,
    private readonly warnings: Warnings,
  ) {
    this.layerGroups = new LayerGroups(file.tree, file.layers, builder, warnings);
  }

  /** Draws everything below the root. */
  run(rootContext: Context): void {
    this.enterRoot(rootContext);
    while (this.step());
    this.layerGroups.finish();
  }

  /** Visits the next element; false at the end. */
  private step(): boolean {
    const { stack } = this;
    const { tree } = this.file;
    const frame = stack.at(-1);
    if (frame === undefined) return false;
    const element = frame.next;
    if (element < 0) {
      stack.pop();
      this.leave(frame);
      return true;
    }
    frame.next = frame.isSingle ? -1 : tree.nextSiblings[element];
    this.visit(element, frame.context);
    this.builder.progress = element / tree.count;
    return true;
  }

  /** Draws the content of `element` into a separate drawing, whose warnings include its errors and effects. */
  private readonly drawApart: DrawApart = (element, context, work) => {
    const { file, svgGeometry, boxes, referenced } = this;
    const warnings = new Warnings();
    const builder = new DrawingBuilder(warnings);
    const painter = this.painter.forMask(builder, warnings);
    const texts = this.texts?.forMask(painter) ?? null;
    const walk = new SvgWalk(file, svgGeometry, boxes, referenced, painter, texts, builder, warnings);
    walk.push(context, file.tree.firstChildren[element], false, []);
    while (work.left-- > 0 && walk.step());
    if (work.left < 0) return null;
    work.left -= builder.coordCount;
    return builder.finish(1, 1);
  };

  /** The root element may have a clip, effects and a speed, too. */
  private enterRoot(outer: Context): void {
    const context = this.withSpeed(0, outer);
    const { cascade, parseColor } = this.file;
    const declared = cascade.declaredOf(0);
    const effects = [
      ...effectsOf(context.style, declared, parseColor),
      ...backgroundOf(context.style, declared, parseColor),
    ];
    const clip = this.clipOf(0, declared, context);
    if (clip !== "empty") this.push({ ...context, clip }, this.file.tree.firstChildren[0], false, effects);
  }

  private push(context: Context, next: number, isSingle: boolean, effects: Effects): void {
    const firstShape = this.builder.shapeCount;
    this.stack.push({ context, next, isSingle, effects, firstShape, firstText: this.textCount });
  }

  private leave(frame: Frame): void {
    const { builder } = this;
    if (frame.effects.length === 0) return;
    if (builder.shapeCount === frame.firstShape) {
      // A filter can paint where there is no shape.
      if (frame.effects.some(([code]) => code === "filter-ignored")) this.warnings.add("filter-ignored");
      return;
    }
    const effects = this.textCount > frame.firstText ? frame.effects : withoutTextStyles(frame.effects);
    warnOf(effects, builder.boxOfShapes(frame.firstShape, builder.shapeCount), this.warnings);
  }

  private visit(element: number, outer: Context): void {
    const tag = tagOf(this.file.tree, element);
    if (tag === TEXT_NODE) return;
    const isContainer = CONTAINERS.has(tag);
    if (!isContainer && !SHAPE_TAGS.has(tag) && tag !== "text") {
      this.visitOther(element, tag, outer);
      return;
    }
    if (tag === "symbol" && outer.uses?.target !== element) return;
    if (!this.file.meetsConditions(element)) return;
    this.spendCopy(outer);
    const declared = this.file.cascade.declaredOf(element);
    const styled = this.styled(outer, declared);
    const { style } = styled;
    const group = this.layerGroups.groupOf(element, tag, outer);
    if (declaredValue(style, declared, "display") === "none" || isTransparent(style, declared)) {
      if (group !== outer.group) this.layerGroups.hide(group);
      return;
    }
    if (group !== outer.group && tag === "g" && !style.isVisible) this.layerGroups.hideUnlessDrawn(group);
    const transform = this.transformOf(element, style, declared, outer);
    if (determinant(transform) === 0) return;
    let context = withStyle(group === outer.group ? styled : { ...styled, group }, style, transform);
    let effects = effectsOf(style, declared, this.file.parseColor);
    if (isErased(this.file.tree, style, declared)) return;
    const clip = this.clipOf(element, declared, context);
    if (clip === "empty") return;
    if (clip !== context.clip) context = { ...context, clip };
    const mask = this.maskOf(element, declared, context);
    if (mask?.clip === "empty") return;
    if (mask !== null) {
      context = { ...context, clip: mask.clip };
      if (!mask.isFaint) effects = effects.filter(([code]) => code !== "mask-ignored");
    }
    context = this.withSpeed(element, context);
    if (!isContainer) this.visitLeaf(element, tag, declared, context, effects);
    else this.enter(element, tag, declared, context, effects);
  }

  private clipOf(element: number, declared: Declared, context: Context): ClipNode | null | "empty" {
    const value = declaredValue(context.style, declared, "clip-path");
    return this.referenced === null ? context.clip : this.referenced.clips.clipOf(element, value, context);
  }

  private maskOf(element: number, declared: Declared, context: Context): MaskClip | null {
    const value = declaredValue(context.style, declared, "mask");
    return this.referenced?.masks.clipOf(element, value, context, this.drawApart) ?? null;
  }

  /**
   * The context with the style from `declared`. The last one is reused, since most elements declare the same as
   * the previous one.
   */
  private styled(outer: Context, declared: Declared): Context {
    const { last } = this;
    if (last?.outer === outer && isSameDeclared(last.declared, declared)) return last.inner;
    const text = withoutShift(withoutAlignment(outer.style.text));
    const parent = text === outer.style.text ? outer.style : { ...outer.style, text };
    const inner = withStyle(outer, this.file.computeStyle(parent, declared, outer.basis), IDENTITY);
    this.last = { outer, declared, inner };
    return inner;
  }

  private visitLeaf(
    element: number,
    tag: string,
    declared: Declared,
    context: Context,
    effects: Effects,
  ): void {
    const before = this.builder.shapeCount;
    const coordsBefore = this.builder.coordCount;
    if (tag === "text") {
      this.texts?.draw(element, context);
      if (this.builder.shapeCount > before) this.textCount++;
    } else {
      this.painter.drawShape(element, tag, declared, context);
      if (isMarked(tag, context)) this.pushMarkers(context);
    }
    if (context.uses !== null) this.copiedCoords += this.builder.coordCount - coordsBefore;
    if (effects.length > 0 && this.builder.shapeCount > before) {
      warnOf(
        tag === "text" ? effects : withoutTextStyles(effects),
        this.builder.boxOfShapes(before, this.builder.shapeCount),
        this.warnings,
      );
    }
  }

  private enter(element: number, tag: string, declared: Declared, context: Context, effects: Effects): void {
    const { tree } = this.file;
    switch (tag) {
      case "use":
        this.enterUse(element, declared, context, effects);
        return;
      case "svg":
      case "symbol": {
        const inner = viewportInside(tree, element, declared, context);
        if (inner !== null) this.push(inner, tree.firstChildren[element], false, effects);
        return;
      }
      case "switch": {
        const child = this.chosenChild(element);
        if (child !== undefined) this.push(context, child, true, effects);
        return;
      }
      default:
        this.push(context, tree.firstChildren[element], false, effects);
    }
  }

  private enterUse(element: number, declared: Declared, context: Context, effects: Effects): void {
    const { warnings } = this;
    const { tree } = this.file;
    const href = attribute(tree, element, HREF)?.trim() ?? "";
    const line = `line ${tree.lines[element]}`;
    if (!href.startsWith("#")) {
      if (href === "") warnings.add("reference-missing", undefined, line);
      else warnings.add("reference-external", undefined, href.slice(0, 60));
      return;
    }
    const target = tree.elementById.get(decodeFragment(href.slice(1)));
    if (target === undefined) {
      warnings.add("reference-missing", undefined, href.slice(0, 60));
      return;
    }
    const depth = (context.uses?.depth ?? 0) + 1;
    if (depth > MAX_COPY_DEPTH || isInsideUseOf(context.uses, target) || this.isAncestor(target, element)) {
      warnings.add("circular-use", undefined, href.slice(0, 60));
      return;
    }
    const { svgGeometry } = this;
    const x = svgGeometry.lengthOf(element, declared, context, "x", "width") ?? 0;
    const y = svgGeometry.lengthOf(element, declared, context, "y", "height") ?? 0;
    // For a copy, browsers read these two from attributes only.
    const side = (name: "width" | "height"): number | null =>
      lengthPx(attribute(tree, element, name) ?? "", context.basis, name);
    const size = { width: side("width"), height: side("height") };
    const map = compose(context.map, translation(x, y));
    const uses = { element, target, size, outer: context.uses, depth };
    this.push({ ...context, ...contextPaints(context), map, uses }, target, true, effects);
  }

  /** Pushes the markers of the shape just drawn as frames: their content is drawn like any other elements. */
  private pushMarkers(context: Context): void {
    const { tree } = this.file;
    const { style } = context;
    const { referenced } = this;
    if (referenced === null || !style.isVisible) return;
    const ids = { start: style.markerStart, mid: style.markerMid, end: style.markerEnd };
    const places = referenced.markerPlaces(this.svgGeometry.shape);
    // In reverse, since the last frame pushed is drawn first.
    for (const place of places.reverse()) {
      const id = ids[place.kind];
      const marker = id === null ? undefined : tree.elementById.get(id);
      if (marker === undefined || tagOf(tree, marker) !== "marker") continue;
      if (isInsideUseOf(context.uses, marker)) continue;
      this.spendCopy(context);
      const inner = referenced.insideMarker(this.file, marker, place, context);
      if (inner !== null) this.push(inner, tree.firstChildren[marker], false, []);
    }
  }

  private isAncestor(candidate: number, element: number): boolean {
    this.subtreeEnds ??= subtreeEndsOf(this.file.tree);
    return candidate <= element && element < this.subtreeEnds[candidate];
  }

  private visitOther(element: number, tag: string, outer: Context): void {
    if (ANIMATIONS.has(tag)) {
      this.warnings.add("animation-ignored");
      return;
    }
    if (INVISIBLE.has(tag) || isOtherProgramsData(tag) || !this.file.meetsConditions(element)) return;
    const declared = this.file.cascade.declaredOf(element);
    const style = this.file.computeStyle(outer.style, declared, outer.basis);
    if (!style.isVisible || declaredValue(style, declared, "display") === "none") return;
    if (isTransparent(style, declared)) return;
    const context = withStyle(outer, style, this.transformOf(element, style, declared, outer));
    const length = (name: "x" | "y" | "width" | "height", side: Side): number =>
      this.svgGeometry.lengthOf(element, declared, context, name, side) ?? 0;
    const box = this.svgGeometry.placeOf(
      context,
      length("x", "width"),
      length("y", "height"),
      length("width", "width"),
      length("height", "height"),
    );
    if (tag === "image") this.warnings.add("image-not-drawn", box);
    else this.warnings.add("not-supported", box, tag.slice(0, 40));
  }

  private transformOf(element: number, style: Style, declared: Declared, outer: Context): Affine {
    const boxOf = (): Box | null => this.boxes.boxOf(element, { ...outer, style });
    const map = elementTransform(style, declared, outer.basis, boxOf);
    if (map === null) {
      this.warnings.add("attribute-fault", undefined, `transform at line ${this.file.tree.lines[element]}`);
    }
    return map ?? IDENTITY;
  }

  private chosenChild(element: number): number | undefined {
    const { tree } = this.file;
    return [...childrenOf(tree, element)].find((child) => {
      const tag = tagOf(tree, child);
      const isKnown = CONTAINERS.has(tag) || SHAPE_TAGS.has(tag) || tag === "text" || EMBEDDED.has(tag);
      return isKnown && this.file.meetsConditions(child);
    });
  }

  /** With the element's own speed, if it has one. */
  private withSpeed(element: number, context: Context): Context {
    const text = attribute(this.file.tree, element, SPEED_ATTRIBUTE)?.trim();
    if (text === undefined) return context;
    const speedFactor = text === "" ? NaN : Number(text);
    if (isSpeedFactor(speedFactor)) return { ...context, speedFactor };
    this.warnings.add(
      "speed-factor",
      undefined,
      `"${text.slice(0, 40)}" at line ${this.file.tree.lines[element]}`,
    );
    return context;
  }

  private spendCopy(context: Context): void {
    if (context.uses === null) return;
    this.copiedElements++;
    if (this.copiedElements <= MAX_COPIED_ELEMENTS && this.copiedCoords <= MAX_COPIED_COORDS) return;
    throw new PlotwrightError(
      "bad-file",
      `The copies (<use>) in this SVG add more than ${MAX_COPIED_ELEMENTS} elements (reached at line ${
        this.file.tree.lines[context.uses.element]
      }). Remove copies of copies, or export with copies resolved.`,
    );
  }
}

/** Whether an element's own opacity is 0. */
const isTransparent = (style: Style, declared: Declared): boolean =>
  parseOpacity(declaredValue(style, declared, "opacity") ?? "1") === 0;

/** One past the last element inside each element; elements are in document order. */
function subtreeEndsOf(tree: SvgTree): Uint32Array {
  const ends = new Uint32Array(tree.count);
  for (let element = tree.count - 1; element >= 0; element--) {
    ends[element] = Math.max(ends[element], element + 1);
    const parent = tree.parents[element];
    if (parent >= 0) ends[parent] = Math.max(ends[parent], ends[element]);
  }
  return ends;
}

function decodeFragment(fragment: string): string {
  try {
    return decodeURIComponent(fragment);
  } catch {
    return fragment;
  }
}
