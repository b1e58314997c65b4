/** How far our shapes are from resvg's. */
import { expect } from "vitest";
import { VERB_CLOSE, VERB_CUBIC, VERB_MOVE, type Drawing } from "../../../src/drawing/drawing.js";
import { flattenCubic } from "../../../src/geometry/cubic.js";
import { PointBuffer } from "../../../src/geometry/growable.js";
import { importSvg } from "../../../src/import/svg/import-svg.js";
import { MM_PER_PX } from "../../../src/units.js";
import { farthest, resvgShapes, type Polyline } from "./resvg-shapes.js";

export function ourShapes({ paths }: Drawing): Polyline[][] {
  const c = paths.coords;
  return Array.from({ length: paths.count }, (_, i) => {
    const lines: Polyline[] = [];
    let line: Polyline = [];
    let at = paths.coordOffsets[i];
    const add = (x: number, y: number): void => {
      line.push([x / MM_PER_PX, y / MM_PER_PX]);
    };
    for (let v = paths.verbOffsets[i]; v < paths.verbOffsets[i + 1]; v++) {
      const verb = paths.verbs[v];
      if (verb === VERB_CLOSE) line.push(line[0]);
      else if (verb === VERB_CUBIC) {
        const out = new PointBuffer();
        flattenCubic(
          out,
          c[at - 2],
          c[at - 1],
          c[at],
          c[at + 1],
          c[at + 2],
          c[at + 3],
          c[at + 4],
          c[at + 5],
          1e-3,
        );
        for (let k = 0; k < out.length; k += 2) add(out.data[k], out.data[k + 1]);
        at += 6;
      } else {
        if (verb === VERB_MOVE) lines.push((line = []));
        add(c[at], c[at + 1]);
        at += 2;
      }
    }
    return lines;
  });
}

/** Max distance, in both directions, shape by shape, as a fraction of the page. */
export async function disagreement(svg: string): Promise<number> {
  const theirs = resvgShapes(svg);
  const ours = ourShapes(await importSvg(svg));
  expect(ours.length).toBe(theirs.shapes.length);
  const side = Math.max(theirs.width, theirs.height);
  return Math.max(
    0,
    ...ours.map(
      (lines, i) => Math.max(farthest(lines, theirs.shapes[i]), farthest(theirs.shapes[i], lines)) / side,
    ),
  );
}
