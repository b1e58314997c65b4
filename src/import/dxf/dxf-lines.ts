/** Linetypes as dashes, and lines without an end. */
import type { DashPattern } from "../../drawing/drawing.js";
import type { Box } from "../../geometry/box.js";

/**
 * The dashes of a linetype: positive lengths are drawn, negative ones are gaps, 0 is a dot. Null for a solid
 * line. The result begins with a dash, wherever the linetype begins.
 */
export function dashesOf(elements: readonly number[], scale: number): DashPattern | null {
  const isDash = (i: number): boolean => elements[(i + elements.length) % elements.length] >= 0;
  const first = elements.findIndex((_, i) => isDash(i) && !isDash(i - 1));
  if (first < 0 || !(scale > 0)) return null;
  const lengths: number[] = [];
  let offset = 0;
  for (let k = 0; k < elements.length; k++) {
    const i = (first + k) % elements.length;
    const length = Math.abs(elements[i]) * scale;
    if (i >= first) offset += length;
    if (k > 0 && isDash(i) === isDash(i - 1)) lengths[lengths.length - 1] += length;
    else lengths.push(length);
  }
  const total = lengths.reduce((sum, length) => sum + length, 0);
  if (!(total > 0 && Number.isFinite(total))) return null;
  return { lengths, offset: first === 0 ? 0 : offset };
}

/**
 * The part inside the box of a line from (x, y) along (dx, dy), or in both directions; null if there is none
 * (Liang and Barsky 1984).
 */
export function endlessWithin(
  box: Box,
  x: number,
  y: number,
  dx: number,
  dy: number,
  isBothWays: boolean,
): readonly [number, number, number, number] | null {
  let [from, to] = [isBothWays ? -Infinity : 0, Infinity];
  for (const [at, along, low, high] of [
    [x, dx, box.x0, box.x1],
    [y, dy, box.y0, box.y1],
  ]) {
    if (along === 0) {
      if (!(at >= low && at <= high)) return null;
      continue;
    }
    const [a, b] = [(low - at) / along, (high - at) / along];
    from = Math.max(from, Math.min(a, b));
    to = Math.min(to, Math.max(a, b));
  }
  if (!(from < to && Number.isFinite(from) && Number.isFinite(to))) return null;
  return [x + from * dx, y + from * dy, x + to * dx, y + to * dy];
}
