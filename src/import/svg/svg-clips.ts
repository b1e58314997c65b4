/**
 * Converts clipPath elements and viewport edges to clip regions in page mm (CSS Masking 1, §5).
 *
 * A region is the union of its children, each with its own clip-rule. A clip-path on the clipPath itself, and
 * those of ancestor elements, are intersected through the chain of ClipNodes.
 */
import { RULE_EVENODD, RULE_NONZERO, VERB_CLOSE, VERB_LINE, VERB_MOVE } from "../../drawing/drawing.js";
import { applyX, applyY, compose, IDENTITY, translation, type Affine } from "../../geometry/affine.js";
import { boxOfPoints, EMPTY_BOX, isEmptyBox, uniteBoxes, type Box } from "../../geometry/box.js";
import { ColumnBuffer, PointBuffer } from "../../geometry/growable.js";
import { AncestorStyles } from "./ancestor-style.js";
import { SHAPE_TAGS } from "./basic-shapes.js";
import { Cascade } from "./cascade.js";
import { cssClipShape, splitReferenceBox } from "./css-clip-shape.js";
import type { Declared } from "./declared.js";
import { clippedShape } from "./clip-shapes.js";
import { ClipNode, type ClipShapes } from "../clip-node.js";
import { elementTransform } from "./element-transform.js";
import { lengthPx } from "./length.js";
import { mapBox } from "../map-box.js";
import { curveBox, type ShapeBuffer } from "../shape-buffer.js";
import { withStyle, type Context } from "./svg-context.js";
import type { SvgGeometry } from "./svg-geometry.js";
import type { SvgPainter } from "./svg-painter.js";
import { attribute, HREF, tagOf, type SvgTree } from "./svg-tree.js";
import { computeStyle, declaredValue, parseUrl } from "./style.js";
import type { Warnings } from "../warnings.js";

const RECTANGLE_VERBS = Uint8Array.of(VERB_MOVE, VERB_LINE, VERB_LINE, VERB_LINE, VERB_CLOSE);
/** Max depth of clipPaths that clip clipPaths: deeper is a cycle. */
const MAX_NESTING = 16;
/** Max clips on the shapes of clipPaths, in the whole file. */
const MAX_CHILD_CLIPS = 10_000;
/** Max elements measured for objectBoundingBox, in the whole file. */
const MAX_MEASURED = 1_000_000;

interface BuiltClip {
  readonly shapes: ClipShapes;
  readonly rectangle: Box | null;
  /** One node per outer chain, so that equal clips share their index. */
  readonly nodes: Map<ClipNode | null, ClipNode>;
}

export class SvgClips {
  private readonly built = new Map<string, BuiltClip | null>();
  private readonly ancestors: AncestorStyles;
  private measured = 0;
  private childClips = 0;
  private childNesting = 0;
  /** The clipPaths that are being built, to find those that refer to themselves. */
  private readonly open = new Set<number>();

  constructor(
    private readonly tree: SvgTree,
    private readonly cascade: Cascade,
    private readonly geometry: SvgGeometry,
    /** Lays out text. */
    private readonly painter: SvgPainter,
    private readonly warnings: Warnings,
  ) {
    this.ancestors = new AncestorStyles(tree, cascade);
  }

  /** The clip of an element with this `clip-path` value inside `context`; "empty" if it hides everything. */
  clipOf(
    element: number,
    value: string | undefined,
    context: Context,
    nesting = 0,
  ): ClipNode | null | "empty" {
    if (value === undefined || value === "none") return context.clip;
    const { tree, warnings } = this;
    const shapeClip = this.shapeClip(element, value, context);
    if (shapeClip !== null) return shapeClip;
    const id = parseUrl(value);
    const target = id === null ? undefined : tree.elementById.get(id);
    if (target === undefined || tagOf(tree, target) !== "clipPath" || nesting > MAX_NESTING) {
      warnings.add("clip-ignored", undefined, value.slice(0, 40));
      return context.clip;
    }
    let units = IDENTITY;
    if (attribute(tree, target, "clipPathUnits") === "objectBoundingBox") {
      const box = this.measure(element, context);
      if (box === null || isEmptyBox(box)) return context.clip;
      units = { a: box.x1 - box.x0, b: 0, c: 0, d: box.y1 - box.y0, e: box.x0, f: box.y0 };
    }
    return this.clipTo(element, target, context, units, nesting);
  }

