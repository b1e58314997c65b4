/**
 * Removes hidden lines: a filled shape covers everything painted before it.
 *
 * Each line is cut by the areas of all later shapes. A tree of boxes (Flatbush) finds the areas that can touch it, so the
 * cost grows with the number of overlaps and not with the square of the drawing. A shape's fill does not hide its own
 * lines.
 */
import Flatbush from "flatbush";
import { LineBuilder, lineBox, lineCount, type Lines } from "../geometry/polyline.js";
import { cutLine } from "../geometry/cut-line.js";
import type { Region } from "../geometry/region.js";
import { stopIfCancelled, type Work } from "./work.js";

/**
 * The tag of each line is its shape; `areas` by shape. A shape with a higher index is painted later. Shapes for which
 * `takesPart` is false (hidden layers) cover nothing, and nothing covers them.
 */
export function hideCovered(
  lines: Lines,
  areas: ReadonlyMap<number, Region>,
  takesPart: (shape: number) => boolean,
  work: Work,
): Lines {
  const shapes = [...areas.keys()].filter(takesPart);
  if (shapes.length === 0) return lines;
  const tree = new Flatbush(shapes.length);
  for (const shape of shapes) {
    const { box } = areas.get(shape) as Region;
    tree.add(box.x0, box.y0, box.x1, box.y1);
  }
  tree.finish();
  const builder = new LineBuilder();
  for (let i = 0; i < lineCount(lines); i++) {
    if ((i & 255) === 0) stopIfCancelled(work);
    if (!takesPart(lines.tag[i])) {
      builder.copy(lines, i, lines.tag[i]);
      continue;
    }
    const box = lineBox(lines, i);
    const above = tree.search(box.x0, box.y0, box.x1, box.y1, (k) => shapes[k] > lines.tag[i]);
    const covers = above.map((k) => areas.get(shapes[k]) as Region);
    addUncovered(lines, i, covers, builder);
  }
  return builder.finish();
}

function addUncovered(lines: Lines, i: number, covers: readonly Region[], builder: LineBuilder): void {
  if (covers.length === 0) return builder.copy(lines, i, lines.tag[i]);
  let pieces = lines;
  let from = i;
  let to = i + 1;
  for (const cover of covers) {
    const next = new LineBuilder();
    for (let k = from; k < to; k++) cutLine(pieces, k, cover, true, next);
    pieces = next.finish();
    from = 0;
    to = lineCount(pieces);
  }
  for (let k = from; k < to; k++) builder.copy(pieces, k, pieces.tag[k]);
}
