/** Splits dashed lines into their dashes. */
import { mappedDash, type DashPattern } from "../../drawing/drawing.js";
import { PlotwrightError } from "../../errors.js";
import { insideRange, type Box } from "../../geometry/box.js";
import type { Affine } from "../../geometry/affine.js";
import { LineBuilder, SAME_POINT_MM, lineCount, mix, type Lines } from "../../geometry/polyline.js";

/** A pattern with a shorter period than this is drawn as a solid line, because no pen resolves it, mm. */
const FINEST_PERIOD = 0.05;
/** Dashes and gaps of a drawing. This many would take days to plot. */
const MAX_STEPS = 2_000_000;

/**
 * Splits every line whose tag has a pattern (lengths in mm on paper). Dots and other lines are copied. Dashes outside
 * `box` are skipped, since a very long line would have too many. Throws `too-large` if there are too many inside.
 */
export function dashLines(lines: Lines, patternOf: (tag: number) => DashPattern | null, box: Box): Lines {
  const builder = new LineBuilder();
  const steps = new StepCount();
  for (let i = 0; i < lineCount(lines); i++) {
    const pattern = patternOf(lines.tag[i]);
    const isDot = lines.offsets[i + 1] - lines.offsets[i] < 2;
    if (pattern === null || isDot) builder.copy(lines, i, lines.tag[i]);
    else new Dasher(pattern, lines.tag[i], builder, steps).run(lines, i, box);
  }
  return builder.finish();
}

/**
 * The pattern on the paper; null if it is too fine there. `map` maps the file's page to the paper, without distortion.
 */
export function patternOnPaper(dash: DashPattern, map: Affine): DashPattern | null {
  const pattern = mappedDash(dash, map);
  return periodOf(pattern) < FINEST_PERIOD ? null : pattern;
}

const periodOf = (pattern: DashPattern): number => pattern.lengths.reduce((sum, length) => sum + length, 0);

/** Counts the dashes and gaps of all lines. */
class StepCount {
  private count = 0;

  add(more: number): void {
    this.count += more;
    if (this.count <= MAX_STEPS) return;
    throw new PlotwrightError(
      "too-large",
      `The dashed lines of this drawing have more than ${MAX_STEPS / 2e6} million dashes. Make the dashes longer or the lines solid, or plot the drawing in parts.`,
    );
  }
}

class Dasher {
  private index = 0;
  /** Remainder of the current dash or gap, mm. */
  private left = 0;
  private readonly period: number;

  constructor(
    private readonly pattern: DashPattern,
    private readonly tag: number,
    private readonly builder: LineBuilder,
    private readonly steps: StepCount,
  ) {
    this.period = periodOf(pattern);
    this.setPhase(pattern.offset);
  }

  private get isDrawing(): boolean {
    return this.index % 2 === 0;
  }

  run(lines: Lines, i: number, box: Box): void {
    const { xy, offsets } = lines;
    for (let p = offsets[i] + 1; p < offsets[i + 1]; p++) {
      const x0 = xy[2 * p - 2];
      const y0 = xy[2 * p - 1];
      const x1 = xy[2 * p];
      const y1 = xy[2 * p + 1];
      const length = this.lengthOf(x1 - x0, y1 - y0);
      const range = insideRange(x0, y0, x1, y1, box);
      if (range === null) {
        this.pass(length);
        continue;
      }
      const [enter, leave] = range;
      if (enter > 0) this.pass(enter * length);
      const isEnd = p === offsets[i + 1] - 1 && leave === 1;
      const from = [mix(x0, x1, enter), mix(y0, y1, enter)] as const;
      const to = [mix(x0, x1, leave), mix(y0, y1, leave)] as const;
      this.dash(...from, ...to, (leave - enter) * length, isEnd);
      if (leave < 1) this.pass((1 - leave) * length);
    }
    this.endDash();
  }

  private lengthOf(dx: number, dy: number): number {
    const { measure } = this.pattern;
    if (measure === undefined) return Math.hypot(dx, dy);
    return Math.hypot(measure.a * dx + measure.c * dy, measure.b * dx + measure.d * dy);
  }

  /** Draws the dashes of a segment. `isEnd`: the line ends with it. */
  private dash(x0: number, y0: number, x1: number, y1: number, length: number, isEnd: boolean): void {
    if (this.isDrawing) this.builder.point(x0, y0);
    let along = 0;
    // If the pattern divides the line evenly, a rounding error must not begin another dash at the very end.
    const last = isEnd ? length - SAME_POINT_MM : length;
    while (last - along > this.left) {
      along += this.left;
      // A dash ends or begins here. A dash of zero length becomes a dot.
      this.builder.point(x0 + ((x1 - x0) * along) / length, y0 + ((y1 - y0) * along) / length);
      if (this.isDrawing) this.endDash();
      this.steps.add(1);
      this.index = (this.index + 1) % this.pattern.lengths.length;
      this.left = this.pattern.lengths[this.index];
    }
    this.left -= length - along;
    if (this.isDrawing) this.builder.point(x1, y1);
  }

  /** Advances along the pattern without drawing. */
  private pass(length: number): void {
    this.endDash();
    let into = this.pattern.lengths[this.index] - this.left + length;
    for (let k = 0; k < this.index; k++) into += this.pattern.lengths[k];
    this.setPhase(into);
  }

  private endDash(): void {
    // A dash of which only a rounding error is inside the box, or after the offset, is not a dot.
    const isRemainder = this.builder.openPoints === 1 && this.pattern.lengths[this.index] > SAME_POINT_MM;
    if (this.isDrawing && !isRemainder) this.builder.end(this.tag);
    else this.builder.drop();
  }

  private setPhase(offset: number): void {
    const { lengths } = this.pattern;
    let into = ((offset % this.period) + this.period) % this.period;
    for (this.index = 0; this.index < lengths.length - 1; this.index++) {
      const length = lengths[this.index];
      // A dash of zero length at this position is not drawn yet.
      if (into < length || (into === 0 && length === 0)) break;
      into -= length;
    }
    this.steps.add(this.index);
    this.left = Math.max(lengths[this.index] - into, 0);
  }
}
