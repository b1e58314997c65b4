/**
 * Finds the piece under the pointer by a grid over the pieces, which is built once in the worker, in linear time.
 *
 *   cell c holds items[starts[c]] … items[starts[c + 1] − 1]
 *
 * A piece is sampled in steps of half a cell, and is listed in every cell that has a sample. Cells whose corners lie
 * between two samples are missed, so the search looks one cell further than its radius.
 */
import { nearestShare } from "../../src/internal.js";
import { boxOfPieces, PIECE_FLOATS, type Pieces } from "./pieces.js";

export interface PickGrid {
  readonly x0: number;
  readonly y0: number;
  readonly cellMm: number;
  readonly columns: number;
  readonly rows: number;
  readonly starts: Uint32Array;
  readonly items: Uint32Array;
}

interface Picked {
  readonly piece: number;
  /** Share of the piece before the nearest point, 0 … 1. */
  readonly share: number;
  readonly distanceMm: number;
}

const PIECES_A_CELL = 4;
const MAX_CELLS = 1_000_000;

export const buildPickGrid = ({ count, bytes }: Pieces): PickGrid => {
  const floats = new Float32Array(bytes);
  const box = count > 0 ? boxOfPieces(floats, 0, count) : { x0: 0, y0: 0, x1: 0, y1: 0 };
  const width = Math.max(1e-3, box.x1 - box.x0);
  const height = Math.max(1e-3, box.y1 - box.y0);
  const wanted = Math.min(MAX_CELLS, Math.max(1, count / PIECES_A_CELL));
  const cellMm = Math.max(Math.sqrt((width * height) / wanted), Math.max(width, height) / MAX_CELLS, 0.2);
  const columns = Math.floor(width / cellMm) + 1;
  const rows = Math.floor(height / cellMm) + 1;
  const shape = { x0: box.x0, y0: box.y0, cellMm, columns, rows };

  const starts = new Uint32Array(columns * rows + 1);
  walkCells(floats, count, shape, (cell) => {
    starts[cell + 1]++;
  });
  for (let c = 0; c < columns * rows; c++) starts[c + 1] += starts[c];
  const items = new Uint32Array(starts[columns * rows]);
  const fill = starts.slice(0, columns * rows);
  walkCells(floats, count, shape, (cell, piece) => {
    items[fill[cell]++] = piece;
  });
  return { ...shape, starts, items };
};

/** The piece nearest to (x, y) mm within `reachMm`. Of equally near ones, the one drawn last. */
export const nearestPiece = (
  grid: PickGrid,
  { bytes }: Pieces,
  x: number,
  y: number,
  reachMm: number,
): Picked | null => {
  const floats = new Float32Array(bytes);
  const column = (mm: number): number => Math.floor((mm - grid.x0) / grid.cellMm);
  const row = (mm: number): number => Math.floor((mm - grid.y0) / grid.cellMm);
  const c0 = Math.max(0, column(x - reachMm) - 1);
  const c1 = Math.min(grid.columns - 1, column(x + reachMm) + 1);
  const r0 = Math.max(0, row(y - reachMm) - 1);
  const r1 = Math.min(grid.rows - 1, row(y + reachMm) + 1);
  let best: Picked | null = null;
  for (let r = r0; r <= r1; r++) {
    for (let k = grid.starts[r * grid.columns + c0]; k < grid.starts[r * grid.columns + c1 + 1]; k++) {
      const piece = grid.items[k];
      const found = distanceTo(floats, piece, x, y);
      const isNearer = !best || found.distanceMm < best.distanceMm - 1e-6;
      const isLater = best && found.distanceMm <= best.distanceMm && piece > best.piece;
      if (found.distanceMm <= reachMm && (isNearer || isLater)) best = found;
    }
  }
  return best;
};

const distanceTo = (floats: Float32Array, piece: number, x: number, y: number): Picked => {
  const f = piece * PIECE_FLOATS;
  const x0 = floats[f];
  const y0 = floats[f + 1];
  const x1 = floats[f + 2];
  const y1 = floats[f + 3];
  const share = nearestShare(x0, y0, x1, y1, x, y);
  const distanceMm = Math.hypot(x - x0 - share * (x1 - x0), y - y0 - share * (y1 - y0));
  return { piece, share, distanceMm };
};

type GridShape = Pick<PickGrid, "x0" | "y0" | "cellMm" | "columns" | "rows">;

const walkCells = (
  floats: Float32Array,
  count: number,
  { x0, y0, cellMm, columns, rows }: GridShape,
  visit: (cell: number, piece: number) => void,
): void => {
  for (let i = 0; i < count; i++) {
    const f = i * PIECE_FLOATS;
    const ax = floats[f];
    const ay = floats[f + 1];
    const dx = floats[f + 2] - ax;
    const dy = floats[f + 3] - ay;
    const steps = Math.max(1, Math.ceil((2 * Math.max(Math.abs(dx), Math.abs(dy))) / cellMm));
    let last = -1;
    for (let k = 0; k <= steps; k++) {
      const c = Math.min(columns - 1, Math.floor((ax + (dx * k) / steps - x0) / cellMm));
      const r = Math.min(rows - 1, Math.floor((ay + (dy * k) / steps - y0) / cellMm));
      const cell = r * columns + c;
      if (cell !== last) visit(cell, i);
      last = cell;
    }
  }
};

/**
 * The mean distance between neighbouring lines, mm: the area of all grid cells that contain a line, divided by the
 * length drawn. Empty paper does not count.
 */
export const lineGapMm = ({ cellMm, starts }: PickGrid, drawMm: number): number => {
  let filled = 0;
  for (let c = 0; c + 1 < starts.length; c++) if (starts[c + 1] > starts[c]) filled++;
  return (filled * cellMm * cellMm) / Math.max(1e-6, drawMm);
};
