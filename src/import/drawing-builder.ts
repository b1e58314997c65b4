/** Collects shapes into the columns of a Drawing. Only this file converts coordinates to page mm. */
import { curveBoxOf } from "../drawing/curve-box.js";
import {
  RULE_EVENODD,
  RULE_NONZERO,
  type ClipRegion,
  type DashPattern,
  type Drawing,
  type DrawingGroup,
} from "../drawing/drawing.js";
import { PlotwrightError } from "../errors.js";
import { IDENTITY, type Affine } from "../geometry/affine.js";
import { boxOfPoints, EMPTY_BOX, intersectBoxes, isEmptyBox, uniteBoxes, type Box } from "../geometry/box.js";
import { ColumnBuffer, PointBuffer } from "../geometry/growable.js";
import { clipIndexFor, type ClipNode } from "./clip-node.js";
import { getOrAdd } from "../get-or-add.js";
import type { ShapeBuffer } from "./shape-buffer.js";
import type { ReadDrawing, Warnings } from "./warnings.js";

/** One kilometre: far beyond any plotter, and small enough that calculations still resolve µm. */
export const MAX_COORDINATE_MM = 1e6;
/** For files without a page, whose coordinates may be those of a map: twice around the earth. */
const MAX_ANYWHERE_MM = 1e11;

/** 400 MB. Even a file of 200 MB seldom needs more, but a few bytes of blocks and copies can expand to any size. */
const MAX_COORDS = 50_000_000;

/** Min side of a page around the drawing, mm, so that a drawing of one straight line has a page with an area. */
const SMALLEST_SIDE = 1;

/** Below this share of the file the total cannot be estimated yet. MARGIN allows for a denser rest. */
const MIN_SHARE_TO_ESTIMATE = 0.01;
const MARGIN = 1.25;

/** How a shape is painted. Colours "#rrggbb" or null for none; lengths in page mm. */
export interface Look {
  readonly stroke: string | null;
  readonly fill: string | null;
  /** Left out: nonzero. */
  readonly evenOdd?: boolean;
  /** Left out: 0. */
  readonly strokeWidth?: number;
  /** Left out: a solid line. */
  readonly dash?: DashPattern | null;
  /** Left out: 1. */
  readonly speedFactor?: number;
}

export class DrawingBuilder {
  readonly groups: DrawingGroup[] = [];
  private readonly groupIds = new Set<string>();
  readonly clips: ClipRegion[] = [];
  private readonly colors: string[] = [];
  private readonly colorIndex = new Map<string, number>();
  private readonly dashes: DashPattern[] = [];
  private readonly dashIndex = new Map<string, number>();
  private readonly verbs = new ColumnBuffer(Uint8Array, 1024);
  private readonly coords = new PointBuffer(1024);
  /** Where each shape ends; the first one begins at 0. */
  private readonly verbOffsets = new ColumnBuffer(Uint32Array);
  private readonly coordOffsets = new ColumnBuffer(Uint32Array);
  private readonly group = new ColumnBuffer(Uint32Array);
  private readonly stroke = new ColumnBuffer(Int32Array);
  private readonly fill = new ColumnBuffer(Int32Array);
  private readonly fillRule = new ColumnBuffer(Uint8Array);
  private readonly strokeWidth = new ColumnBuffer(Float32Array);
  private readonly dash = new ColumnBuffer(Int32Array);
  private readonly clip = new ColumnBuffer(Int32Array);
  /** Speed factors of the shapes that are drawn slower. */
  private readonly speedFactors = new Map<number, number>();
  /**
   * How much of the file has been drawn, 0 … 1. Coordinates are most of a large drawing, so memory for the
   * likely total is reserved at once: growing step by step would hold them twice.
   */
  progress = 0;

  private readonly maxCoordinate: number;

  /** @param place `isAnywhere`: the drawing may lie far from its origin; only its extent counts */
  constructor(
    private readonly warnings: Warnings,
    { isAnywhere = false } = {},
  ) {
    this.maxCoordinate = isAnywhere ? MAX_ANYWHERE_MM : MAX_COORDINATE_MM;
    this.verbOffsets.push(0);
    this.coordOffsets.push(0);
  }

