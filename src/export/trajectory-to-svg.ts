/**
 * Draws a plan as SVG: the pen's path coloured by speed, with a legend in mm/s below the paper.
 *
 * Blocks are sampled so finely that a piece neither spans a whole speed band nor deviates from the curve by
 * more than SAGITTA. Consecutive pieces of one band become one path, which keeps the file small.
 */
import { rampColor } from "../drawing/color-ramp.js";
import type { PaperSize } from "../drawing/paper.js";
import { blockState, newMotionState, type Trajectory } from "../plan/trajectory.js";
import { mmText, svgOpening } from "./svg-text.js";
import { clamp } from "../geometry/polyline.js";

const SPEED_BAND_COUNT = 24;
/** Max gap between a curved block and its line segments, mm. */
const SAGITTA = 0.01;
const MAX_PIECES = 200;
const LEGEND_HEIGHT = 14;
const PEN_WIDTH = 0.3;

/** SVG text of a planned drawing on paper as placed, mm. Pen-up moves are thin grey lines. */
export function trajectoryToSvg(trajectory: Trajectory, { widthMm, heightMm }: PaperSize): string {
  const top = topSpeed(trajectory);
  const bands: string[][] = Array.from({ length: SPEED_BAND_COUNT }, () => []);
  const travel: string[] = [];
  const { runs } = trajectory;
  for (let run = 0; run < runs.count; run++) {
    if (runs.stroke[run] < 0) travel.push(pathOfRun(trajectory, run));
    else addRun(trajectory, run, top, bands);
  }
  const parts = [svgOpening(widthMm, heightMm + LEGEND_HEIGHT)];
  parts.push(
    `<rect width="${mmText(widthMm)}" height="${mmText(heightMm)}" fill="#ffffff" stroke="#bbbbbb" stroke-width="0.2"/>\n`,
  );
  parts.push(
    `<path class="travel" fill="none" stroke="#9aa0a6" stroke-width="0.1" d="${travel.join("")}"/>\n`,
    `<g fill="none" stroke-width="${PEN_WIDTH}" stroke-linecap="round" stroke-linejoin="round">\n`,
  );
  bands.forEach((paths, band) => {
    if (paths.length > 0) {
      parts.push(`<path data-band="${band}" stroke="${bandColor(band)}" d="${paths.join("")}"/>\n`);
    }
  });
  parts.push("</g>\n", legend(widthMm, heightMm, top), "</svg>\n");
  return parts.join("");
}

/** Max speed with the pen down, mm/s: the upper end of the colour scale. */
function topSpeed(trajectory: Trajectory): number {
  const { runs } = trajectory;
  const state = newMotionState();
  let top = 0;
  for (let run = 0; run < runs.count; run++) {
    if (runs.stroke[run] < 0) continue;
    for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1]; k++) {
      const pieces = piecesOf(trajectory, k, Infinity);
      for (let i = 0; i <= pieces; i++) {
        blockState(trajectory, k, (trajectory.durationS[k] * i) / pieces, state);
        top = Math.max(top, Math.hypot(state.vx, state.vy));
      }
    }
  }
  return top;
}

/** The number of equal time steps to split a block into. The gap of a chord over a time h is |a| h²/8. */
function piecesOf(trajectory: Trajectory, k: number, bandWidth: number): number {
  const t = trajectory.durationS[k];
  const jerkX = trajectory.jx ? trajectory.jx[k] : 0;
  const jerkY = trajectory.jy ? trajectory.jy[k] : 0;
  const a = Math.hypot(trajectory.ax[k], trajectory.ay[k]) + Math.hypot(jerkX, jerkY) * t;
  const forShape = t * Math.sqrt(a / (8 * SAGITTA));
  const forSpeed = (a * t) / bandWidth;
  const isStraight = jerkX === 0 && jerkY === 0 && isAlong(trajectory, k);
  return clamp(Math.ceil(Math.max(isStraight ? 0 : forShape, 2 * forSpeed)), 1, MAX_PIECES);
}

