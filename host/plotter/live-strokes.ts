/**
 * The strokes of a live drawing: added by a program while the plotter draws them. A stroke is given as a whole, or grows
 * point by point until it is closed.
 *
 *   drawn           waiting (at most WAITING_MAX points, or one stroke)
 *   ───────────────|────────────────────────────·  the end of the last stroke: more may follow while it is open
 */
import {
  PlotwrightError,
  type Line,
  type MachineProfile,
  type StrokePosition,
  type StrokeSet,
} from "../../src/index.js";
import { ColumnBuffer, firstWhere, isReached, mmInWords, pointAt, PointBuffer } from "../../src/internal.js";
import type { JobPlace, LiveUndone } from "../../src/schema/index.js";
import type { PlotPlanner } from "../planning/planning.js";
import { Waiters } from "./waiters.js";

/** Whoever adds points waits while more than this many are not drawn. */
export const WAITING_MAX = 20_000;
/** After so many drawn points the plotter rests, and forgets them. */
const KEPT_MAX = 200_000;
/** Default. */
export const LIFT_AFTER_MS = 300;
/** A longer stroke is planned as if it grew, so that it need not be planned as a whole. */
const WHOLE_MAX = 2_000;
/** A point nearer than this to the one before it is the same point, mm. */
const SAME_POINT_MM = 1e-6;

const LAYER = { id: "live", name: "Live", color: null } as const;

/** Points in drawing order: [x, y] pairs, or x, y, x, y … in a typed array. mm from home. */
export type LivePoints = Line | Float64Array | Float32Array;

/** Is told of each change of the strokes, to store them. */
export interface StrokeRecord {
  /** A stroke begins. */
  begin(x: number, y: number): void;
  add(x: number, y: number): void;
  /** The last points were taken back; the first of them begins a stroke: `withBegin`. */
  takeBack(xy: Float64Array, withBegin: boolean): void;
}

/** How far it reaches. */
type DrawnMachine = Pick<MachineProfile, "name" | "widthMm" | "heightMm">;

/** Plans are made by the running plot (live-feed.ts). */
export const livePlanner = (source: LiveStrokes): PlotPlanner => ({
  get strokes() {
    return source.strokes;
  },
  plan: () => Promise.reject(new TypeError("a live drawing is planned while it is drawn")),
  close: () => Promise.resolve(),
});

export class LiveStrokes {
  /** Counts the changes. */
  version = 0;
  /** The last stroke may get more points. */
  isOpen = false;
  isEnded = false;
  private readonly points = new PointBuffer(1_024);
  /** mm along the stroke at each point. */
  private readonly along = new ColumnBuffer(Float64Array);
  /** First point of each stroke, and the number of points. */
  private readonly offsets = new ColumnBuffer(Uint32Array);
  private readonly grown = new ColumnBuffer(Uint8Array);
  private layer = new Uint16Array(64);
  private view: StrokeSet | null = null;
  private drawnPoints = 0;
  /** Where what is left begins in the whole. */
  private forgotten: StrokePosition = { stroke: 0, alongMm: 0 };
  private isIdle = true;
  private failure: Error | null = null;
  private readonly waiters = new Waiters();
  private readonly listeners: (() => void)[] = [];
  /** The first place of the whole that is not drawn. */
  private drawnUntil: StrokePosition = { stroke: 0, alongMm: 0 };
  /** How many points were forgotten. */
  private forgottenPoints = 0;
  /** Where the pen can stop: asks the running plot, which then stops there. Null: nothing is being drawn yet. */
  private stopForUndo: (() => StrokePosition) | null = null;
  /** Where the strokes are stored. */
  record: StrokeRecord | null = null;

  /** `liftAfterMs`: how long the pen rests on the line when points are late. */
  constructor(
    private readonly machine: DrawnMachine,
    readonly liftAfterMs = LIFT_AFTER_MS,
    private readonly keptMax = KEPT_MAX,
  ) {
    this.offsets.push(0);
  }

  get strokes(): StrokeSet {
    const count = this.strokeCount;
    if (this.layer.length < count) this.layer = new Uint16Array(2 * count);
    this.view ??= {
      xy: this.points.data.subarray(0, this.points.length),
      offsets: this.offsets.data.subarray(0, count + 1),
      layer: this.layer.subarray(0, count),
      layers: [LAYER],
    };
    return this.view;
  }

  get hasFailed(): boolean {
    return this.failure !== null;
  }

  get strokeCount(): number {
    return this.offsets.length - 1;
  }

  get pointCount(): number {
    return this.points.pointCount;
  }

  /** Points of the whole drawing so far. */
  get allPoints(): number {
    return this.forgottenPoints + this.pointCount;
  }

  /** Points of the whole drawing that are drawn. */
  get allDrawn(): number {
    return this.forgottenPoints + this.drawnPoints;
  }

  /** How many more points there is room for. */
  get roomLeft(): number {
    return Math.max(0, WAITING_MAX - (this.pointCount - this.drawnPoints));
  }

  get isAllDrawn(): boolean {
    return this.isIdle;
  }

