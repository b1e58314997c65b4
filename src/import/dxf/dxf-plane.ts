/**
 * The plane of an entity that is given in its own coordinates (AutoCAD DXF reference, Object Coordinate Systems), seen
 * from above: it may be mirrored or tilted.
 */
import { applyX, applyY, IDENTITY, type Affine } from "../../geometry/affine.js";
import { numberIn, pointIn, type DxfGroup } from "./dxf-groups.js";

type Vector = readonly [x: number, y: number, z: number];

const UP: Vector = [0, 0, 1];
/** Normals that are this close to the z axis have an x axis that is across it and the world's y axis. */
const STEEP = 1 / 64;

export const cross = ([ax, ay, az]: Vector, [bx, by, bz]: Vector): Vector => [
  ay * bz - az * by,
  az * bx - ax * bz,
  ax * by - ay * bx,
];
const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

function unit(vector: Vector): Vector {
  const length = Math.hypot(...vector);
  return length > 0 ? [vector[0] / length, vector[1] / length, vector[2] / length] : UP;
}

/** The vector with this code; 0 for numbers that are missing. */
export const vectorIn = (groups: readonly DxfGroup[], code: number): Vector => [
  numberIn(groups, code) ?? 0,
  numberIn(groups, code + 10) ?? 0,
  numberIn(groups, code + 20) ?? 0,
];

/** The direction that the plane faces, of length 1. */
export const normalOf = (groups: readonly DxfGroup[]): Vector => unit(vectorIn(groups, 210));

/** The directions of the plane's x and y axes. */
function axesOf(normal: Vector): readonly [x: Vector, y: Vector] {
  const isSteep = Math.abs(normal[0]) < STEEP && Math.abs(normal[1]) < STEEP;
  const x = unit(cross(isSteep ? [0, 1, 0] : UP, normal));
  return [x, unit(cross(normal, x))];
}

/** Maps the plane's coordinates to the world's. */
export function planeOf(groups: readonly DxfGroup[]): Affine {
  const normal = normalOf(groups);
  if (normal[0] === 0 && normal[1] === 0 && normal[2] > 0) return IDENTITY;
  const [x, y] = axesOf(normal);
  const height = numberIn(groups, 38) ?? numberIn(groups, 30) ?? 0;
  return { a: x[0], b: x[1], c: y[0], d: y[1], e: height * normal[0], f: height * normal[1] };
}

/** The same for an entity whose place is given in the world's coordinates, and only its letters lie in the plane. */
export function planeAtPlace(groups: readonly DxfGroup[]): Affine {
  const plane = planeOf(groups);
  const { x, y } = pointIn(groups, 10) ?? { x: 0, y: 0 };
  const still = { ...plane, e: 0, f: 0 };
  return { ...plane, e: x - applyX(still, x, y), f: y - applyY(still, x, y) };
}

/** The angle of a direction of the world in the plane, rad. */
export function angleInPlane(groups: readonly DxfGroup[], direction: Vector): number {
  const [x, y] = axesOf(normalOf(groups));
  return Math.atan2(dot(direction, y), dot(direction, x));
}
