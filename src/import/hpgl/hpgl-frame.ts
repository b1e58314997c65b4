/**
 * Coordinates of HPGL: user units, scaled by SC to the rectangle between P1 and P2, which IP sets, and turned by RO.
 *
 *   user units ──SC, P1, P2──> plotter units ──RO──> plotter units on the paper: 0.025 mm, y up
 */
import { applyX, applyY, compose, IDENTITY, type Affine, inverse, rotation } from "../../geometry/affine.js";

/** P1 and P2 until IP sets them, and the page of IR, in plotter units. */
const USUAL_CORNERS: readonly number[] = [0, 0, 10_000, 10_000];
const ISOTROPIC = 1;
const BY_FACTORS = 2;

export class HpglFrame {
  /** P1 and P2: x, y, x, y. */
  corners = USUAL_CORNERS;
  private areCornersGiven = false;
  /** User units to plotter units on the paper. */
  map: Affine = IDENTITY;
  /** Plotter units per user unit in x and y; negative if mirrored. */
  scales: readonly [x: number, y: number] = [1, 1];
  private scaling: readonly number[] = [];
  /** Quarter turns anticlockwise. */
  private turns = 0;

  /** IN */
  reset(): void {
    this.turns = 0;
    this.setCorners([]);
    this.setScaling([]);
  }

  /** IP. With one corner the other one follows it; without any they are at their usual places. */
  setCorners(numbers: readonly number[]): void {
    this.areCornersGiven = numbers.length >= 2;
    const [x, y, farX, farY] = numbers;
    const [x1, y1, x2, y2] = this.corners;
    if (numbers.length < 2) this.corners = USUAL_CORNERS;
    else this.corners = numbers.length < 4 ? [x, y, x + x2 - x1, y + y2 - y1] : [x, y, farX, farY];
    this.update();
  }

  /** IR: percent of the page. */
  setRelativeCorners(percent: readonly number[]): void {
    const [, , pageX, pageY] = USUAL_CORNERS;
    this.setCorners(percent.map((share, i) => (share / 100) * (i % 2 === 0 ? pageX : pageY)));
    this.areCornersGiven = false;
  }

  /** SC. Returns false for numbers that give no scale; plotter units are used then. */
  setScaling(numbers: readonly number[]): boolean {
    this.scaling = numbers.length < 4 ? [] : numbers;
    return this.update();
  }

  /** RO. Returns false for other angles than quarter turns. */
  setRotation(deg: number): boolean {
    if (deg % 90 !== 0) return false;
    this.turns = (((deg / 90) % 4) + 4) % 4;
    this.update();
    return true;
  }

  /** Whether the scale depends on the plotter's page: SC without an IP that places P1 and P2. */
  get isGuessed(): boolean {
    return this.scaling.length > 0 && this.scaling[4] !== BY_FACTORS && !this.areCornersGiven;
  }

  /** The angle by which the x axis is turned, rad. */
  get angle(): number {
    return (this.turns * Math.PI) / 2;
  }

  /** Distance between P1 and P2 in x and y. */
  get spans(): readonly [x: number, y: number] {
    const [x1, y1, x2, y2] = this.corners;
    return [x2 - x1, y2 - y1];
  }

  get diagonal(): number {
    return Math.hypot(...this.spans);
  }

  /** A point on the paper. */
  onPaper(x: number, y: number): [x: number, y: number] {
    return [applyX(this.map, x, y), applyY(this.map, x, y)];
  }

  /** A vector on the paper. */
  vectorOnPaper(x: number, y: number): [x: number, y: number] {
    return [this.map.a * x + this.map.c * y, this.map.b * x + this.map.d * y];
  }

  /** A point of the paper in user units. */
  inUserUnits(x: number, y: number): [x: number, y: number] {
    const back = inverse(this.map);
    return [applyX(back, x, y), applyY(back, x, y)];
  }

  private update(): boolean {
    const given = this.scaledMap();
    const isUsable =
      Math.abs(given.a * given.d) > 0 && Number.isFinite(given.a * given.d + given.e + given.f);
    const scaled = isUsable ? given : IDENTITY;
    this.scales = [scaled.a, scaled.d];
    this.map = compose(rotation(this.angle), scaled);
    return isUsable;
  }

  private scaledMap(): Affine {
    if (this.scaling.length === 0) return IDENTITY;
    const [x0, x1, y0, y1, type = 0, left = 50, bottom = 50] = this.scaling;
    const [p1x, p1y] = this.corners;
    const [spanX, spanY] = this.spans;
    let scaleX = type === BY_FACTORS ? x1 : spanX / (x1 - x0);
    let scaleY = type === BY_FACTORS ? y1 : spanY / (y1 - y0);
    let restX = 0;
    let restY = 0;
    if (type === ISOTROPIC) {
      // The same scale for both; the rest of the longer side is divided between its two ends.
      const scale = Math.min(Math.abs(scaleX), Math.abs(scaleY));
      scaleX = Math.sign(scaleX) * scale;
      scaleY = Math.sign(scaleY) * scale;
      restX = ((spanX - scaleX * (x1 - x0)) * left) / 100;
      restY = ((spanY - scaleY * (y1 - y0)) * bottom) / 100;
    }
    return {
      a: scaleX,
      b: 0,
      c: 0,
      d: scaleY,
      e: p1x + restX - x0 * scaleX,
      f: p1y + restY - y0 * scaleY,
    };
  }
}
