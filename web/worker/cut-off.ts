/** What of a drawing the margins cut off, small enough to be drawn over the paper with every frame. */
import { cutOffLines } from "../../src/internal.js";

export interface CutOffPicture {
  /** What lies outside is cut off, mm. */
  readonly limit: { readonly x0: number; readonly y0: number; readonly x1: number; readonly y1: number };
  /** Lines that lie outside entirely, and lines that are drawn in part. */
  readonly outsideCount: number;
  readonly partCount: number;
  /** mm x, y, x, y … of line i from `offsets[i]` to `offsets[i + 1]`; of very many lines only every Nth. */
  readonly points: Float32Array;
  readonly offsets: Uint32Array;
}

/** What is drawn at most: more would be felt when the paper is moved. */
const MOST_POINTS = 20_000;

export const cutOffOf = (...given: Parameters<typeof cutOffLines>): CutOffPicture | null => {
  const cut = cutOffLines(...given);
  if (!cut) return null;
  const { limit, lines, outsideCount } = cut;
  const count = lines.offsets.length - 1;
  const nth = Math.ceil(lines.xy.length / 2 / MOST_POINTS);
  const points: number[] = [];
  const offsets = [0];
  for (let i = 0; i < count && points.length < 2 * MOST_POINTS; i += nth) {
    for (let k = 2 * lines.offsets[i]; k < 2 * lines.offsets[i + 1]; k++) points.push(lines.xy[k]);
    offsets.push(points.length);
  }
  return {
    limit,
    outsideCount,
    partCount: count - outsideCount,
    points: Float32Array.from(points),
    offsets: Uint32Array.from(offsets),
  };
};
