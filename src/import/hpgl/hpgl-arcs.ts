/** The arcs, circles and wedges of HPGL (AA AR AT RT CI EW WG), which begin at the pen's position or are about it. */
import { RAD_PER_DEG } from "../../units.js";
import type { HpglCanvas } from "./hpgl-canvas.js";
import type { HpglFrame } from "./hpgl-frame.js";
import {
  arcAbout,
  arcThrough,
  chordAngle,
  drawArc,
  drawCircle,
  drawWedge,
  sweepOf,
  TURN,
  type HpglArc,
} from "./hpgl-shapes.js";

export class HpglArcs {
  /** CT: chords are given by their distance from the arc instead of their angle. */
  areChordsDeviations = false;

  constructor(
    private readonly frame: HpglFrame,
    private readonly canvas: HpglCanvas,
  ) {}

  drawAboutCentre([cx, cy, sweepDeg, chord]: readonly number[], isRelative: boolean): void {
    const [x, y] = this.here;
    const arc = isRelative ? arcAbout(x + cx, y + cy, x, y, sweepDeg) : arcAbout(cx, cy, x, y, sweepDeg);
    this.draw(arc, chord);
  }

  drawThroughPoint([mx, my, ex, ey, chord]: readonly number[], isRelative: boolean): void {
    const [x, y] = this.here;
    const [fromX, fromY] = isRelative ? [x, y] : [0, 0];
    const arc = arcThrough(x, y, fromX + mx, fromY + my, fromX + ex, fromY + ey);
    if (arc !== null) this.draw(arc, chord);
    else this.canvas.goTo(...this.frame.onPaper(fromX + ex, fromY + ey));
  }

  drawCircle(radius: number, chord: number | undefined): void {
    const [x, y] = this.here;
    const angle = this.chordAngle(chord, radius);
    const circle = { x, y, radius, start: 0, sweep: TURN };
    if (radius !== 0) this.canvas.drawClosed((shape) => drawCircle(shape, circle, angle, this.frame));
  }

  /** Makes a sector the polygon. Its tip is the pen's position. */
  setWedge([radius, startDeg, sweepDeg, chord]: readonly number[]): void {
    const [x, y] = this.here;
    const angle = this.chordAngle(chord, radius);
    const arc = { x, y, radius, start: startDeg * RAD_PER_DEG, sweep: sweepOf(sweepDeg) };
    this.canvas.setPolygon((rings) => {
      if (radius !== 0) drawWedge(rings, arc, angle, this.frame);
    });
  }

  private draw(arc: HpglArc, chord: number | undefined): void {
    const angle = this.chordAngle(chord, arc.radius);
    if (arc.radius > 0) this.canvas.draw((shape) => drawArc(shape, arc, angle, this.frame));
  }

  private chordAngle(chord: number | undefined, radius: number): number {
    return chordAngle(chord, radius, this.areChordsDeviations);
  }

  /** The pen's position in user units. */
  private get here(): [x: number, y: number] {
    return this.frame.inUserUnits(this.canvas.x, this.canvas.y);
  }
}
