/**
 * Fills an area with parallel lines one pen width apart.
 *
 *    ┌─────────────┐    The area first shrinks by half a pen width, so that ink ends at the shape's edge.
 *    │╱╱╱╱╱╱╱╱╱╱╱╱╱│    Lines are at multiples of the spacing from the paper's corner, so that the
 *    │╱╱╱╱╱╱╱╱╱╱╱╱╱│    hatches of neighbouring shapes line up.
 *    └─────────────┘
 *
 * Method: rotate the rings so that hatch lines are horizontal. Intersect every edge with the levels that it crosses, and
 * sort the crossings of each level. Draw from the first to the second, from the third to the fourth, and so on: the rings
 * do not cross each other, so inside and outside alternate. Neighbouring lines whose ends are close are drawn back and
 * forth without lifting the pen.
 *
 * Symbols: u along the lines, v across, both mm; level n is v = n · spacing.
 */
import type { Paths64 } from "clipper2-ts/dist/Core.js";
import { ClipperOffset, EndType, JoinType } from "clipper2-ts/dist/Offset.js";
import { firstWhere } from "../../geometry/binary-search.js";
import { LineBuilder } from "../../geometry/polyline.js";
import { SCALE, heaps, regionContains, regionOf, type Region } from "../../geometry/region.js";
import type { HatchSettings } from "../../settings/prepare.js";
import { getOrAdd } from "../../get-or-add.js";

/** Min spacing, mm: no pen is finer, and smaller spacings would need too much memory. */
const FINEST_SPACING = 0.05;
/** Neighbouring lines are linked if their ends are closer than this many spacings. */
const LONGEST_LINK = 2;
/**
 * Links are checked this much further inside, mm, because directly on a straight border rounding would decide whether a
 * point is inside.
 */
const HAIR = 1e-3;
/** Sharp corners of the inset are cut off at this multiple of the width. */
const MITER_LIMIT = 2;

/** Adds the hatch of `area` to `builder` under `tag`. */
export function hatchArea(area: Region, hatch: HatchSettings, tag: number, builder: LineBuilder): void {
  if (!(hatch.spacingMm > 0)) return;
  const spacing = Math.max(hatch.spacingMm, FINEST_SPACING);
  const inner = inset(area.rings, spacing / 2);
  if (inner.rings.length === 0) return;
  const angle = (hatch.angleDeg * Math.PI) / 180;
  hatchDirection(inner, spacing, angle, tag, builder);
  if (hatch.cross) hatchDirection(inner, spacing, angle + Math.PI / 2, tag, builder);
}

/** Shrinks the area by this width, mm. */
function inset(rings: Paths64, width: number): Region {
  const inner: Paths64 = [];
  for (const heap of heaps(rings)) {
    // Clipper.inflatePaths does the same, but adds the whole library to the page's worker bundle.
    const offset = new ClipperOffset(MITER_LIMIT);
    offset.addPaths(heap, JoinType.Miter, EndType.Polygon);
    const shrunk: Paths64 = [];
    offset.execute(-width * SCALE, shrunk);
    for (const ring of shrunk) inner.push(ring);
  }
  return regionOf(inner);
}

function hatchDirection(
  area: Region,
  spacing: number,
  angle: number,
  tag: number,
  builder: LineBuilder,
): void {
  const cos = Math.cos(angle);
  const sin = Math.sin(angle);
  const levels = crossings(area.rings, spacing, cos, sin);
  const writer = new HatchWriter(area, spacing, cos, sin, tag, builder);
  for (const n of [...levels.keys()].sort((a, b) => a - b)) {
    const us = (levels.get(n) as number[]).sort((a, b) => a - b);
    writer.level(n, us);
  }
  writer.finish();
}

/**
 * For each level, the u values where ring edges cross it. A vertex on a level belongs only to the edge below the level,
 * so it is not counted twice.
 */
