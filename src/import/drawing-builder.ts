/** Gathers shapes into the columns of a Drawing. Coordinates become page mm here and only here. */
import {
  RULE_EVENODD,
  RULE_NONZERO,
  VERB_LINE,
  VERB_MOVE,
  type ClipRegion,
  type DashPattern,
  type Drawing,
  type DrawingGroup,
} from "../drawing/drawing.js";
import type { Affine } from "../geometry/affine.js";
import { EMPTY_BOX, uniteBoxes, type Box } from "../geometry/box.js";
import { ColumnBuffer, type PointBuffer } from "../geometry/growable.js";
import { clipIndexFor, type ClipNode } from "./clip-node.js";
import { CoordColumn } from "./coord-column.js";
import { curveBoxOf } from "./curve-box.js";
import type { ShapeBuffer } from "./shape-buffer.js";
import { ShapeColumns } from "./shape-columns.js";
import type { Warnings } from "./warnings.js";

/** A kilometre: far beyond any plotter, near enough that µm survive in single arithmetic steps. */
const MAX_COORDINATE_MM = 1e6;

/** How a shape is painted. Colours "#rrggbb" or null for none; lengths in page mm. */
export interface Look {
  readonly stroke: string | null;
  readonly fill: string | null;
  readonly evenOdd: boolean;
  readonly strokeWidth: number;
  readonly dash: DashPattern | null;
}

export class DrawingBuilder {
  readonly groups: DrawingGroup[] = [];
  readonly clips: ClipRegion[] = [];
  private readonly colors: string[] = [];
  private readonly colorIndex = new Map<string, number>();
  private readonly dashes: DashPattern[] = [];
  private readonly dashIndex = new Map<string, number>();
  private readonly verbs = new ColumnBuffer(Uint8Array, 1024);
  private readonly coords = new CoordColumn();
  private readonly shapes = new ShapeColumns();
  /** The look of the shape before, and its numbers. */
  private look: Look | null = null;
  private lookStroke = -1;
  private lookFill = -1;
  private lookDash = -1;

  constructor(private readonly warnings: Warnings) {}

  get shapeCount(): number {
    return this.shapes.count;
  }

  /** Numbers held so far: what memory and time go by. */
  get coordCount(): number {
    return this.coords.length;
  }

  /** How much of the file has been drawn, 0 … 1: lets the columns be made as long as they will be. */
  set progress(share: number) {
    this.coords.share = this.shapes.share = share;
  }

  /** Adds a group; ids already taken get a number, so that they stay distinct. */
  addGroup(id: string, name: string, hidden: boolean): number {
    const taken = new Set(this.groups.map((group) => group.id));
    let unique = id;
    for (let n = 2; taken.has(unique); n++) unique = `${id}-${n}`;
    this.groups.push({ id: unique, name, hidden });
    return this.groups.length - 1;
  }

  /**
   * Adds `shape`, mapped to page mm. False where it is out of range and left out: `where` names it in the warning.
   */
  addShape(
    shape: ShapeBuffer,
    map: Affine,
    look: Look,
    group: number,
    clip: ClipNode | null,
    where: () => string,
  ): boolean {
    const { coords, verbs, shapes } = this;
    coords.reserve(shape.coords.length);
    if (!writeMapped(shape.coords, map, coords.data, coords.length)) {
      this.warnings.add("coordinates-out-of-range", undefined, where());
      return false;
    }
    coords.length += shape.coords.length;
    const count = shape.verbs.length;
    verbs.reserve(count);
    for (let i = 0; i < count; i++) verbs.data[verbs.length + i] = shape.verbs.data[i];
    verbs.length += count;
    if (look !== this.look) this.takeLook(look);
    shapes.reserve(1);
    const i = shapes.count++;
    shapes.verbOffsets[i + 1] = verbs.length;
    shapes.coordOffsets[i + 1] = coords.length;
    shapes.group[i] = group;
    shapes.stroke[i] = this.lookStroke;
    shapes.fill[i] = this.lookFill;
    shapes.fillRule[i] = look.evenOdd ? RULE_EVENODD : RULE_NONZERO;
    shapes.strokeWidth[i] = finiteWidth(look.strokeWidth);
    shapes.dash[i] = this.lookDash;
    shapes.clip[i] = clip === null ? -1 : clipIndexFor(clip, this.boxOfShapes(i, i + 1), this.clips);
    return true;
  }

