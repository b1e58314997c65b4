/**
 * The line that a swinging pen would draw, as pieces coloured by their distance from the planned line: a piece's two
 * values are its errors. Samples are about 1 ms apart. Samples within CHORD_MM of a straight piece are left out, so
 * that a long drawing takes little memory. One pass, linear in samples.
 */
import type { StrokeSet, Trajectory } from "../../src/index.js";
import { penError, type PenError, type PenPoint, type Springs } from "../../src/internal.js";
import { LAYER_SHORT, PIECE_BYTES, PIECE_FLOATS, PIECE_SHORTS, VALUE_SHORT, type Pieces } from "./pieces.js";
import { shiftsOf } from "./scene.js";

const CHORD_MM = 0.003;
/** Max. change of the error within a piece, which has one colour at each end. */
const ERROR_STEP_MM = 0.01;
/** Initial capacity. */
const FIRST_PIECES = 4_096;
/** Min. end of the scale: errors smaller than a pen's tip are not visible. */
const MIN_TOP_MM = 0.05;

export interface SwingPicture {
  readonly pieces: Pieces;
  readonly error: PenError;
  /**
   * The error at the end of the colour scale. It is smaller for 99 % of the time, so one bad corner does not set the
   * scale.
   */
  readonly topMm: number;
}

/** `progress` is called after each sample with the finished share of the plot. */
export const swingPicture = (
  strokes: StrokeSet,
  trajectory: Trajectory,
  springs: Springs,
  progress: (share: number) => void = () => undefined,
): SwingPicture => {
  const writer = new SwingWriter(strokes);
  const dots = dotsOf(trajectory);
  const error = penError(strokes, trajectory, springs, (pen, mm) => {
    while (dots.length > 0 && dots[dots.length - 1].tS <= pen.tS) writer.addDot(dots.pop() as Dot);
    writer.add(pen, mm);
    progress(pen.tS / trajectory.totalS);
  });
  for (const dot of dots.reverse()) writer.addDot(dot);
  writer.endPiece();
  const topMm = scaleTop(error.p99Mm);
  return { pieces: writer.pieces(topMm), error, topMm };
};

/** Rounds up to the next of 1, 1.5, 2, 3, 5, 7, 10 times a power of ten. */
export const scaleTop = (mm: number): number => {
  if (!(mm > MIN_TOP_MM)) return MIN_TOP_MM;
  const unit = 10 ** Math.floor(Math.log10(mm));
  const digit = [1, 1.5, 2, 3, 5, 7, 10].find((one) => mm <= one * unit * (1 + 1e-9)) ?? 10;
  return Number((digit * unit).toPrecision(3));
};

interface Dot {
  readonly tS: number;
  readonly stroke: number;
}

/** Strokes without motion, where the pen only goes down and up, last first. */
const dotsOf = ({ runs }: Trajectory): Dot[] => {
  const dots: Dot[] = [];
  for (let run = runs.count - 1; run >= 0; run--) {
    const isStill = runs.firstBlock[run] === runs.firstBlock[run + 1];
    if (runs.stroke[run] >= 0 && isStill) dots.push({ tS: runs.startS[run], stroke: runs.stroke[run] });
  }
  return dots;
};

class SwingWriter {
  private readonly shifts: ReturnType<typeof shiftsOf>;
  private bytes = new ArrayBuffer(FIRST_PIECES * PIECE_BYTES);
  private floats = new Float32Array(this.bytes);
  private shorts = new Uint16Array(this.bytes);
  private errors = new Float32Array(2 * FIRST_PIECES);
  private count = 0;
  /** The open piece: where and when it begins, and the range of angles that it may have. */
  private isOpen = false;
  private stroke = -1;
  private x0 = 0;
  private y0 = 0;
  private t0 = 0;
  private mm0 = 0;
  private mainAngle = 0;
  private lowAngle = -Infinity;
  private highAngle = Infinity;
  private furthest = 0;
  /** The last sample. */
  private x = 0;
  private y = 0;
  private t = 0;
  private mm = 0;

  constructor(private readonly strokes: StrokeSet) {
    this.shifts = shiftsOf(strokes.layers);
  }