  /** The clip to a basic shape of CSS; null if `value` is none. */
  private shapeClip(element: number, value: string, context: Context): ClipNode | "empty" | null {
    if (!value.includes("(") || value.startsWith("url(")) return null;
    const { shape: text, isViewBox } = splitReferenceBox(value);
    const { viewportWidth: x1, viewportHeight: y1 } = context.basis;
    const box = isViewBox ? { x0: 0, y0: 0, x1, y1 } : this.boxOf(element, context);
    if (box === null) return null;
    const clip = cssClipShape(text, box, context.basis);
    if (clip === null) return null;
    const collector = new ClipCollector();
    collector.add(clip.shape, context.map, clip.evenOdd);
    const shapes = collector.finish();
    return shapes === null ? "empty" : new ClipNode(context.clip, shapes, rectangleOf(shapes));
  }

  /** A clip to a rectangle in user units: a viewport's edge. */
  rectangleClip(context: Context, x: number, y: number, width: number, height: number): ClipNode {
    const { map } = context;
    const coords = new Float64Array(8);
    const corners = [x, y, x + width, y, x + width, y + height, x, y + height];
    for (let i = 0; i < 8; i += 2) {
      coords[i] = applyX(map, corners[i], corners[i + 1]);
      coords[i + 1] = applyY(map, corners[i], corners[i + 1]);
    }
    const shapes = {
      verbs: RECTANGLE_VERBS,
      coords,
      rule: Uint8Array.of(RULE_NONZERO),
      shape: Uint32Array.of(0),
    };
    return new ClipNode(context.clip, shapes, rectangleOf(shapes));
  }

  /** Clips `element` to the clipPath `target`; `units` maps the clipPath's units to user units. */
  private clipTo(
    element: number,
    target: number,
    context: Context,
    units: Affine,
    nesting: number,
  ): ClipNode | null | "empty" {
    const declared = this.cascade.declaredOf(target);
    const style = computeStyle(this.ancestors.outside(target, context.basis), declared, context.basis);
    // A clipPath with display none does not clip.
    if (declaredValue(style, declared, "display") === "none") return context.clip;
    const own = declaredValue(style, declared, "clip-path");
    const transform = elementTransform(style, declared, context.basis, () => null) ?? IDENTITY;
    const inner = withStyle(context, style, compose(transform, units));
    const outside = own === undefined ? context.clip : this.clipOf(element, own, context, nesting + 1);
    if (outside === "empty") return "empty";
    if (this.open.has(target)) {
      this.warnings.add("clip-ignored", undefined, "a clip that contains itself");
      return context.clip;
    }
    return this.contentClip(target, inner, outside);
  }

  /** The clip to the shapes inside `target`, each filled by its own rule, and to `outside`. */
  private contentClip(target: number, inner: Context, outside: ClipNode | null): ClipNode | "empty" {
    const { a, b, c, d, e, f } = inner.map;
    const key = `${target} ${a} ${b} ${c} ${d} ${e} ${f}`;
    let built = this.built.get(key);
    if (built === undefined) {
      this.open.add(target);
      built = this.build(target, inner);
      this.open.delete(target);
      this.built.set(key, built);
    }
    if (built === null) return "empty";
    let node = built.nodes.get(outside);
    if (node === undefined) {
      node = new ClipNode(outside, built.shapes, built.rectangle);
      built.nodes.set(outside, node);
    }
    return node;
  }

  /** The shapes of a clipPath in page mm; null if it has none. */
  private build(target: number, context: Context): BuiltClip | null {
    const { tree } = this;
    const collector = new ClipCollector();
    for (let child = tree.firstChildren[target]; child >= 0; child = tree.nextSiblings[child]) {
      this.addChild(child, { ...context, clip: null }, collector);
    }
    const shapes = collector.finish();
    if (shapes === null) return null;
    return { shapes, rectangle: rectangleOf(shapes), nodes: new Map() };
  }

