/**
 * The contents of a file in mm on its own page, before any fitting, flattening or ordering.
 *
 * Frame "page": mm, origin top left, x right, y down.
 * Curves stay cubic here because the flattening tolerance is in mm on paper: `prepare` flattens them after scaling. For
 * the same reason dashes and clips are only described, not applied.
 *
 * Memory: columns instead of an object per path or point, so that a 100 MB file fits in memory.
 */
import { compose, inverse, meanScale, scaling, type Affine } from "../geometry/affine.js";

/** Segment verbs in `DrawingPaths.verbs`, and how many coordinate pairs each takes. */
export const VERB_MOVE = 0; // 1 pair: the start of a subpath
export const VERB_LINE = 1; // 1 pair: the end point
export const VERB_CUBIC = 2; // 3 pairs: two control points and the end point
export const VERB_CLOSE = 3; // 0 pairs: a line back to the subpath's start
export const PAIRS_OF_VERB: readonly number[] = [1, 1, 3, 0];

/** Fill rules in `DrawingPaths.fillRule` and `ClipRegion.rule`. */
export const RULE_NONZERO = 0;
export const RULE_EVENODD = 1;

/**
 * All painted shapes of the file, in paint order (the first is the lowest).
 * Shape i has verbs [verbOffsets[i], verbOffsets[i+1]) and coords [coordOffsets[i], coordOffsets[i+1])
 * (indices into the arrays themselves). A shape may have several subpaths, each started by VERB_MOVE.
 */
export interface DrawingPaths {
  /** Number of shapes. */
  readonly count: number;
  /** 0 move (1 point), 1 line (1 point), 2 cubic curve (2 control points and the end), 3 close (no point). */
  readonly verbs: Uint8Array;
  /** mm, x then y. Always finite. */
  readonly coords: Float64Array;
  /** count + 1 entries, as for `coordOffsets`. */
  readonly verbOffsets: Uint32Array;
  readonly coordOffsets: Uint32Array;
  /** Index into `Drawing.groups`: the innermost layer. */
  readonly group: Uint32Array;
  /** Index into `Drawing.colors`; −1 if the shape has no stroke (filled only). */
  readonly stroke: Int32Array;
  /** Index into `Drawing.colors`; −1 if it has no fill. */
  readonly fill: Int32Array;
  /** 0 nonzero, 1 even-odd. */
  readonly fillRule: Uint8Array;
  /** mm on the page. */
  readonly strokeWidth: Float32Array;
  /** Index into `Drawing.dashes`; −1 for a solid line. */
  readonly dash: Int32Array;
  /** Index into `Drawing.clips`; −1 if nothing clips it. */
  readonly clip: Int32Array;
  /** Each shape is drawn at this share of the usual speed; left out: 1 for all. */
  readonly speedFactor?: Float64Array | undefined;
  /** 1 for a shape that is only the page's background: it hides what it covers, but is never drawn. Left out: 0 for all. */
  readonly background?: Uint8Array | undefined;
}

export const isBackground = ({ background }: DrawingPaths, shape: number): boolean =>
  background?.[shape] === 1;

/** How fast a shape or stroke is drawn, as a share of the usual speed. */
export const MIN_SPEED_FACTOR = 0.01;

export const isSpeedFactor = (value: unknown): value is number =>
  typeof value === "number" && value >= MIN_SPEED_FACTOR && value <= 1;

/** Whether a shape is filled and can enclose an area: a straight line can't, where a file forgets to give it no fill. */
export function hasFill(paths: DrawingPaths, shape: number): boolean {
  if (paths.fill[shape] < 0 || isBackground(paths, shape)) return false;
  let points = 0;
  for (const verb of curvesOf(paths, shape).verbs) {
    points = (verb === VERB_MOVE ? 0 : points) + PAIRS_OF_VERB[verb];
    if (points > 2) return true;
  }
  return false;
}

/** The curves of one shape or clip. */
export type Curves = Pick<DrawingPaths, "verbs" | "coords">;

export const curvesOf = (paths: DrawingPaths, shape: number): Curves => ({
  verbs: paths.verbs.subarray(paths.verbOffsets[shape], paths.verbOffsets[shape + 1]),
  coords: paths.coords.subarray(paths.coordOffsets[shape], paths.coordOffsets[shape + 1]),
});

