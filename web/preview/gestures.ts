/** Changes the preview's view by pointer (mouse, pen or fingers), wheel and keyboard. */
import { panBy, zoomAt, type View } from "../scene/view.js";
import { ARROW_KEYS } from "../ui/rows/arrow-keys.js";

export interface Point {
  readonly x: number;
  readonly y: number;
}

export interface GestureTarget {
  view(): View;
  setView(view: View): void;
  fit(): void;
  /** The pointer is at (x, y) CSS px of the element, or has left (null). */
  hover(at: Point | null): void;
  /**
   * Begins a drag of the object under (x, y). Null: there is none, and the drag pans. `isFinger`: a finger also pans, so
   * it moves only what was selected before.
   */
  grab(at: Point, isFinger: boolean): Drag | null;
  /** An arrow key moves a drawing placed by hand, mm on the screen. False: there is none, and the key pans. */
  nudge(rightMm: number, downMm: number): boolean;
  /** A press without a drag; `isMore`: with Shift, Ctrl or Command held. */
  tap(at: Point, isMore: boolean): void;
  /** On a sheet that is drawn on: takes each event of a pointer. False: the pointer does not draw, and moves the sheet. */
  draws?(event: PointerEvent, placeOf: (event: MouseEvent) => Point): boolean;
}

export interface Drag {
  /** The distance from the start of the drag, px; `isFree`: without snapping. */
  to(dxPx: number, dyPx: number, isFree: boolean): void;
  end(): void;
}

const KEY_PAN_PX = 60;
/** Moved by an arrow key; ten times as much with Shift, a tenth with Alt. */
const NUDGE_MM = 1;
const KEY_ZOOM = 1.25;
const TAP_PX = 5;

/** Listens on `element`. Returns a function that stops listening. */
export const listenForGestures = (element: HTMLElement, target: GestureTarget): (() => void) => {
  const pointers = new Map<number, Point>();
  let downAt: Point = { x: 0, y: 0 };
  /** Until then, it may be a tap. A resting finger trembles, so the way there and back does not count. */
  let hasMoved = false;
  let drag: Drag | null = null;
  const letGo = (): void => {
    drag?.end();
    drag = null;
  };

  const placeOf = (event: MouseEvent): Point => {
    const box = element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };

  const onDown = (event: PointerEvent): void => {
    if (event.button > 1) return;
    element.setPointerCapture(event.pointerId);
    const at = placeOf(event);
    if (target.draws?.(event, placeOf)) hasMoved = true;
    else if (pointers.size === 0) {
      downAt = at;
      hasMoved = false;
      drag = target.grab(at, event.pointerType === "touch");
    } else {
      // Two fingers zoom. What the first one has moved until now was not meant.
      if (hasMoved) drag?.to(0, 0, true);
      letGo();
      hasMoved = true;
    }
    pointers.set(event.pointerId, at);
  };

  const onMove = (event: PointerEvent): void => {
    const now = placeOf(event);
    const before = pointers.get(event.pointerId);
    // It was let go where this page was not told of it, for example over another window.
    if (before && event.buttons === 0) return onUp(event);
    if (!before) {
      if (event.pointerType !== "touch") target.hover(now);
      return;
    }
    hasMoved ||= Math.hypot(now.x - downAt.x, now.y - downAt.y) > TAP_PX;
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    pointers.set(event.pointerId, now);
    if (target.draws?.(event, placeOf)) return;
    if (other) target.setView(pinched(target.view(), before, now, other));
    else if (!hasMoved) return;
    else if (drag) drag.to(now.x - downAt.x, now.y - downAt.y, event.altKey || event.ctrlKey);
    else target.setView(panBy(target.view(), now.x - before.x, now.y - before.y));
  };

  const onUp = (event: PointerEvent): void => {
    if (target.draws?.(event, placeOf)) hasMoved = true;
    if (pointers.size === 1 && !hasMoved && event.type === "pointerup") {
      target.tap(placeOf(event), event.shiftKey || event.ctrlKey || event.metaKey);
    }
    pointers.delete(event.pointerId);
    letGo();
  };

  const onWheel = (event: WheelEvent): void => {
    event.preventDefault();
    const { x, y } = placeOf(event);
    const px = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    // A trackpad's pinch is a wheel event with ctrl. A two-finger scroll usually has a horizontal part and pans.
    const isPan = !event.ctrlKey && event.deltaMode === WheelEvent.DOM_DELTA_PIXEL && event.deltaX !== 0;
    if (isPan || event.shiftKey) target.setView(panBy(target.view(), -event.deltaX * px, -event.deltaY * px));
    else {
      const factor = Math.exp(-event.deltaY * px * (event.ctrlKey ? 0.01 : 0.0016));
      target.setView(zoomAt(target.view(), Math.min(4, Math.max(0.25, factor)), x, y));
    }
  };

  const onKey = (event: KeyboardEvent): void => {
    const arrow = ARROW_KEYS[event.key];
    if (arrow && !event.ctrlKey && !event.metaKey) {
      const mm = NUDGE_MM * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
      if (target.nudge(arrow[0] * mm, arrow[1] * mm)) return event.preventDefault();
    }
    const change = keyChange(event, element);
    if (change === null) return;
    event.preventDefault();
    if (change === "fit") target.fit();
    else target.setView(change(target.view()));
  };

  const stop = new AbortController();
  const { signal } = stop;
  element.addEventListener("pointerdown", onDown, { signal });
  element.addEventListener("pointermove", onMove, { signal });
  element.addEventListener("pointerup", onUp, { signal });
  element.addEventListener("pointercancel", onUp, { signal });
  element.addEventListener("lostpointercapture", onUp, { signal });
  element.addEventListener("pointerleave", () => target.hover(null), { signal });
  element.addEventListener("wheel", onWheel, { signal, passive: false });
  if (!target.draws) element.addEventListener("dblclick", target.fit, { signal });
  element.addEventListener("keydown", onKey, { signal });
  return () => stop.abort();
};

/** The view after one finger has moved from `before` to `now` while the other rests: the paper follows both. */
export const pinched = (view: View, before: Point, now: Point, other: Point): View => {
  const factor =
    Math.hypot(now.x - other.x, now.y - other.y) /
    Math.max(1, Math.hypot(before.x - other.x, before.y - other.y));
  const moved = panBy(view, (now.x - before.x) / 2, (now.y - before.y) / 2);
  return zoomAt(moved, factor, (now.x + other.x) / 2, (now.y + other.y) / 2);
};

const keyChange = (event: KeyboardEvent, element: HTMLElement): "fit" | ((view: View) => View) | null => {
  if (event.ctrlKey || event.metaKey || event.altKey) return null;
  const arrow = ARROW_KEYS[event.key];
  if (arrow) return (view) => panBy(view, -KEY_PAN_PX * arrow[0], -KEY_PAN_PX * arrow[1]);
  const middleX = element.clientWidth / 2;
  const middleY = element.clientHeight / 2;
  switch (event.key) {
    case "+":
    case "=":
      return (view) => zoomAt(view, KEY_ZOOM, middleX, middleY);
    case "-":
      return (view) => zoomAt(view, 1 / KEY_ZOOM, middleX, middleY);
    case "0":
      return "fit";
    default:
      return null;
  }
};