  private addChild(child: number, outer: Context, collector: ClipCollector): void {
    const { tree } = this;
    const tag = tagOf(tree, child);
    if (!SHAPE_TAGS.has(tag) && tag !== "use" && tag !== "text") return;
    const declared = this.cascade.declaredOf(child);
    const style = computeStyle(outer.style, declared, outer.basis);
    if (declaredValue(style, declared, "display") === "none") return;
    const boxOf = (): Box | null => this.boxOf(child, { ...outer, style });
    const transform = elementTransform(style, declared, outer.basis, boxOf) ?? IDENTITY;
    const moved = withStyle(outer, style, transform);
    const clip = this.clipOfChild(child, declaredValue(style, declared, "clip-path"), moved);
    if (clip === "empty") return;
    const context = clip === moved.clip ? moved : { ...moved, clip };
    if (tag === "use") this.addUse(child, context, collector);
    else if (tag === "text") this.addText(child, context, collector);
    else if (style.isVisible) this.addShape(child, tag, declared, context, collector);
  }

  /** Like `clipOf`, but limited, since there may be many clips of clips. */
  private clipOfChild(child: number, value: string | undefined, context: Context): ClipNode | null | "empty" {
    if (value === undefined || value === "none") return context.clip;
    if (this.childNesting < MAX_NESTING && ++this.childClips <= MAX_CHILD_CLIPS) {
      this.childNesting++;
      const clip = this.clipOf(child, value, context);
      this.childNesting--;
      return clip;
    }
    const where = `clip inside a clipPath, line ${this.tree.lines[child]}`;
    this.warnings.add("clip-ignored", undefined, where);
    return context.clip;
  }

  private addShape(
    child: number,
    tag: string,
    declared: Declared,
    context: Context,
    collector: ClipCollector,
  ): void {
    const shape = this.geometry.geometryOf(child, tag, declared, context);
    addClipped(collector, shape, context.map, context.style.clipRule === "evenodd", context.clip);
  }

  private addText(child: number, context: Context, collector: ClipCollector): void {
    const hasOutlines = this.painter.outlinesOf(child, context, (shape, map) => {
      addClipped(collector, shape, map, false, context.clip);
    });
    if (!hasOutlines) this.warnings.add("clip-text");
  }

  /** Inside a clipPath, `use` may only refer to a shape or a text. */
  private addUse(use: number, context: Context, collector: ClipCollector): void {
    const { tree } = this;
    const target = tree.elementById.get((attribute(tree, use, HREF) ?? "").trim().slice(1));
    if (target === undefined) return;
    if (!SHAPE_TAGS.has(tagOf(tree, target)) && tagOf(tree, target) !== "text") return;
    const x = lengthPx(attribute(tree, use, "x") ?? "0", context.basis, "width") ?? 0;
    const y = lengthPx(attribute(tree, use, "y") ?? "0", context.basis, "height") ?? 0;
    this.addChild(target, { ...context, map: compose(context.map, translation(x, y)) }, collector);
  }

  /** The box of an element's geometry in its own user units; null if it has none. */
  boxOf(element: number, context: Context): Box | null {
    const box = this.measure(element, context);
    return box === null || isEmptyBox(box) ? null : box;
  }