/** A layer of the file: a top-level group, or a child of a single outer group; or a sublayer, an Inkscape layer in a layer. */
export interface DrawingGroup {
  /** Stable within the file: the group's id, or a generated one. */
  readonly id: string;
  /** inkscape:label, else serif:id, else data-name, else id, else "Layer N". Plain text from the file: never HTML. */
  readonly name: string;
  /** Hidden in the file (display:none on the group): not in the paths, but listed, with a warning. */
  readonly hidden: boolean;
  /** For a sublayer: the index in `Drawing.groups` of the layer that contains it. It precedes this one. */
  readonly parent?: number;
}

/** SVG stroke-dasharray and offset, in mm on the page. Even number of lengths, sum > 0. */
export interface DashPattern {
  /** Dash, gap, dash, gap … */
  readonly lengths: readonly number[];
  /** Where in the pattern the line begins. */
  readonly offset: number;
  /**
   * For a shape that was stretched together with its dashes. Dashes are then not measured by the length on the page:
   * a vector (dx, dy) on the page counts as long as (a dx + c dy, b dx + d dy).
   */
  readonly measure?: LinearMap;
}

/** (x, y) becomes (a x + c y, b x + d y). */
export interface LinearMap {
  readonly a: number;
  readonly b: number;
  readonly c: number;
  readonly d: number;
}

/** The pattern after a map of its page, without distortion. */
export function mappedDash({ lengths, offset, measure }: DashPattern, map: Affine): DashPattern {
  const scale = meanScale(map);
  const pattern = { lengths: lengths.map((length) => length * scale), offset: offset * scale };
  if (measure === undefined) return pattern;
  // A mapped vector is mapped back to the page and measured there.
  return { ...pattern, measure: compose(compose(scaling(scale), { ...measure, e: 0, f: 0 }), inverse(map)) };
}

/** The union of its shapes under `rule`, intersected with `parent` (index into `Drawing.clips`; −1: none). */
export interface ClipRegion {
  /** As in `DrawingPaths`. */
  readonly verbs: Uint8Array;
  readonly coords: Float64Array;
  /** One rule for each subpath, in order of VERB_MOVE: RULE_NONZERO or RULE_EVENODD. */
  readonly rule: Uint8Array;
  /**
   * By subpath: the shape it belongs to, 0, 0, 1 …. Subpaths of one shape are filled together
   * under their rule, then the shapes are united. Absent: all subpaths with the same rule are one shape.
   */
  readonly shape?: Uint32Array;
  readonly parent: number;
}

/** Something in the file that will not be drawn as it appears on screen. */
export interface DrawingWarning {
  /** Stable kebab-case code, for example "text-not-drawn". */
  readonly code: string;
  /** The feature, how many there are, and what to do about it. Plain text. */
  readonly message: string;
  /** How many there are. */
  readonly count: number;
  /** Positions of the first few: boxes x0, y0, x1, y1 in page mm (may be empty). */
  readonly boxes: readonly (readonly [number, number, number, number])[];
}

/**
 * The content of a file, in mm on its own page: origin top left, x right, y down. Curves are still curves; `prepare`
 * flattens them.
 */
export interface Drawing {
  /** Size of the file's page. */
  readonly widthMm: number;
  readonly heightMm: number;
  /**
   * How the page is known, if the file does not define it. "extent": lengths are true, and the page is the drawing's
   * extent. "proportions": only its proportions are known, from the viewBox of an SVG without a width and height.
   */
  readonly pageFrom?: "extent" | "proportions";
  /** With how many px per inch the file was read, if the size of its page is given in px. */
  readonly pxPerInch?: number;
  /** The file's layers, and their sublayers. */
  readonly groups: readonly DrawingGroup[];
  /** "#rrggbb", lower case, distinct, in order of first use. */
  readonly colors: readonly string[];
  /** Referred to by `paths.dash`. */
  readonly dashes: readonly DashPattern[];
  /** Referred to by `paths.clip`. */
  readonly clips: readonly ClipRegion[];
  /** The shapes, in paint order. */
  readonly paths: DrawingPaths;
  /** One for each feature that is not drawn as it appears on screen. */
  readonly warnings: readonly DrawingWarning[];
}
