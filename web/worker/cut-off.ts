/** The lines that the margins cut off, few enough to be drawn over the paper in every frame. */
import { cutOffLines, type Box } from "../../src/internal.js";

export interface CutOffPicture {
  /** Lines outside this box are cut off, mm. */
  readonly limit: Box;
  /** Lines that are completely outside, and lines that are drawn in part. */
  readonly outsideCount: number;
  readonly partCount: number;
  /** mm x, y, x, y … of line i from `offsets[i]` to `offsets[i + 1]`. If there are very many lines, only every Nth. */
  readonly points: Float32Array;
  readonly offsets: Uint32Array;
}

/** More points would slow down moving the paper. */
const MAX_POINTS = 20_000;

export const cutOffOf = (...given: Parameters<typeof cutOffLines>): CutOffPicture | null => {
  const cut = cutOffLines(...given);
  if (!cut) return null;
  const { limit, lines, outsideCount } = cut;
  const count = lines.offsets.length - 1;
  const nth = Math.ceil(lines.xy.length / 2 / MAX_POINTS);
  const points: number[] = [];
  const offsets = [0];
  for (let i = 0; i < count && points.length < 2 * MAX_POINTS; i += nth) {
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
