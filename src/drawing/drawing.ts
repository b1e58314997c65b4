/**
 * What a file says, in mm on its own page: before any fitting, flattening or ordering.
 *
 * Frame "page": mm, origin top left, x right, y down.
 * Curves stay cubic here, because they are flattened to a tolerance in mm only after
 * they have been scaled to the paper (prepare). Dashes and clips stay descriptions for
 * the same reason.
 *
 * Memory: columns, no object per path or point, so a 100 MB file stays affordable.
 */

/** Segment verbs in `DrawingPaths.verbs`, and how many coordinate pairs each takes. */
export const VERB_MOVE = 0; // 1 pair: where a subpath begins
export const VERB_LINE = 1; // 1 pair: its end
export const VERB_CUBIC = 2; // 3 pairs: two controls and the end
export const VERB_CLOSE = 3; // 0 pairs: straight back to the subpath's start
export const PAIRS_OF_VERB: readonly number[] = [1, 1, 3, 0];

/** Fill rules in `DrawingPaths.fillRule` and `ClipRegion.rule`. */
export const RULE_NONZERO = 0;
export const RULE_EVENODD = 1;

/**
 * All the file's painted shapes, in paint order (first is painted first, lies lowest).
 * Shape i has verbs [verbOffsets[i], verbOffsets[i+1]) and coords [coordOffsets[i], coordOffsets[i+1])
 * (offsets into the number arrays themselves). A shape may hold several subpaths, each begun by VERB_MOVE.
 */
export interface DrawingPaths {
  readonly count: number;
  readonly verbs: Uint8Array;
  /** mm, x then y. Always finite. */
  readonly coords: Float64Array;
  readonly verbOffsets: Uint32Array;
  readonly coordOffsets: Uint32Array;
  /** Index into `Drawing.groups`. */
  readonly group: Uint32Array;
  /** Index into `Drawing.colors`; −1 where the shape has no stroke (filled only). */
  readonly stroke: Int32Array;
  /** Index into `Drawing.colors`; −1 where it has no fill. */
  readonly fill: Int32Array;
  readonly fillRule: Uint8Array;
  /** mm on the page. */
  readonly strokeWidth: Float32Array;
  /** Index into `Drawing.dashes`; −1 for a solid line. */
  readonly dash: Int32Array;
  /** Index into `Drawing.clips`; −1 where nothing clips it. */
  readonly clip: Int32Array;
}

/** A layer of the file: a top-level group (one single outer group is looked through). */
export interface DrawingGroup {
  /** Stable within the file: its id, or a generated one. */
  readonly id: string;
  /** inkscape:label, else data-name, else id, else "Layer N". Plain text from the file: never HTML. */
  readonly name: string;
  /** Hidden in the file (display:none on the group): kept out of the paths, but listed with a warning. */
  readonly hidden: boolean;
}

/** SVG stroke-dasharray and offset, in mm on the page. Even number of lengths, sum > 0. */
export interface DashPattern {
  readonly lengths: readonly number[];
  readonly offset: number;
  /**
   * For a shape that was stretched with its dashes: a way dx, dy on the page is as long as (a dx + c dy, b dx + d dy).
   * Absent where it is as long as it looks.
   */
  readonly measure?: LinearMap;
}

export interface LinearMap {
  readonly a: number;
  readonly b: number;
  readonly c: number;
  readonly d: number;
}

/** The union of its shapes under `rule`, intersected with its parent (index into clips, −1 none). */
export interface ClipRegion {
  readonly verbs: Uint8Array;
  readonly coords: Float64Array;
  /** One rule for each subpath, in order of VERB_MOVE: RULE_NONZERO or RULE_EVENODD. */
  readonly rule: Uint8Array;
  /**
   * For each subpath the shape that it belongs to, 0, 0, 1 …: subpaths of one shape are filled together
   * under their rule, then the shapes are united. Absent: all subpaths of one rule are one shape.
   */
  readonly shape?: Uint32Array;
  readonly parent: number;
}

/** Something that is in the file and will not be drawn as the eye sees it on screen. */
export interface DrawingWarning {
  /** Stable kebab-case code, for example "text-not-drawn". */
  readonly code: string;
  /** What, how many, and what to do about it. Plain text. */
  readonly message: string;
  readonly count: number;
  /** Where the first few are: boxes x0, y0, x1, y1 in page mm (may be empty). */
  readonly boxes: readonly (readonly [number, number, number, number])[];
}

export interface Drawing {
  readonly widthMm: number;
  readonly heightMm: number;
  readonly groups: readonly DrawingGroup[];
  /** "#rrggbb", lower case, distinct, in order of first use. */
  readonly colors: readonly string[];
  readonly dashes: readonly DashPattern[];
  readonly clips: readonly ClipRegion[];
  readonly paths: DrawingPaths;
  readonly warnings: readonly DrawingWarning[];
}