  get shapeCount(): number {
    return this.group.length;
  }

  /** Number of coordinates so far, for limits on memory and time. */
  get coordCount(): number {
    return this.coords.length;
  }

  /** Adds a group; a duplicate id gets a number appended. */
  addGroup(id: string, name: string, hidden: boolean, parent?: number): number {
    let unique = id;
    for (let n = 2; this.groupIds.has(unique); n++) unique = `${id}-${n}`;
    this.groupIds.add(unique);
    this.groups.push({ id: unique, name, hidden, ...(parent === undefined ? {} : { parent }) });
    return this.groups.length - 1;
  }

  /** Adds `shape`, mapped to page mm. Returns false, with a warning that names `where`, if it is out of range. */
  addShape(
    shape: ShapeBuffer,
    map: Affine,
    look: Look,
    group: number,
    clip: ClipNode | null,
    where: () => string,
  ): boolean {
    const { coords, verbs } = this;
    this.reserveCoords(shape.coords.length);
    if (!writeMapped(shape.coords, map, coords.data, coords.length, this.maxCoordinate)) {
      this.warnings.add("coordinates-out-of-range", undefined, where());
      return false;
    }
    coords.length += shape.coords.length;
    for (let i = 0; i < shape.verbs.length; i++) verbs.push(shape.verbs.data[i]);
    const { evenOdd = false, strokeWidth = 0, dash = null, speedFactor = 1 } = look;
    if (speedFactor !== 1) this.speedFactors.set(this.shapeCount, speedFactor);
    this.verbOffsets.push(verbs.length);
    this.coordOffsets.push(coords.length);
    this.group.push(group);
    this.stroke.push(this.colorOf(look.stroke));
    this.fill.push(this.colorOf(look.fill));
    this.fillRule.push(evenOdd ? RULE_EVENODD : RULE_NONZERO);
    this.strokeWidth.push(finiteWidth(strokeWidth));
    this.dash.push(this.dashOf(dash));
    this.clip.push(clip === null ? -1 : clipIndexFor(clip, this.boxOfLast(), this.clips));
    return true;
  }

  /** Whether the group, or a sublayer of it, has a shape. */
  hasShapes(group: number): boolean {
    return this.group.view().some((of) => {
      let at: number | undefined = of;
      while (at !== undefined && at !== group) at = this.groups[at]?.parent;
      return at === group;
    });
  }

  /** The box of shapes [from, to). */
  boxOfShapes(from: number, to: number): Box {
    const { data } = this.coordOffsets;
    return boxOfPoints(this.coords.data, data[from], data[to]);
  }

  boxOfLast(): Box {
    return this.boxOfShapes(this.shapeCount - 1, this.shapeCount);
  }

  /** The box of the curves themselves; `boxOfShapes` gives that of their control points. */
  extent(): Box {
    return curveBoxOf({ verbs: this.verbs.view(), coords: this.coords.data }, IDENTITY);
  }

  /** As `extent`, without what lies outside the boxes of the clips. */
  private clippedExtent(): Box {
    let extent = EMPTY_BOX;
    for (let shape = 0; shape < this.shapeCount; shape++) {
      const verbs = this.verbs.data.subarray(this.verbOffsets.data[shape], this.verbOffsets.data[shape + 1]);
      const coords = this.coords.data.subarray(this.coordOffsets.data[shape]);
      let box = curveBoxOf({ verbs, coords }, IDENTITY);
      for (let clip = this.clip.data[shape]; clip >= 0; clip = this.clips[clip].parent)
        box = intersectBoxes(box, boxOfPoints(this.clips[clip].coords));
      if (!isEmptyBox(box)) extent = uniteBoxes(extent, box);
    }
    return extent;
  }

