/**
 * `--preview OUT.svg`: the paper with the motion on it, true size. Lines are coloured by the pen's speed,
 * from blue (slow) to yellow (the fastest of this plot); travel is thin and grey.
 */
import type { Prepared, Trajectory } from "../../src/index.js";

/** Slow to fast; every step is lighter than the one before, so it reads in grey too. */
const RAMP = ["#30289e", "#4747c4", "#3d72d6", "#2a98c9", "#23b39f", "#57c765", "#a6d13c", "#f2d42e"];
/** Length of the straight pieces that a block is drawn in, mm: its curve and its speed are seen so fine. */
const PIECE_MM = 1;
const MOST_PIECES = 64;

export function previewSvg(trajectory: Trajectory, prepared: Prepared): string {
  const { paperWidthMm: width, paperHeightMm: height } = prepared;
  const top = Math.max(topDrawSpeed(trajectory), 1e-9);
  const travel: string[] = [];
  const drawn = RAMP.map((): string[] => []);
  forEachBlock(trajectory, (block, isDraw) => {
    const pieces = isDraw ? pieceCount(trajectory, block) : 1;
    for (let piece = 0; piece < pieces; piece++) {
      const [from, to] = [piece / pieces, (piece + 1) / pieces];
      const speed = speedAt(trajectory, block, (from + to) / 2);
      const bin = Math.min(RAMP.length - 1, Math.floor((speed / top) * RAMP.length));
      const line = `M${placeAt(trajectory, block, from)}L${placeAt(trajectory, block, to)}`;
      (isDraw ? drawn[bin] : travel)?.push(line);
    }
  });
  const paths = drawn.map((lines, bin) => `<path stroke="${RAMP[bin]}" d="${lines.join("")}"/>`);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}mm" height="${height}mm" viewBox="0 0 ${width} ${height}">
<rect width="100%" height="100%" fill="#fff"/>
<g fill="none" stroke-width="0.3" stroke-linecap="round">
<path stroke="#b8b8b8" stroke-width="0.1" d="${travel.join("")}"/>
${paths.join("\n")}
</g>
</svg>
`;
}

function forEachBlock(trajectory: Trajectory, visit: (block: number, isDraw: boolean) => void): void {
  const { count, firstBlock, stroke } = trajectory.runs;
  for (let run = 0; run < count; run++) {
    for (let block = firstBlock[run]!; block < firstBlock[run + 1]!; block++) visit(block, stroke[run]! >= 0);
  }
}

function topDrawSpeed(trajectory: Trajectory): number {
  let top = 0;
  forEachBlock(trajectory, (block, isDraw) => {
    if (!isDraw) return;
    for (const part of [0, 0.5, 1]) top = Math.max(top, speedAt(trajectory, block, part));
  });
  return top;
}

function pieceCount(trajectory: Trajectory, block: number): number {
  const lengthMm = speedAt(trajectory, block, 0.5) * trajectory.durationS[block]!;
  return Math.max(1, Math.min(MOST_PIECES, Math.ceil(lengthMm / PIECE_MM)));
}

/** At a part 0 … 1 of the block's time. */
function speedAt(trajectory: Trajectory, block: number, part: number): number {
  const t = part * trajectory.durationS[block]!;
  const { vx, vy, ax, ay, jx, jy } = trajectory;
  const x = vx[block]! + ax[block]! * t + ((jx?.[block] ?? 0) * t * t) / 2;
  const y = vy[block]! + ay[block]! * t + ((jy?.[block] ?? 0) * t * t) / 2;
  return Math.hypot(x, y);
}

function placeAt(trajectory: Trajectory, block: number, part: number): string {
  const t = part * trajectory.durationS[block]!;
  const { x, y, vx, vy, ax, ay, jx, jy } = trajectory;
  const along = (p: number, v: number, a: number, j: number): string =>
    (p + v * t + (a * t * t) / 2 + (j * t * t * t) / 6).toFixed(3).replace(/\.?0+$/, "");
  return `${along(x[block]!, vx[block]!, ax[block]!, jx?.[block] ?? 0)} ${along(y[block]!, vy[block]!, ay[block]!, jy?.[block] ?? 0)}`;
}
