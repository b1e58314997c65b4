/** What may be another in each of many shapes that are drawn alike: where a shape is, and what it is called. */
export const OUTLINE_ATTRIBUTES: ReadonlySet<string> = new Set(
  "id d points x y width height cx cy r rx ry x1 y1 x2 y2".split(" "),
);
