/** SVG's basic shapes and paths to verbs and coordinates in user units (SVG 2, chapters 9 and 10). */
import { drawCentreArc, drawEllipse } from "../../arc.js";
import { isFontLength, lengthPx, type Side } from "../css/length.js";
import type { Declared, Property } from "../css/properties.js";
import { declaredValue } from "../css/style.js";
import type { Context } from "../svg-context.js";
import { attribute, type SvgTree } from "../svg-tree.js";
import { drawPathData, NumberReader } from "../../path-data.js";
import { ShapeBuffer } from "../../shape-buffer.js";
import { applyX, applyY, largestScale } from "../../../geometry/affine.js";
import { mapBox, type Box } from "../../../geometry/box.js";
import type { Warnings } from "../../warnings.js";

type LengthName = "x" | "y" | "width" | "height" | "cx" | "cy" | "r" | "rx" | "ry";

export const SHAPE_TAGS: ReadonlySet<string> = new Set([
  "path",
  "rect",
  "circle",
  "ellipse",
  "line",
  "polyline",
  "polygon",
]);

/** Draws the element; returns a description of any error, or null. `arcTolerance` in user units. */
function drawBasicShape(
  tag: string,
  source: ShapeSource,
  shape: ShapeBuffer,
  arcTolerance: number,
): string | null {
  switch (tag) {
    case "path":
      return drawPath(source, shape, arcTolerance);
    case "rect":
      return drawRect(source, shape, arcTolerance);
    case "circle": {
      const r = source.length("r", "both") ?? 0;
      return r < 0 ? "negative radius" : drawRound(source, shape, { rx: r, ry: r }, arcTolerance);
    }
    case "ellipse":
      return drawRound(source, shape, radiiOf(source), arcTolerance);
    case "line":
      shape.moveTo(source.attributeLength("x1", "width") ?? 0, source.attributeLength("y1", "height") ?? 0);
      shape.lineTo(source.attributeLength("x2", "width") ?? 0, source.attributeLength("y2", "height") ?? 0);
      return null;
    default:
      return drawPoints(source.text("points") ?? "", shape, tag === "polygon");
  }
}

interface Radii {
  readonly rx: number;
  readonly ry: number;
}

/** A negative radius is invalid and counts as absent: the other one then applies to both axes. */
function radiiOf(source: ShapeSource): Radii {
  const valid = (length: number | null): number | null => (length !== null && length >= 0 ? length : null);
  const rx = valid(source.length("rx", "width"));
  const ry = valid(source.length("ry", "height"));
  return { rx: rx ?? ry ?? 0, ry: ry ?? rx ?? 0 };
}

function drawPath(source: ShapeSource, shape: ShapeBuffer, arcTolerance: number): string | null {
  const text = source.text("d");
  if (text === undefined) return null;
  const fault = drawPathData(shape, text, arcTolerance);
  if (fault < 0) return null;
  const near = text.slice(Math.max(0, fault - 12), fault + 8).replace(/\s+/g, " ");
  return `character ${fault + 1}, near "${near}"`;
}

function drawRound(source: ShapeSource, shape: ShapeBuffer, { rx, ry }: Radii, arcTolerance: number): null {
  const cx = source.length("cx", "width") ?? 0;
  const cy = source.length("cy", "height") ?? 0;
  if (rx > 0 && ry > 0) drawEllipse(shape, cx, cy, rx, ry, arcTolerance);
  return null;
}

function drawRect(source: ShapeSource, shape: ShapeBuffer, arcTolerance: number): string | null {
  const x = source.length("x", "width") ?? 0;
  const y = source.length("y", "height") ?? 0;
  const width = source.length("width", "width") ?? 0;
  const height = source.length("height", "height") ?? 0;
  if (width < 0 || height < 0) return "negative size";
  if (width === 0 || height === 0) return null;
  const radii = radiiOf(source);
  const rx = Math.min(radii.rx, width / 2);
  const ry = Math.min(radii.ry, height / 2);
  const x1 = x + width;
  const y1 = y + height;
  if (rx === 0 || ry === 0) {
    shape.rectangle(x, y, x1, y1);
    return null;
  }
  const corner = (cx: number, cy: number, start: number, endX: number, endY: number): void =>
    drawCentreArc(shape, cx, cy, rx, ry, 0, start, Math.PI / 2, endX, endY, arcTolerance);
  const side = (toX: number, toY: number): void => {
    if (toX !== shape.x || toY !== shape.y) shape.lineTo(toX, toY);
  };
  shape.moveTo(x + rx, y);
  side(x1 - rx, y);
  corner(x1 - rx, y + ry, -Math.PI / 2, x1, y + ry);
  side(x1, y1 - ry);
  corner(x1 - rx, y1 - ry, 0, x1 - rx, y1);
  side(x + rx, y1);
  corner(x + rx, y1 - ry, Math.PI / 2, x, y1 - ry);
  side(x, y + ry);
  corner(x + rx, y + ry, Math.PI, x + rx, y);
  shape.close();
  return null;
}