  /** The first place of the whole drawing that is not drawn. */
  get drawnPlace(): JobPlace {
    const { stroke, alongMm } = this.drawnUntil;
    return { strokeIndex: stroke, alongMm };
  }

  /** `stop`: makes the plot end with the strokes before the last one, or stop on that one; returns the place. */
  onUndo(stop: () => StrokePosition): void {
    this.stopForUndo = stop;
  }

  /** Calls `listener` after each change of the strokes. */
  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Adds a whole stroke. One that grows is closed. Throws `out-of-bounds`, and then adds nothing. */
  stroke(points: LivePoints): void {
    const xy = flat(points);
    this.check(xy);
    this.close();
    this.begin(xy[0], xy[1], xy.length > 2 * WHOLE_MAX);
    for (let i = 2; i < xy.length; i += 2) this.push(xy[i], xy[i + 1]);
    this.changed();
  }

  /** Adds a point to the stroke that grows, or begins one. Throws `out-of-bounds`, and then adds nothing. */
  lineTo(x: number, y: number): void {
    this.check([x, y]);
    if (this.isOpen) this.push(x, y);
    else this.begin(x, y, true);
    this.isOpen = true;
    this.changed();
  }

  /** The stroke that grows is complete. */
  penUp(): void {
    if (!this.isOpen) return;
    this.close();
    this.changed();
  }

  /** Takes back the last stroke, as far as the plot can still leave it out. What is left of it is complete. */
  undo(): LiveUndone {
    this.mustTakeMore();
    this.close();
    const before = this.pointCount;
    const stroke = this.strokeCount - 1;
    const first = this.firstPointOf(Math.max(0, stroke));
    if (stroke >= 0) {
      const place = this.stopForUndo?.() ?? { stroke: 0, alongMm: 0 };
      if (place.stroke <= stroke) this.cutAt(place.stroke < stroke ? { stroke, alongMm: 0 } : place);
    }
    this.changed();
    return { takenBack: Math.max(0, before - this.pointCount), left: this.pointCount - first };
  }

  /** Removes what follows a place of the last stroke, which then ends there. */
  private cutAt(place: StrokePosition): void {
    const { points, along, offsets, grown } = this;
    const kept = this.pointsBefore(place);
    const isGone = place.alongMm === 0;
    const end = isGone || kept === this.pointCount ? null : pointAt(this.strokes, place);
    this.record?.takeBack(points.data.slice(2 * kept, points.length), isGone);
    points.length = 2 * kept;
    along.length = kept;
    this.view = null;
    if (isGone) {
      offsets.length--;
      grown.length--;
      return;
    }
    this.setEnd();
    if (end !== null) this.push(end.x, end.y);
  }

  /** The drawing is complete. */
  end(): void {
    this.close();
    this.isEnded = true;
    this.changed();
  }

  /** The plot has ended: nothing more is drawn. */
  fail(error: Error): void {
    this.failure ??= error;
    this.waiters.end(error);
  }

  /** Resolves when there is room for more points. */
  room(): Promise<void> {
    return this.waiters.until(() => this.pointCount - this.drawnPoints <= WAITING_MAX);
  }

  /** Resolves when everything is drawn. */
  idle(): Promise<void> {
    return this.waiters.until(() => this.isIdle);
  }

  /** Call while the pen draws: everything before this place is drawn. */
  drawnTo(place: StrokePosition): void {
    this.drawnPoints = Math.max(this.drawnPoints, this.pointsBefore(place));
    this.drawnUntil = this.wholePlace(place);
    this.waiters.check();
  }

  /** Call when everything up to a point is drawn and the pen rests. */
  restsAt(point: number): void {
    this.drawnPoints = point;
    this.isIdle = point === this.pointCount;
    this.drawnUntil = this.wholePlace(this.placeAfter(point));
    this.waiters.check();
  }

  /** So much is drawn that the plot must rest, and call `forget`. */
  get mustForget(): boolean {
    return this.drawnPoints > this.keptMax;
  }

  /** Forgets what is drawn, at rest at a place; returns it in what is left. `wholePlace` is then this place in the whole. */
  forget(place: StrokePosition): StrokePosition {
    const isWithin = place.stroke < this.strokeCount && place.alongMm > 0;
    const drawn = this.pointsBefore(place);
    // The last two points of a stroke that goes on tell where it does.
    const first = isWithin ? Math.max(this.firstPointOf(place.stroke), drawn - 2) : drawn;
    const fromMm = isWithin ? this.alongAt(first) : 0;
    this.forgotten = this.wholePlace({ stroke: place.stroke, alongMm: fromMm });
    const { offsets, along, points, grown } = this;
    if (isWithin) for (let i = first; i < offsets.data[place.stroke + 1]; i++) along.data[i] -= fromMm;
    for (let stroke = place.stroke; stroke <= this.strokeCount; stroke++) {
      offsets.data[stroke - place.stroke] = Math.max(0, offsets.data[stroke] - first);
    }
    grown.data.copyWithin(0, place.stroke, this.strokeCount);
    along.data.copyWithin(0, first, this.pointCount);
    points.data.copyWithin(0, 2 * first, points.length);
    points.length -= 2 * first;
    along.length -= first;
    offsets.length -= place.stroke;
    grown.length -= place.stroke;
    this.drawnPoints -= first;
    this.forgottenPoints += first;
    this.view = null;
    return { stroke: 0, alongMm: place.alongMm - fromMm };
  }