  /** For files without a page: the page is the drawing's extent. */
  finishAround(): ReadDrawing {
    const extent = this.clips.length === 0 ? this.extent() : this.clippedExtent();
    if (isEmptyBox(extent)) return this.finish(SMALLEST_SIDE, SMALLEST_SIDE);
    const { x0, y0, x1, y1 } = extent;
    this.translate(-x0, -y0);
    this.warnings.translate(-x0, -y0);
    return this.finish(Math.max(x1 - x0, SMALLEST_SIDE), Math.max(y1 - y0, SMALLEST_SIDE), "extent");
  }

  private translate(dx: number, dy: number): void {
    // Clips may share their coordinates.
    const clipCoords = new Set(this.clips.map((clip) => clip.coords));
    for (const coords of [this.coords.data.subarray(0, this.coords.length), ...clipCoords]) {
      for (let i = 0; i < coords.length; i += 2) {
        coords[i] += dx;
        coords[i + 1] += dy;
      }
    }
  }

  finish(widthMm: number, heightMm: number, pageFrom?: Drawing["pageFrom"]): ReadDrawing {
    const count = this.shapeCount;
    if (count === 0) this.warnings.add("empty-drawing");
    return {
      widthMm,
      heightMm,
      ...(pageFrom === undefined ? {} : { pageFrom }),
      groups: this.groups,
      colors: this.colors,
      dashes: this.dashes,
      clips: this.clips,
      paths: {
        count,
        verbs: this.verbs.view(),
        coords: this.coords.data.subarray(0, this.coords.length),
        verbOffsets: this.verbOffsets.view(),
        coordOffsets: this.coordOffsets.view(),
        group: this.group.view(),
        stroke: this.stroke.view(),
        fill: this.fill.view(),
        fillRule: this.fillRule.view(),
        strokeWidth: this.strokeWidth.view(),
        dash: this.dash.view(),
        clip: this.clip.view(),
        ...(this.speedFactors.size === 0 ? {} : { speedFactor: this.speedFactorsOf(count) }),
      },
      warnings: this.warnings.toArray(),
    };
  }

  private speedFactorsOf(count: number): Float64Array {
    const factors = new Float64Array(count).fill(1);
    for (const [shape, factor] of this.speedFactors) factors[shape] = factor;
    return factors;
  }

  private reserveCoords(count: number): void {
    const { coords, progress } = this;
    if (coords.length + count <= coords.data.length) return;
    if (coords.length + count > MAX_COORDS) {
      throw new PlotwrightError(
        "bad-file",
        `The drawing has more than ${MAX_COORDS / 2_000_000} million points. Simplify it, or plot it in parts.`,
      );
    }
    const expected =
      progress < MIN_SHARE_TO_ESTIMATE ? 0 : (MARGIN * coords.length) / progress - coords.length;
    coords.reserve(Math.ceil(Math.min(MAX_COORDS - coords.length, Math.max(count, expected)) / 2));
  }

  private colorOf(color: string | null): number {
    return color === null ? -1 : getOrAdd(this.colorIndex, color, () => this.colors.push(color) - 1);
  }

  private dashOf(dash: DashPattern | null): number {
    if (dash === null) return -1;
    return getOrAdd(this.dashIndex, JSON.stringify(dash), () => this.dashes.push(dash) - 1);
  }
}

/** An infinite or NaN width would make everything computed from it infinite or NaN. */
const finiteWidth = (mm: number): number => (mm >= 0 ? Math.min(mm, MAX_COORDINATE_MM) : 0);

/** Writes the mapped pairs into `to` from `at` on. Returns false if one is beyond `max` or NaN. */
function writeMapped(source: PointBuffer, map: Affine, to: Float64Array, at: number, max: number): boolean {
  const from = source.data;
  const { a, b, c, d, e, f } = map;
  let inRange = true;
  for (let i = 0; i < source.length; i += 2) {
    const x = a * from[i] + c * from[i + 1] + e;
    const y = b * from[i] + d * from[i + 1] + f;
    to[at++] = x;
    to[at++] = y;
    // This form counts NaN as out of range.
    if (!(Math.abs(x) <= max && Math.abs(y) <= max)) inRange = false;
  }
  return inRange;
}