  /** `mm`: the distance from the planned line. */
  add({ tS, x, y, stroke }: PenPoint, mm: number): void {
    if (stroke !== this.stroke) {
      this.endPiece();
      this.stroke = stroke;
      // A stroke begins where the pen was when it came down.
      if (stroke >= 0) {
        this.mm = mm;
        this.begin();
      }
    }
    if (stroke >= 0 && !this.fits(x, y, mm)) {
      this.endPiece();
      this.begin();
      this.fits(x, y, mm);
    }
    this.x = x;
    this.y = y;
    this.t = tS;
    this.mm = mm;
  }

  addDot({ tS, stroke }: Dot): void {
    this.endPiece();
    this.stroke = -1;
    const { xy, offsets } = this.strokes;
    const first = 2 * offsets[stroke];
    this.write(stroke, [xy[first], xy[first + 1], xy[first], xy[first + 1], tS, tS], 0, 0);
  }

  endPiece(): void {
    if (!this.isOpen) return;
    this.isOpen = false;
    const ends = [this.x0, this.y0, this.x, this.y, this.t0, this.t];
    this.write(this.stroke, ends, this.mm0, this.mm);
  }

  pieces(topMm: number): Pieces {
    for (let i = 0; i < this.count; i++) {
      for (const end of [0, 1]) {
        const share = Math.min(1, this.errors[2 * i + end] / topMm);
        this.shorts[i * PIECE_SHORTS + VALUE_SHORT + end] = 65_535 * share;
      }
    }
    return { count: this.count, bytes: this.bytes.slice(0, this.count * PIECE_BYTES) };
  }

  private begin(): void {
    this.isOpen = true;
    this.x0 = this.x;
    this.y0 = this.y;
    this.t0 = this.t;
    this.mm0 = this.mm;
    this.lowAngle = -Infinity;
    this.highAngle = Infinity;
    this.furthest = 0;
  }

  /** Whether a straight piece to (x, y) stays within CHORD_MM of all its samples. */
  private fits(x: number, y: number, mm: number): boolean {
    if (Math.abs(mm - this.mm0) > ERROR_STEP_MM && this.furthest > 0) return false;
    const dx = x - this.x0;
    const dy = y - this.y0;
    const distance = Math.sqrt(dx * dx + dy * dy);
    if (distance < this.furthest - CHORD_MM) return false;
    this.furthest = Math.max(this.furthest, distance);
    if (distance <= CHORD_MM) return true;
    const width = Math.asin(CHORD_MM / distance);
    if (this.lowAngle === -Infinity) this.mainAngle = Math.atan2(dy, dx);
    const angle = turned(Math.atan2(dy, dx) - this.mainAngle);
    if (angle < this.lowAngle || angle > this.highAngle) return false;
    this.lowAngle = Math.max(this.lowAngle, angle - width);
    this.highAngle = Math.min(this.highAngle, angle + width);
    return true;
  }

  private write(stroke: number, ends: readonly number[], mm0: number, mm1: number): void {
    if (2 * this.count === this.errors.length) this.grow();
    const layer = this.strokes.layer[stroke];
    const { x, y } = this.shifts?.[layer] ?? { x: 0, y: 0 };
    const [x0, y0, x1, y1, t0, t1] = ends;
    const at = this.count++;
    this.floats.set([x0 - x, y0 - y, x1 - x, y1 - y, t0, t1], at * PIECE_FLOATS);
    this.shorts[at * PIECE_SHORTS + LAYER_SHORT] = layer;
    this.errors[2 * at] = mm0;
    this.errors[2 * at + 1] = mm1;
  }

  private grow(): void {
    const bytes = new ArrayBuffer(2 * this.bytes.byteLength);
    new Uint8Array(bytes).set(new Uint8Array(this.bytes));
    this.bytes = bytes;
    this.floats = new Float32Array(bytes);
    this.shorts = new Uint16Array(bytes);
    const errors = new Float32Array(2 * this.errors.length);
    errors.set(this.errors);
    this.errors = errors;
  }
}

/** An angle between −π and π. */
const turned = (angle: number): number => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
