/**
 * How Grbl performs an arc (G2, G3): as straight moves, so many that each is within its arc tolerance ($12). Written from
 * the description of mc_arc in motion_control.c.
 */
import type { Axes } from "./planner.js";

/** An arc in the plane of X and Y, from where the previous move ended. */
export interface Arc {
  /** Its centre, from its start, mm. */
  readonly i: number;
  readonly j: number;
  readonly clockwise: boolean;
}

/** `$12` of a Grbl that nobody has changed. */
export const ARC_TOLERANCE_MM = 0.002;
/**
 * With a larger `$12` an arc strays too far: Grbl rounds the number of moves down, so that a short arc may become one move,
 * whose middle is up to four times the tolerance beside the arc. With 0 each arc becomes one.
 */
const MAX_ARC_TOLERANCE_MM = 0.005;

/** Whether arcs of a Grbl with that `$12` are true enough to draw with. */
export const isArcTrue = (toleranceMm: number): boolean =>
  toleranceMm > 0 && toleranceMm <= MAX_ARC_TOLERANCE_MM;
/** An arc that turns by less than this is a full circle, rad. */
const NO_TURN = 5e-7;

/** The angle by which an arc turns, rad; negative if it is clockwise. A full circle if it ends where it begins. */
export function sweepOf({ i, j, clockwise }: Arc, from: Axes, to: Axes): number {
  const [endX, endY] = [to[0] - from[0] - i, to[1] - from[1] - j];
  const turn = Math.atan2(j * endX - i * endY, -i * endX - j * endY);
  if (clockwise) return turn >= -NO_TURN ? turn - 2 * Math.PI : turn;
  return turn <= NO_TURN ? turn + 2 * Math.PI : turn;
}

/** The ends of the straight moves; the last one is `to`. Z moves evenly. */
export function cutArc(arc: Arc, from: Axes, to: Axes, toleranceMm: number): Axes[] {
  const radius = Math.hypot(arc.i, arc.j);
  const sweep = sweepOf(arc, from, to);
  const chord2 = toleranceMm * (2 * radius - toleranceMm);
  const count = chord2 > 0 ? Math.floor((Math.abs(sweep) * radius) / 2 / Math.sqrt(chord2)) : 1;
  const ends: Axes[] = [];
  for (let k = 1; k < count; k++) {
    const share = k / count;
    const [cos, sin] = [Math.cos(share * sweep), Math.sin(share * sweep)];
    ends.push([
      from[0] + arc.i - arc.i * cos + arc.j * sin,
      from[1] + arc.j - arc.i * sin - arc.j * cos,
      from[2] + share * (to[2] - from[2]),
    ]);
  }
  ends.push(to);
  return ends;
}

/** The points of an arc, between its ends, at which X or Y is lowest or highest. */
export function extremesOf(arc: Arc, from: Axes, to: Axes): Axes[] {
  const [centreX, centreY, radius] = [from[0] + arc.i, from[1] + arc.j, Math.hypot(arc.i, arc.j)];
  const sweep = Math.abs(sweepOf(arc, from, to));
  const sides: Axes[] = [
    [centreX + radius, centreY, 0],
    [centreX, centreY + radius, 0],
    [centreX - radius, centreY, 0],
    [centreX, centreY - radius, 0],
  ];
  return sides.filter((side) => Math.abs(sweepOf(arc, from, side)) < sweep);
}
