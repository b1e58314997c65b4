/**
 * Only straight lines and sharp corners: nested triangles, each corner a fixed fraction along the side before
 * it, tiled so that the spirals meet.
 */
import { PAGE_HEIGHT_MM, PAGE_WIDTH_MM, polygon, samplePage, type Point } from "./svg.js";

const SIDE_MM = 50;
const STEP = 0.075;
const ROUNDS = 20;

function whirl(corners: readonly Point[]): string[] {
  const paths: string[] = [];
  let current = corners;
  for (let round = 0; round < ROUNDS; round++) {
    paths.push(polygon(current));
    const from = current;
    current = from.map(([x, y], i): Point => {
      const [nextX, nextY] = from[(i + 1) % from.length] ?? [x, y];
      return [x + (nextX - x) * STEP, y + (nextY - y) * STEP];
    });
  }
  return paths;
}

/** Rows of triangles that together fill a hexagon. */
export function whirlTriangles(): string {
  const height = (SIDE_MM * Math.sqrt(3)) / 2;
  const top = PAGE_HEIGHT_MM / 2 - 2 * height;
  const paths: string[] = [];
  for (const [row, columns] of [5, 7, 7, 5].entries()) {
    const left = (PAGE_WIDTH_MM - ((columns + 1) * SIDE_MM) / 2) / 2;
    for (let column = 0; column < columns; column++) {
      const x = left + (column * SIDE_MM) / 2;
      const y = top + row * height;
      const pointsUp = (column + (row < 2 ? 0 : 1)) % 2 === 0;
      const base = pointsUp ? y + height : y;
      const corners: Point[] = [
        [x, base],
        [x + SIDE_MM, base],
        [x + SIDE_MM / 2, pointsUp ? y : y + height],
      ];
      // Neighbours turn opposite ways, so their spirals join along the common side.
      paths.push(...whirl(corners));
    }
  }
  return samplePage("Whirling triangles", [{ name: "Triangles", color: "#222222", paths }], 0.35);
}
