/**
 * Converts clipPath elements and viewport edges to clip regions in page mm (CSS Masking 1, §5).
 *
 * A region is the union of its children, each with its own clip-rule. A clip-path on the clipPath itself, and
 * those of ancestor elements, are intersected through the chain of ClipNodes.
 */
import { RULE_EVENODD, RULE_NONZERO, VERB_MOVE } from "../../../drawing/drawing.js";
import { compose, IDENTITY, scaling, translation, type Affine } from "../../../geometry/affine.js";
import type { Box } from "../../../geometry/box.js";
import { SHAPE_TAGS, type SvgGeometry } from "../shapes/basic-shapes.js";
import { copyOf, type ElementBoxes } from "../element-boxes.js";
import { cssClipShape, splitReferenceBox } from "./css-clip-shape.js";
import { MAX_COORDINATE_MM } from "../../drawing-builder.js";
import { clippedShape } from "./clip-shapes.js";
import { ClipNode, type ClipShapes } from "../../clip-node.js";
import { getOrAdd } from "../../../get-or-add.js";
import { elementTransform } from "../css/transform.js";
import { ShapeBuffer } from "../../shape-buffer.js";
import { withStyle, type Context, contentKey } from "../svg-context.js";
import type { SvgFile } from "../svg-file.js";
import type { TextPainter } from "../text/text-painter.js";
import { attribute, childrenOf, tagOf } from "../svg-tree.js";
import { declaredValue, parseUrl } from "../css/style.js";
import type { Warnings } from "../../warnings.js";
import { clamp } from "../../../geometry/polyline.js";

/** Max depth of clipPaths that clip clipPaths: deeper is a cycle. */
const MAX_NESTING = 16;
/** Max clips on the shapes of clipPaths, in the whole file. */
const MAX_CHILD_CLIPS = 10_000;

interface BuiltClip {
  readonly shapes: ClipShapes;
  /** One node per outer chain, so that equal clips share their index. */
  readonly nodes: Map<ClipNode | null, ClipNode>;
}

export class SvgClips {
  private readonly built = new Map<string, BuiltClip | null>();
  private childClips = 0;
  private childNesting = 0;
  /** The clipPaths that are being built, to find those that refer to themselves. */
  private readonly open = new Set<number>();

  constructor(
    private readonly file: SvgFile,
    private readonly geometry: SvgGeometry,
    private readonly boxes: ElementBoxes,
    /** Null: the file has no text. */
    private readonly texts: TextPainter | null,
    private readonly warnings: Warnings,
  ) {}

