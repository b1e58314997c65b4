/**
 * Tells the pointer that draws from those that move the paper. One pointer draws at a time; while it does, the palm and
 * other fingers do nothing. Two fingers move and zoom the paper: the first one has drawn nothing until it has moved a
 * little, or rested. Once a stylus has drawn, fingers only move the paper.
 */
import type { Point } from "../../preview/gestures.js";

/** Takes the strokes of the pointer, px on the sheet. */
export interface TakesPointer {
  /** False: nothing can be drawn now. */
  begin(): boolean;
  add(at: Point, atMs: number): void;
  finish(): void;
}

/** A finger begins to draw when it has moved so far, or has been down for so long. */
const BEGIN_PX = 6;
const BEGIN_MS = 120;

interface Sample {
  readonly at: Point;
  readonly atMs: number;
}

export class PenPointer {
  private drawing: { readonly id: number; readonly isRefused: boolean } | null = null;
  /** A finger that may begin to draw. */
  private finger: { readonly id: number; readonly samples: Sample[] } | null = null;
  /** Down, and drawing nothing: a palm. */
  private readonly ignored = new Set<number>();
  /** Down, and moving the paper. */
  private readonly moving = new Set<number>();
  private hasStylus = false;

  constructor(private readonly strokes: TakesPointer) {}

  /** Takes each event of each pointer. False: it is for moving the paper. `placeOf`: on the sheet, px. */
  take(event: PointerEvent, placeOf: (event: MouseEvent) => Point): boolean {
    if (event.type === "pointerdown") return this.down(event, placeOf);
    const { pointerId: id } = event;
    const isOver = event.type !== "pointermove" || event.buttons === 0;
    if (isOver) this.moving.delete(id);
    if (this.ignored.has(id)) {
      if (isOver) this.ignored.delete(id);
      return true;
    }
    if (this.drawing?.id === id) {
      if (!isOver) this.draw(samplesOf(event, placeOf));
      else {
        if (!this.drawing.isRefused) this.strokes.finish();
        this.drawing = null;
      }
      return true;
    }
    if (this.finger?.id !== id) return false;
    const { samples } = this.finger;
    if (!isOver) samples.push(...samplesOf(event, placeOf));
    if (event.type === "pointerup" || hasBegun(samples)) this.beginWith(id, samples);
    if (!isOver) return true;
    if (this.drawing !== null) return this.take(event, placeOf);
    this.finger = null;
    return true;
  }

  private down(event: PointerEvent, placeOf: (event: MouseEvent) => Point): boolean {
    const { pointerId: id, pointerType: type } = event;
    if (this.drawing) {
      this.ignored.add(id);
      return true;
    }
    const isFinger = type === "touch";
    if (this.finger || this.moving.size > 0 || event.button !== 0 || (isFinger && this.hasStylus)) {
      if (this.finger) this.moving.add(this.finger.id);
      this.finger = null;
      this.moving.add(id);
      return false;
    }
    this.hasStylus ||= type === "pen";
    const samples = [{ at: placeOf(event), atMs: event.timeStamp }];
    if (isFinger) this.finger = { id, samples };
    else this.beginWith(id, samples);
    return true;
  }

  private beginWith(id: number, samples: readonly Sample[]): void {
    this.finger = null;
    this.drawing = { id, isRefused: !this.strokes.begin() };
    this.draw(samples);
  }

  private draw(samples: readonly Sample[]): void {
    if (this.drawing?.isRefused) return;
    for (const { at, atMs } of samples) this.strokes.add(at, atMs);
  }
}

/** All that the pointer did since the last event, which browsers report once a frame. */
const samplesOf = (event: PointerEvent, placeOf: (event: MouseEvent) => Point): Sample[] => {
  const events = event.getCoalescedEvents?.() ?? [];
  return (events.length > 0 ? events : [event]).map((one) => ({ at: placeOf(one), atMs: one.timeStamp }));
};

const hasBegun = (samples: readonly Sample[]): boolean => {
  const [first, last] = [samples[0], samples[samples.length - 1]];
  const movedPx = Math.hypot(last.at.x - first.at.x, last.at.y - first.at.y);
  return movedPx > BEGIN_PX || last.atMs - first.atMs >= BEGIN_MS;
};