  /**
   * Adds polylines as shapes of one look, mapped to page mm: the numbers of the i-th one end at ends[i] in `from`. Answers
   * how many: up to one that is out of range.
   */
  addPolylines(
    from: Float64Array,
    ends: Uint32Array,
    count: number,
    map: Affine,
    look: Look,
    group: number,
  ): number {
    if (count === 0) return 0;
    const { coords, verbs, shapes } = this;
    coords.reserve(ends[count - 1]);
    shapes.reserve(count);
    if (look !== this.look) this.takeLook(look);
    const { data } = coords;
    const { verbOffsets, coordOffsets } = shapes;
    const { a, b, c, d, e, f } = map;
    const first = shapes.count;
    const shift = coords.length;
    const verbShift = verbs.length - shift / 2;
    let added = 0;
    for (let k = 0; added < count; added++) {
      const end = ends[added];
      for (; k < end; k += 2) {
        const x = a * from[k] + c * from[k + 1] + e;
        const y = b * from[k] + d * from[k + 1] + f;
        data[shift + k] = x;
        data[shift + k + 1] = y;
        // Written so that NaN is out of range.
        if (!(Math.abs(x) <= MAX_COORDINATE_MM && Math.abs(y) <= MAX_COORDINATE_MM)) break;
      }
      if (k < end) break;
      coordOffsets[first + added + 1] = coords.length = shift + end;
      verbOffsets[first + added + 1] = verbShift + coords.length / 2;
    }
    const verbCount = (coords.length - shift) / 2;
    verbs.reserve(verbCount);
    verbs.data.fill(VERB_LINE, verbs.length, verbs.length + verbCount);
    for (let i = first; i < first + added; i++) verbs.data[verbOffsets[i]] = VERB_MOVE;
    verbs.length += verbCount;
    shapes.count += added;
    shapes.group.fill(group, first, shapes.count);
    shapes.stroke.fill(this.lookStroke, first, shapes.count);
    shapes.fill.fill(this.lookFill, first, shapes.count);
    shapes.fillRule.fill(look.evenOdd ? RULE_EVENODD : RULE_NONZERO, first, shapes.count);
    shapes.strokeWidth.fill(finiteWidth(look.strokeWidth), first, shapes.count);
    shapes.dash.fill(this.lookDash, first, shapes.count);
    shapes.clip.fill(-1, first, shapes.count);
    return added;
  }

  /** The box of shapes [from, to). */
  boxOfShapes(from: number, to: number): Box {
    const { coordOffsets } = this.shapes;
    return this.coords.boxOf(coordOffsets[from], coordOffsets[to]);
  }

  boxOfLast(): Box {
    return this.boxOfShapes(this.shapeCount - 1, this.shapeCount);
  }

  /** The box of all curves themselves, where `boxOfShapes` has that of their control points. */
  extent(): Box {
    let box = EMPTY_BOX;
    const { verbOffsets, coordOffsets } = this.shapes;
    for (let i = 0; i < this.shapeCount; i++) {
      const [from, to] = [verbOffsets[i], verbOffsets[i + 1]];
      box = uniteBoxes(box, curveBoxOf(this.verbs.data, from, to, this.coords.data, coordOffsets[i]));
    }
    return box;
  }

  /** Moves everything: for files that do not say where their page is. */
  translate(dx: number, dy: number): void {
    this.coords.translate(dx, dy);
    for (const clip of this.clips) {
      for (let i = 0; i < clip.coords.length; i += 2) {
        clip.coords[i] += dx;
        clip.coords[i + 1] += dy;
      }
    }
  }

  finish(widthMm: number, heightMm: number): Drawing {
    const { shapes, shapeCount: count } = this;
    if (count === 0) this.warnings.add("empty-drawing");
    return {
      widthMm,
      heightMm,
      groups: this.groups,
      colors: this.colors,
      dashes: this.dashes,
      clips: this.clips,
      paths: {
        count,
        verbs: this.verbs.view(),
        coords: this.coords.data.subarray(0, this.coords.length),
        verbOffsets: shapes.verbOffsets.subarray(0, count + 1),
        coordOffsets: shapes.coordOffsets.subarray(0, count + 1),
        group: shapes.group.subarray(0, count),
        stroke: shapes.stroke.subarray(0, count),
        fill: shapes.fill.subarray(0, count),
        fillRule: shapes.fillRule.subarray(0, count),
        strokeWidth: shapes.strokeWidth.subarray(0, count),
        dash: shapes.dash.subarray(0, count),
        clip: shapes.clip.subarray(0, count),
      },
      warnings: this.warnings.toArray(),
    };
  }

  private takeLook(look: Look): void {
    this.look = look;
    this.lookStroke = this.colorOf(look.stroke);
    this.lookFill = this.colorOf(look.fill);
    this.lookDash = look.dash === null ? -1 : this.dashOf(look.dash);
  }

  private colorOf(color: string | null): number {
    if (color === null) return -1;
    let index = this.colorIndex.get(color);
    if (index === undefined) {
      index = this.colors.length;
      this.colors.push(color);
      this.colorIndex.set(color, index);
    }
    return index;
  }

  private dashOf(dash: DashPattern): number {
    const key = `${dash.lengths.join(" ")}@${dash.offset}`;
    let index = this.dashIndex.get(key);
    if (index === undefined) {
      index = this.dashes.length;
      this.dashes.push(dash);
      this.dashIndex.set(key, index);
    }
    return index;
  }
}

/** A width that is beyond all numbers, or none, would be infinite or NaN in whatever is computed from it. */
const finiteWidth = (mm: number): number => (mm >= 0 ? Math.min(mm, MAX_COORDINATE_MM) : 0);

/** Writes the mapped pairs into `to` from `at` on. False where one is out of range or no number. */
function writeMapped(source: PointBuffer, map: Affine, to: Float64Array, at: number): boolean {
  const from = source.data;
  const { a, b, c, d, e, f } = map;
  let inRange = true;
  for (let i = 0; i < source.length; i += 2) {
    const x = a * from[i] + c * from[i + 1] + e;
    const y = b * from[i] + d * from[i + 1] + f;
    to[at++] = x;
    to[at++] = y;
    // Written so that NaN is out of range.
    if (!(Math.abs(x) <= MAX_COORDINATE_MM && Math.abs(y) <= MAX_COORDINATE_MM)) inRange = false;
  }
  return inRange;
}
