import { applyX, applyY, type Affine } from "../geometry/affine.js";
import { isEmptyBox, type Box } from "../geometry/box.js";

/** The bounding box of a box after a map. */
export function mapBox(map: Affine, box: Box): Box {
  if (isEmptyBox(box)) return box;
  const xs = [
    applyX(map, box.x0, box.y0),
    applyX(map, box.x1, box.y0),
    applyX(map, box.x1, box.y1),
    applyX(map, box.x0, box.y1),
  ];
  const ys = [
    applyY(map, box.x0, box.y0),
    applyY(map, box.x1, box.y0),
    applyY(map, box.x1, box.y1),
    applyY(map, box.x0, box.y1),
  ];
  return { x0: Math.min(...xs), y0: Math.min(...ys), x1: Math.max(...xs), y1: Math.max(...ys) };
}