/** True if a block's acceleration is along its velocity: it only speeds up or slows down. */
function isAlong(trajectory: Trajectory, k: number): boolean {
  const { vx, vy, ax, ay } = trajectory;
  const cross = Math.abs(vx[k] * ay[k] - vy[k] * ax[k]);
  return cross <= 1e-6 * Math.hypot(vx[k], vy[k]) * Math.hypot(ax[k], ay[k]);
}

function addRun(trajectory: Trajectory, run: number, top: number, bands: string[][]): void {
  const state = newMotionState();
  let band = -1;
  let path = "";
  const flush = (): void => {
    if (band >= 0 && path !== "") bands[band].push(path);
  };
  const { firstBlock } = trajectory.runs;
  for (let k = firstBlock[run]; k < firstBlock[run + 1]; k++) {
    const pieces = piecesOf(trajectory, k, top / SPEED_BAND_COUNT);
    const t = trajectory.durationS[k] / pieces;
    for (let i = 0; i < pieces; i++) {
      blockState(trajectory, k, (i + 0.5) * t, state);
      const share = top > 0 ? Math.hypot(state.vx, state.vy) / top : 0;
      const next = Math.min(Math.floor(share * SPEED_BAND_COUNT), SPEED_BAND_COUNT - 1);
      if (next !== band) {
        flush();
        band = next;
        blockState(trajectory, k, i * t, state);
        path = `M${mmText(state.x)} ${mmText(state.y)}`;
      }
      blockState(trajectory, k, (i + 1) * t, state);
      path += `L${mmText(state.x)} ${mmText(state.y)}`;
    }
  }
  flush();
}

function pathOfRun(trajectory: Trajectory, run: number): string {
  const state = newMotionState();
  const { firstBlock } = trajectory.runs;
  let path = "";
  for (let k = firstBlock[run]; k < firstBlock[run + 1]; k++) {
    if (path === "") path = `M${mmText(trajectory.x[k])} ${mmText(trajectory.y[k])}`;
    const pieces = piecesOf(trajectory, k, Infinity);
    for (let i = 1; i <= pieces; i++) {
      blockState(trajectory, k, (trajectory.durationS[k] * i) / pieces, state);
      path += `L${mmText(state.x)} ${mmText(state.y)}`;
    }
  }
  return path;
}

/** A bar of the speed bands below the paper, labelled with speeds. */
function legend(widthMm: number, heightMm: number, top: number): string {
  const width = Math.max(widthMm - 20, 40);
  const x0 = Math.max((widthMm - width) / 2, 0);
  const y = heightMm + 3;
  const step = width / SPEED_BAND_COUNT;
  const parts = [`<g class="legend" font-family="sans-serif" font-size="3.5" fill="#333333">\n`];
  for (let band = 0; band < SPEED_BAND_COUNT; band++) {
    parts.push(
      `<rect x="${mmText(x0 + band * step)}" y="${mmText(y)}" width="${mmText(step)}" height="4" fill="${bandColor(band)}"/>\n`,
    );
  }
  const marks = 4;
  for (let k = 0; k <= marks; k++) {
    const speed = (top * k) / marks;
    const label = `${speed < 10 ? speed.toFixed(1) : Math.round(speed)}${k === marks ? " mm/s" : ""}`;
    const anchor = k === 0 ? "start" : k === marks ? "end" : "middle";
    parts.push(
      `<text x="${mmText(x0 + (width * k) / marks)}" y="${mmText(y + 8)}" text-anchor="${anchor}">${label}</text>\n`,
    );
  }
  parts.push("</g>\n");
  return parts.join("");
}

/** "#rrggbb" of a speed band, 0 (slowest) to SPEED_BAND_COUNT − 1. */
function bandColor(band: number): string {
  return rampColor(band / (SPEED_BAND_COUNT - 1));
}