  /** The clip of an element with this `clip-path` value inside `context`; "empty" if it hides everything. */
  clipOf(
    element: number,
    value: string | undefined,
    context: Context,
    nesting = 0,
  ): ClipNode | null | "empty" {
    if (value === undefined || value === "none") return context.clip;
    const { file, warnings } = this;
    const { tree } = file;
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
      const box = this.boxes.boxOf(element, context);
      if (box === null) return context.clip;
      units = boxUnits(box);
    }
    return this.clipTo(element, target, context, units, nesting);
  }

  /** The clip to a basic shape of CSS; null if `value` is none. */
  private shapeClip(element: number, value: string, context: Context): ClipNode | "empty" | null {
    if (!value.includes("(") || value.startsWith("url(")) return null;
    const { shape: text, isViewBox } = splitReferenceBox(value);
    const { viewportWidth: x1, viewportHeight: y1 } = context.basis;
    const box = isViewBox ? { x0: 0, y0: 0, x1, y1 } : this.boxes.boxOf(element, context);
    if (box === null) return null;
    const clip = cssClipShape(text, box, context.basis);
    if (clip === null) return null;
    const collector = new ClipCollector();
    collector.add(clip.shape, context.map, clip.evenOdd, null);
    const shapes = collector.finish();
    return shapes === null ? "empty" : new ClipNode(context.clip, shapes);
  }

  /** Clips `element` to the clipPath `target`; `units` maps the clipPath's units to user units. */
  private clipTo(
    element: number,
    target: number,
    context: Context,
    units: Affine,
    nesting: number,
  ): ClipNode | null | "empty" {
    const declared = this.file.cascade.declaredOf(target);
    const style = this.file.computeStyle(
      this.file.styleAround(target, context.basis),
      declared,
      context.basis,
    );
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
    const built = getOrAdd(this.built, contentKey(target, inner), () => this.build(target, inner));
    if (built === null) return "empty";
    return getOrAdd(built.nodes, outside, () => new ClipNode(outside, built.shapes));
  }

  /** The shapes of a clipPath in page mm; null if it has none. */
  private build(target: number, context: Context): BuiltClip | null {
    const collector = new ClipCollector();
    this.open.add(target);
    for (const child of childrenOf(this.file.tree, target)) {
      this.addChild(child, { ...context, clip: null }, collector);
    }
    this.open.delete(target);
    const shapes = collector.finish();
    if (shapes === null) return null;
    return { shapes, nodes: new Map() };
  }

  private addChild(child: number, outer: Context, collector: ClipCollector): void {
    const { tree } = this.file;
    const tag = tagOf(tree, child);
    if (!SHAPE_TAGS.has(tag) && tag !== "use" && tag !== "text") return;
    const declared = this.file.cascade.declaredOf(child);
    const style = this.file.computeStyle(outer.style, declared, outer.basis);
    if (declaredValue(style, declared, "display") === "none") return;
    const boxOf = (): Box | null => this.boxes.boxOf(child, { ...outer, style });
    const transform = elementTransform(style, declared, outer.basis, boxOf) ?? IDENTITY;
    const moved = withStyle(outer, style, transform);
    const clip = this.clipOfChild(child, declaredValue(style, declared, "clip-path"), moved);
    if (clip === "empty") return;
    const context = clip === moved.clip ? moved : { ...moved, clip };
    if (tag === "use") this.addUse(child, context, collector);
    else if (tag === "text") this.addText(child, context, collector);
    else if (style.isVisible) {
      const shape = this.geometry.geometryOf(child, tag, declared, context);
      collector.add(shape, context.map, style.clipRule === "evenodd", clip);
    }
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
    const where = `clip inside a clipPath, line ${this.file.tree.lines[child]}`;
    this.warnings.add("clip-ignored", undefined, where);
    return context.clip;
  }

  private addText(child: number, context: Context, collector: ClipCollector): void {
    const hasOutlines = this.texts?.outlinesOf(child, context, (shape, map) => {
      collector.add(shape, map, false, context.clip);
    });
    if (!hasOutlines) this.warnings.add("clip-text");
  }

  /** Inside a clipPath, `use` may only refer to a shape or a text. */
  private addUse(use: number, context: Context, collector: ClipCollector): void {
    const { target, shift } = copyOf(this.file.tree, use, context.basis);
    if (target === undefined) return;
    const tag = tagOf(this.file.tree, target);
    if (!SHAPE_TAGS.has(tag) && tag !== "text") return;
    this.addChild(target, { ...context, map: compose(context.map, shift) }, collector);
  }
}

/** Maps the units of objectBoundingBox, 0 … 1, to the box. */
export const boxUnits = ({ x0, y0, x1, y1 }: Box): Affine =>
  compose(translation(x0, y0), scaling(x1 - x0, y1 - y0));

/** Collects subpaths of several shapes, mapped to page mm, with the rule and the shape of each. */
class ClipCollector {
  private readonly all = new ShapeBuffer();
  private readonly rules: number[] = [];
  private readonly shapes: number[] = [];
  private shapeCount = 0;

  /** Adds the part of a shape inside `clip`. */
  add(shape: ShapeBuffer, map: Affine, evenOdd: boolean, clip: ClipNode | null): void {
    if (shape.isEmpty) return;
    if (clip !== null) {
      const whole = new ClipCollector();
      whole.add(shape, map, evenOdd, null);
      const outline = whole.finish();
      if (outline !== null) this.add(clippedShape(outline, clip), IDENTITY, false, null);
      return;
    }
    this.all.append(shape, map);
    for (const verb of shape.verbs.view()) {
      if (verb !== VERB_MOVE) continue;
      this.rules.push(evenOdd ? RULE_EVENODD : RULE_NONZERO);
      this.shapes.push(this.shapeCount);
    }
    this.shapeCount++;
  }

  finish(): ClipShapes | null {
    const { verbs, coords, isEmpty } = this.all;
    if (isEmpty) return null;
    return {
      verbs: verbs.toArray(),
      coords: coords.toArray().map(withinRange),
      rule: Uint8Array.from(this.rules),
      shape: Uint32Array.from(this.shapes),
    };
  }
}

/** A larger clip hides the same of the page, and a curve of that size would be flattened into millions of pieces. */
const withinRange = (mm: number): number =>
  Number.isNaN(mm) ? 0 : clamp(mm, -MAX_COORDINATE_MM, MAX_COORDINATE_MM);