  /**
   * Like `boxOf`, but returns an empty box if there is no geometry, and null if there is too much to measure.
   */
  private measure(element: number, context: Context): Box | null {
    const { tree } = this;
    let box = EMPTY_BOX;
    const pending: { element: number; map: Affine }[] = [{ element, map: IDENTITY }];
    while (pending.length > 0) {
      const { element: at, map } = pending.pop()!;
      if (++this.measured > MAX_MEASURED) {
        this.warnings.add("clip-ignored", undefined, "too many objectBoundingBox clips");
        return null;
      }
      const tag = tagOf(tree, at);
      const declared = this.cascade.declaredOf(at);
      const style = computeStyle(context.style, declared, context.basis);
      if (declaredValue(style, declared, "display") === "none") continue;
      const own = at === element ? IDENTITY : elementTransform(style, declared, context.basis, () => null);
      const inner = own === null || own === IDENTITY ? map : compose(map, own);
      if (SHAPE_TAGS.has(tag)) {
        box = uniteBoxes(box, mapBox(inner, curveBox(this.geometry.geometryOf(at, tag, declared, context))));
      } else if (tag === "text") {
        box = uniteBoxes(box, mapBox(inner, this.painter.textBox(at, withStyle(context, style, IDENTITY))));
      } else if (tag === "use") {
        const target = tree.elementById.get((attribute(tree, at, HREF) ?? "").trim().slice(1));
        const x = lengthPx(attribute(tree, at, "x") ?? "0", context.basis, "width") ?? 0;
        const y = lengthPx(attribute(tree, at, "y") ?? "0", context.basis, "height") ?? 0;
        if (target !== undefined && pending.length < MAX_NESTING * 1000) {
          pending.push({ element: target, map: compose(inner, translation(x, y)) });
        }
      } else if (tag === "g" || tag === "a" || tag === "svg" || tag === "switch" || tag === "symbol") {
        for (let child = tree.firstChildren[at]; child >= 0; child = tree.nextSiblings[child]) {
          pending.push({ element: child, map: inner });
        }
      }
    }
    return box;
  }
}

/** Adds the part of a shape inside `clip`. */
function addClipped(
  collector: ClipCollector,
  shape: ShapeBuffer,
  map: Affine,
  evenOdd: boolean,
  clip: ClipNode | null,
): void {
  if (clip === null) return collector.add(shape, map, evenOdd);
  const whole = new ClipCollector();
  whole.add(shape, map, evenOdd);
  const outline = whole.finish();
  if (outline !== null) collector.add(clippedShape(outline, clip), IDENTITY, false);
}

/** Collects subpaths of several shapes, mapped to page mm, with the rule and the shape of each. */
class ClipCollector {
  private readonly verbs = new ColumnBuffer(Uint8Array);
  private readonly coords = new PointBuffer();
  private readonly rules: number[] = [];
  private readonly shapes: number[] = [];
  private shapeCount = 0;

  add(shape: ShapeBuffer, map: Affine, evenOdd: boolean): void {
    if (shape.isEmpty) return;
    const from = shape.coords.data;
    for (let i = 0; i < shape.coords.length; i += 2) {
      const x = applyX(map, from[i], from[i + 1]);
      const y = applyY(map, from[i], from[i + 1]);
      this.coords.push(Number.isFinite(x) ? x : 0, Number.isFinite(y) ? y : 0);
    }
    for (let i = 0; i < shape.verbs.length; i++) {
      const verb = shape.verbs.data[i];
      this.verbs.push(verb);
      if (verb !== VERB_MOVE) continue;
      this.rules.push(evenOdd ? RULE_EVENODD : RULE_NONZERO);
      this.shapes.push(this.shapeCount);
    }
    this.shapeCount++;
  }

  finish(): ClipShapes | null {
    if (this.verbs.length === 0) return null;
    return {
      verbs: this.verbs.toArray(),
      coords: this.coords.toArray(),
      rule: Uint8Array.from(this.rules),
      shape: Uint32Array.from(this.shapes),
    };
  }
}

/** The region's box if it is one axis-aligned rectangle, otherwise null. */
export function rectangleOf({ verbs, coords, rule }: ClipShapes): Box | null {
  if (rule.length !== 1) return null;
  const points = coords.length / 2;
  const isClosedAgain = points === 5 && coords[0] === coords[8] && coords[1] === coords[9];
  if (points !== 4 && !isClosedAgain) return null;
  for (let i = 1; i < verbs.length; i++) if (verbs[i] !== VERB_LINE && verbs[i] !== VERB_CLOSE) return null;
  for (let i = 0; i < 4; i++) {
    const next = ((i + 1) % 4) * 2;
    const sameX = coords[2 * i] === coords[next];
    const sameY = coords[2 * i + 1] === coords[next + 1];
    // Sides alternate. A degenerate side is both horizontal and vertical: not a rectangle.
    if (sameX === sameY) return null;
    if (i % 2 === 0 && sameX !== (coords[4] === coords[6])) return null;
  }
  return boxOfPoints(coords);
}