  /** A place in all that was ever added, whose first strokes may be forgotten. */
  wholePlace({ stroke, alongMm }: StrokePosition): StrokePosition {
    const { forgotten } = this;
    return { stroke: forgotten.stroke + stroke, alongMm: alongMm + (stroke === 0 ? forgotten.alongMm : 0) };
  }

  /** Number of points up to a place, with the one at the place. */
  pointsBefore({ stroke, alongMm }: StrokePosition): number {
    const { offsets, along } = this;
    if (stroke >= this.strokeCount) return this.pointCount;
    const first = offsets.data[stroke];
    if (alongMm === 0) return first;
    return firstWhere(first, offsets.data[stroke + 1], (i) => along.data[i] > alongMm + SAME_POINT_MM);
  }

  /** mm along its stroke. */
  alongAt(point: number): number {
    return this.along.data[point];
  }

  /** The stroke with a point. */
  strokeOf(point: number): number {
    const { offsets, strokeCount } = this;
    return firstWhere(0, strokeCount, (i) => offsets.data[i + 1] > point);
  }

  firstPointOf(stroke: number): number {
    return this.offsets.data[stroke];
  }

  mayGrow(stroke: number): boolean {
    return this.grown.data[stroke] === 1;
  }

  /** The place when so many points are drawn. */
  private placeAfter(points: number): StrokePosition {
    const stroke = this.strokeOf(points);
    if (points === 0 || stroke === this.strokeCount || this.firstPointOf(stroke) === points) {
      return { stroke, alongMm: 0 };
    }
    return { stroke, alongMm: this.alongAt(points - 1) };
  }

  private begin(x: number, y: number, grows: boolean): void {
    this.record?.begin(x, y);
    this.grown.push(grows ? 1 : 0);
    this.offsets.push(0);
    this.points.push(x, y);
    this.along.push(0);
    this.setEnd();
  }

  private push(x: number, y: number): void {
    const { points, along } = this;
    const last = points.length - 2;
    const mm = Math.hypot(x - points.data[last], y - points.data[last + 1]);
    if (mm < SAME_POINT_MM) return;
    const before = along.data[along.length - 1];
    this.record?.add(x, y);
    points.push(x, y);
    along.push(before + mm);
    this.setEnd();
  }

  private setEnd(): void {
    this.offsets.data[this.strokeCount] = this.pointCount;
  }

  private close(): void {
    this.isOpen = false;
  }

  private changed(): void {
    this.version++;
    this.view = null;
    this.isIdle = this.drawnPoints === this.pointCount;
    for (const listener of this.listeners) listener();
  }

  private check(xy: ArrayLike<number>): void {
    this.mustTakeMore();
    mustReach(xy, this.machine);
  }

  private mustTakeMore(): void {
    if (this.failure) throw this.failure;
    if (this.isEnded) throw liveEnded();
  }
}

export const liveEnded = (): PlotwrightError =>
  new PlotwrightError("conflict", "This live drawing has ended: begin another one.");

export const liveStopped = (): PlotwrightError =>
  new PlotwrightError("cancelled", "The live drawing was stopped.");

/** Throws `out-of-bounds` unless a machine reaches all points. */
export function mustReach(xy: ArrayLike<number>, machine: DrawnMachine): void {
  for (let i = 0; i < xy.length; i += 2) {
    const [x, y] = [xy[i], xy[i + 1]];
    if (!Number.isFinite(x) || !Number.isFinite(y)) {
      throw new RangeError(
        `a point of the stroke is (${x}, ${y}): both must be finite numbers, in mm from home`,
      );
    }
    if (isReached({ x0: x, y0: y, x1: x, y1: y }, machine)) continue;
    const { name, widthMm, heightMm } = machine;
    throw new PlotwrightError(
      "out-of-bounds",
      `The point ${mmInWords(x)}, ${mmInWords(y)} can't be drawn: ${name} reaches from 0, 0 to ${mmInWords(widthMm)}, ${mmInWords(heightMm)} mm.`,
    );
  }
}

/** Points as x, y, x, y … */
export function flat(points: LivePoints): ArrayLike<number> {
  const xy = ArrayBuffer.isView(points) ? points : pairsOf(points);
  if (xy !== null && xy.length > 0 && xy.length % 2 === 0) return xy as ArrayLike<number>;
  throw new TypeError(
    "a stroke is a list of points [[x, y], [x, y], …], or x, y, x, y … in a Float64Array, with at least one point",
  );
}

/** Null: not all are pairs. */
function pairsOf(points: unknown): unknown[] | null {
  if (!Array.isArray(points)) return null;
  const list: readonly unknown[] = Array.from(points);
  return list.every((point) => Array.isArray(point) && point.length === 2) ? list.flat() : null;
}