function crossings(rings: Paths64, spacing: number, cos: number, sin: number): Map<number, number[]> {
  const levels = new Map<number, number[]>();
  for (const ring of rings) {
    for (let k = 0, j = ring.length - 1; k < ring.length; j = k++) {
      const u0 = (ring[j].x * cos + ring[j].y * sin) / SCALE;
      const v0 = (ring[j].y * cos - ring[j].x * sin) / SCALE;
      const u1 = (ring[k].x * cos + ring[k].y * sin) / SCALE;
      const v1 = (ring[k].y * cos - ring[k].x * sin) / SCALE;
      const first = Math.ceil(Math.min(v0, v1) / spacing);
      const end = Math.ceil(Math.max(v0, v1) / spacing);
      for (let n = first; n < end; n++) {
        const u = u0 + ((n * spacing - v0) / (v1 - v0)) * (u1 - u0);
        getOrAdd(levels, n, () => []).push(u);
      }
    }
  }
  return levels;
}

interface Chain {
  readonly points: number[];
  level: number;
}

/** Where a chain ends, and its place among the chains of its level. */
interface ChainEnd {
  readonly chain: Chain;
  readonly k: number;
  readonly end: number;
}

/** Links lines of neighbouring levels into zigzags if the link is inside the area. */
class HatchWriter {
  private open: Chain[] = [];

  constructor(
    private readonly area: Region,
    private readonly spacing: number,
    private readonly cos: number,
    private readonly sin: number,
    private readonly tag: number,
    private readonly builder: LineBuilder,
  ) {}

  level(n: number, us: readonly number[]): void {
    const v = n * this.spacing;
    const before = this.open;
    const byEnd = before.map((chain, k) => ({ chain, k, end: chain.points[chain.points.length - 2] }));
    byEnd.sort((a, b) => a.end - b.end);
    this.open = [];
    for (let k = 0; k + 1 < us.length; k += 2) {
      if (!(us[k + 1] > us[k])) continue;
      const chain = this.chainFor(byEnd, n, us[k], us[k + 1], v);
      this.open.push(chain);
    }
    for (const chain of before) if (chain.level !== n) this.write(chain);
  }

  finish(): void {
    for (const chain of this.open) this.write(chain);
    this.open = [];
  }

  /** The chain of the previous level that can continue along this line, or a new one. */
  private chainFor(byEnd: readonly ChainEnd[], n: number, u0: number, u1: number, v: number): Chain {
    let best: Chain | null = null;
    let bestGap = LONGEST_LINK * this.spacing;
    let backwards = false;
    const candidates = [u0, u1].flatMap((u) =>
      this.endsNear(byEnd, u, bestGap).map((end) => ({ ...end, u })),
    );
    candidates.sort((a, b) => a.k - b.k);
    for (const { chain, end, u } of candidates) {
      if (chain.level !== n - 1) continue;
      const gap = Math.hypot(end - u, this.spacing);
      const inward = u === u0 ? HAIR : -HAIR;
      if (gap < bestGap && this.isInside(end + inward, v - this.spacing, u + inward, v)) {
        best = chain;
        bestGap = gap;
        backwards = u === u1;
      }
    }
    const line = backwards ? [u1, v, u0, v] : [u0, v, u1, v];
    if (best === null) return { points: line, level: n };
    best.points.push(...line);
    best.level = n;
    return best;
  }

  private endsNear(byEnd: readonly ChainEnd[], u: number, gap: number): ChainEnd[] {
    const near: ChainEnd[] = [];
    const first = firstWhere(0, byEnd.length, (k) => byEnd[k].end > u - gap);
    for (let k = first; k < byEnd.length && byEnd[k].end < u + gap; k++) near.push(byEnd[k]);
    return near;
  }

  /** Whether a short link is inside the area, checked at three points. */
  private isInside(u0: number, v0: number, u1: number, v1: number): boolean {
    return [0.25, 0.5, 0.75].every((t) => {
      const u = u0 + t * (u1 - u0);
      const v = v0 + t * (v1 - v0);
      return regionContains(this.area, u * this.cos - v * this.sin, u * this.sin + v * this.cos);
    });
  }

  private write(chain: Chain): void {
    const { points } = chain;
    for (let k = 0; k < points.length; k += 2) {
      const u = points[k];
      const v = points[k + 1];
      this.builder.point(u * this.cos - v * this.sin, u * this.sin + v * this.cos);
    }
    this.builder.end(this.tag);
  }
}
