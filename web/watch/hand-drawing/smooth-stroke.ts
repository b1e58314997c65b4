/**
 * Smooths a stroke while it is drawn by hand. First the one euro filter takes out the trembling: a low-pass filter whose
 * cutoff rises with the speed, so that slow lines are steady and fast ones keep up with the pointer. Then the filtered
 * points become a curve: a parabola from the middle of each pair of points to the middle of the next pair.
 * (G. Casiez, N. Roussel, D. Vogel, "1 € Filter: A Simple Speed-based Low-pass Filter for Noisy Input", CHI 2012)
 *
 * What has been put out is never changed later, because the pen may have drawn it.
 */

/** Cutoff for a pointer at rest, Hz: with the least smoothing, and with the most. */
const CUTOFF_HZ = [8, 0.8] as const;
/** How much the cutoff rises with the speed, Hz per px/s: the same. */
const CUTOFF_RISE = [0.02, 0.004] as const;
/** Cutoff of the filter for the speed, Hz. */
const SPEED_CUTOFF_HZ = 1;
/** Points with the same time are taken to be this far apart, s. */
const LEAST_S = 0.001;
/** A filtered point nearer than this to the one before it is left out, mm. */
const LEAST_MM = 0.05;
/** How far the straight pieces of a curve may be from it, mm. */
const FLATNESS_MM = 0.02;

interface Spot {
  readonly x: number;
  readonly y: number;
}

export class SmoothStroke {
  /** The last point as it came in. */
  private raw: Spot | null = null;
  private rawMs = 0;
  private filtered: Spot = { x: 0, y: 0 };
  private speedPx = 0;
  /** The last filtered point of the curve. */
  private control: Spot = { x: 0, y: 0 };
  /** Where the curve ends so far. */
  private end: Spot = { x: 0, y: 0 };

  /** `level`: 0 (as it was drawn) … 1. `draw` gets the smoothed stroke, point by point, mm. */
  constructor(
    private readonly level: number,
    private readonly pxPerMm: number,
    private readonly draw: (xMm: number, yMm: number) => void,
  ) {}

  add(x: number, y: number, atMs: number): void {
    const { raw, rawMs } = this;
    this.raw = { x, y };
    this.rawMs = atMs;
    if (!raw) {
      this.filtered = this.control = this.end = this.raw;
      return this.draw(x, y);
    }
    if (this.level === 0) return this.draw(x, y);
    this.filter(raw, Math.max(LEAST_S, (atMs - rawMs) / 1_000));
    const { filtered, control } = this;
    if (Math.hypot(filtered.x - control.x, filtered.y - control.y) < LEAST_MM) return;
    this.curveTo({ x: (control.x + filtered.x) / 2, y: (control.y + filtered.y) / 2 });
    this.control = filtered;
  }

  /** The stroke is complete: the curve goes on to where the pointer was last. */
  finish(): void {
    if (this.raw && this.level > 0) this.curveTo(this.raw);
  }

  private filter(before: Spot, s: number): void {
    const { raw, level, pxPerMm } = this;
    if (!raw) return;
    const speedPx = (Math.hypot(raw.x - before.x, raw.y - before.y) * pxPerMm) / s;
    this.speedPx += share(SPEED_CUTOFF_HZ, s) * (speedPx - this.speedPx);
    const restHz = CUTOFF_HZ[0] * (CUTOFF_HZ[1] / CUTOFF_HZ[0]) ** level;
    const rise = CUTOFF_RISE[0] + level * (CUTOFF_RISE[1] - CUTOFF_RISE[0]);
    const part = share(restHz + rise * this.speedPx, s);
    const { x, y } = this.filtered;
    this.filtered = { x: x + part * (raw.x - x), y: y + part * (raw.y - y) };
  }

  /** A parabola from the end of the curve, with the last filtered point as its control point. */
  private curveTo(to: Spot): void {
    const { end: from, control } = this;
    this.end = to;
    const bendMm = Math.hypot(from.x - 2 * control.x + to.x, from.y - 2 * control.y + to.y);
    const pieces = Math.max(1, Math.ceil(Math.sqrt(bendMm / (4 * FLATNESS_MM))));
    for (let k = 1; k <= pieces; k++) {
      const t = k / pieces;
      const [a, b, c] = [(1 - t) ** 2, 2 * t * (1 - t), t ** 2];
      this.draw(a * from.x + b * control.x + c * to.x, a * from.y + b * control.y + c * to.y);
    }
  }
}

/** The share of a new value in a low-pass filter, `s` after the one before it. */
const share = (cutoffHz: number, s: number): number => 1 / (1 + 1 / (2 * Math.PI * cutoffHz * s));