function drawPoints(text: string, shape: ShapeBuffer, isClosed: boolean): string | null {
  const reader = new NumberReader(text);
  reader.skipBlanks();
  let pointCount = 0;
  let fault: string | null = null;
  while (reader.at < text.length) {
    const x = reader.read();
    if (x === null) {
      fault = `character ${reader.at + 1}`;
      break;
    }
    reader.skipSeparator();
    const y = reader.read();
    if (y === null) {
      fault = "an odd number of coordinates";
      break;
    }
    if (pointCount++ === 0) shape.moveTo(x, y);
    else shape.lineTo(x, y);
    reader.skipSeparator();
  }
  if (isClosed && pointCount > 1) shape.close();
  return fault;
}

/** The numbers of one element: from CSS first, then from attributes. */
class ShapeSource {
  /** The element's last length that could not be read. */
  malformed: string | null = null;
  /** The element's last length in ex or ch. */
  fontLength: string | null = null;

  constructor(
    private readonly tree: SvgTree,
    private readonly element: number,
    private readonly declared: Declared,
    private readonly context: Context,
  ) {}

  /** User units; null if the value is absent, auto or malformed. */
  length(name: LengthName, side: Side): number | null {
    return this.px(this.css(name) ?? attribute(this.tree, this.element, name), side);
  }

  /** An attribute that is a plain length. */
  attributeLength(name: "x1" | "y1" | "x2" | "y2", side: Side): number | null {
    return this.px(attribute(this.tree, this.element, name), side);
  }

  text(name: "d" | "points"): string | undefined {
    const path = name === "d" ? this.css("d") : undefined;
    if (path === "none") return "";
    const quoted = path === undefined ? null : /^path\(\s*["'](.*)["']\s*\)$/s.exec(path);
    return quoted?.[1] ?? attribute(this.tree, this.element, name);
  }

  private px(text: string | undefined, side: Side): number | null {
    if (text === undefined || text === "auto") return null;
    const length = lengthPx(text, this.context.basis, side);
    if (length === null) this.malformed = text.slice(0, 40);
    else if (isFontLength(text)) this.fontLength = text.trim();
    return length;
  }

  private css(name: Property): string | undefined {
    return declaredValue(this.context.style, this.declared, name);
  }
}

/** Converts elements to outlines in user units, and finds their place on the page. */
export class SvgGeometry {
  /** The latest outline. */
  readonly shape = new ShapeBuffer();

  constructor(
    private readonly tree: SvgTree,
    private readonly warnings: Warnings,
    /** mm on the page: max distance between an arc and its cubics. */
    private readonly arcToleranceMm: number,
  ) {}

  /** Draws the element's outline in user units into `shape`, which the next call reuses. */
  geometryOf(element: number, tag: string, declared: Declared, context: Context): ShapeBuffer {
    const { shape } = this;
    shape.clear();
    const tolerance = this.arcToleranceMm / largestScale(context.map);
    const source = new ShapeSource(this.tree, element, declared, context);
    const drawn = drawBasicShape(tag, source, shape, tolerance);
    shape.finish();
    const fault = drawn ?? (source.malformed === null ? null : `"${source.malformed}" is not a length`);
    if (fault !== null) {
      const where = this.whereOf(element);
      if (tag === "path") this.warnings.add("path-data", this.firstPoint(context), `${where}: ${fault}`);
      else this.warnings.add("attribute-fault", this.firstPoint(context), `${tag} at ${where}: ${fault}`);
    }
    if (source.fontLength !== null)
      this.warnings.add("length-approximate", this.firstPoint(context), source.fontLength);
    return shape;
  }

  /** A length from CSS or an attribute; null if neither gives one. */
  lengthOf(
    element: number,
    declared: Declared,
    context: Context,
    name: LengthName,
    side: Side,
  ): number | null {
    return new ShapeSource(this.tree, element, declared, context).length(name, side);
  }

  /** The page box of a rectangle in user units. */
  placeOf(context: Context, x: number, y: number, width: number, height: number): Box {
    return mapBox(context.map, { x0: x, y0: y, x1: x + width, y1: y + height });
  }

  firstPoint(context: Context): Box {
    const { coords } = this.shape;
    const [x, y] = coords.length >= 2 ? coords.data : [this.shape.x, this.shape.y];
    const px = applyX(context.map, x, y);
    const py = applyY(context.map, x, y);
    return { x0: px, y0: py, x1: px, y1: py };
  }

  whereOf(element: number): string {
    const id = attribute(this.tree, element, "id");
    const line = `line ${this.tree.lines[element]}`;
    return id === undefined ? line : `${line}, id ${id.slice(0, 40)}`;
  }
}
