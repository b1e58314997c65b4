import type { StrokeSet } from "../../src/index.js";

/** A square, a circle and a zigzag, 12 mm wide: shows heights, corners and whether the lines meet. */
export function testPatch(): StrokeSet {
  const square = [0, 0, 12, 0, 12, 12, 0, 12, 0, 0];
  const circle = Array.from({ length: 61 }, (_, i) => {
    const angle = (i / 60) * 2 * Math.PI;
    return [6 + 4 * Math.cos(angle), 6 + 4 * Math.sin(angle)];
  }).flat();
  const zigzag = [2, 14, 4, 17, 6, 14, 8, 17, 10, 14];
  const lines = [square, circle, zigzag];
  const offsets = new Uint32Array(lines.length + 1);
  lines.forEach((line, i) => (offsets[i + 1] = offsets[i] + line.length / 2));
  return {
    xy: Float64Array.from(lines.flat()),
    offsets,
    layer: new Uint16Array(lines.length),
    layers: [{ id: "test", name: "Test patch", color: null }],
  };
}
