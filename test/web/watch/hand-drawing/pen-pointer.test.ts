/** Which pointers draw, and which move the sheet. */
import { describe, expect, it } from "vitest";
import { listenForGestures } from "../../../../web/preview/gestures.js";
import type { View } from "../../../../web/scene/view.js";
import { PenPointer } from "../../../../web/watch/hand-drawing/pen-pointer.js";

type Kind = "touch" | "pen" | "mouse";

/** A sheet that is drawn on, 10 px from the left of the window. */
const sheet = () => {
  const element = Object.assign(new EventTarget(), {
    setPointerCapture: () => undefined,
    getBoundingClientRect: () => ({ left: 10, top: 0 }),
    clientWidth: 400,
    clientHeight: 300,
  });
  let view: View = { scale: 1, offsetX: 0, offsetY: 0 };
  const seen = { strokes: [] as [x: number, y: number, atMs: number][][], open: 0, isFull: false, fits: 0 };
  const pen = new PenPointer({
    begin: () => {
      if (seen.isFull) return false;
      seen.strokes.push([]);
      seen.open++;
      return true;
    },
    add: ({ x, y }, atMs) => void seen.strokes[seen.strokes.length - 1].push([x, y, atMs]),
    finish: () => void seen.open--,
  });
  listenForGestures(element as unknown as HTMLElement, {
    view: () => view,
    setView: (next) => {
      view = next;
    },
    fit: () => void seen.fits++,
    hover: () => undefined,
    grab: () => null,
    nudge: () => false,
    tap: () => undefined,
    draws: (event, placeOf) => pen.take(event, placeOf),
  });
  let nowMs = 0;
  const send = (type: string, more: object): void => {
    const event = new Event(type);
    // Read only on events.
    Object.defineProperty(event, "timeStamp", { value: nowMs });
    element.dispatchEvent(Object.assign(event, { button: 0, ...more }));
  };
  const pointer = (type: string, x: number, y: number, pointerId = 1, pointerType: Kind = "touch"): void =>
    send(`pointer${type}`, { clientX: x + 10, clientY: y, pointerId, pointerType });
  return { seen, pointer, send, view: () => view, wait: (ms: number) => void (nowMs += ms) };
};

const line = (to: ReturnType<typeof sheet>, kind: Kind, pointerId = 1): void => {
  to.pointer("down", 100, 100, pointerId, kind);
  for (const x of [104, 110, 130]) {
    to.wait(8);
    to.pointer("move", x, 100, pointerId, kind);
  }
  to.pointer("up", 130, 100, pointerId, kind);
};

describe("a pointer on a sheet that is drawn on", () => {
  it.each(["touch", "pen", "mouse"] as const)("draws from where it came down: %s", (kind) => {
    const on = sheet();
    line(on, kind);
    expect(on.seen.strokes).toEqual([
      [
        [100, 100, 0],
        [104, 100, 8],
        [110, 100, 16],
        [130, 100, 24],
      ],
    ]);
    expect(on.seen.open).toBe(0);
    expect(on.view()).toEqual({ scale: 1, offsetX: 0, offsetY: 0 });
  });

  it.each([
    [
      "loses it to another window",
      (on: ReturnType<typeof sheet>) => on.send("lostpointercapture", { pointerId: 1 }),
    ],
    [
      "hears of it again when its button is up",
      (on: ReturnType<typeof sheet>) =>
        on.send("pointermove", {
          clientX: 300,
          clientY: 200,
          pointerId: 1,
          pointerType: "mouse",
          buttons: 0,
        }),
    ],
  ])(
    "ends the stroke of a mouse that was let go elsewhere when the sheet %s, and draws the next one",
    (_how, letGo) => {
      const on = sheet();
      on.pointer("down", 100, 100, 1, "mouse");
      on.pointer("move", 130, 100, 1, "mouse");
      letGo(on);
      expect(on.seen.open).toBe(0);
      on.pointer("move", 140, 150, 1, "mouse");
      line(on, "mouse");
      expect(on.seen.strokes.map(({ length }) => length)).toEqual([2, 4]);
      expect(on.seen.open).toBe(0);
    },
  );

  it("draws all points that the browser has put together into one event", () => {
    const on = sheet();
    on.pointer("down", 0, 0, 1, "pen");
    const between = [1, 2, 3].map((k) => ({ clientX: 10 + 5 * k, clientY: k, timeStamp: k }));
    on.send("pointermove", {
      clientX: 25,
      clientY: 3,
      pointerId: 1,
      pointerType: "pen",
      getCoalescedEvents: () => between,
    });
    expect(on.seen.strokes).toEqual([
      [
        [0, 0, 0],
        [5, 1, 1],
        [10, 2, 2],
        [15, 3, 3],
      ],
    ]);
  });

  it("makes a dot with a tap, and two taps do not fit the sheet", () => {
    const on = sheet();
    for (let tap = 0; tap < 2; tap++) {
      on.pointer("down", 50, 60);
      on.pointer("up", 50, 60);
    }
    on.send("dblclick", { clientX: 60, clientY: 60 });
    expect(on.seen.strokes).toEqual([[[50, 60, 0]], [[50, 60, 0]]]);
    expect([on.seen.open, on.seen.fits]).toEqual([0, 0]);
  });

  it("draws nothing with two fingers: they zoom", () => {
    const on = sheet();
    on.pointer("down", 100, 100, 1);
    on.pointer("move", 103, 100, 1);
    on.pointer("down", 203, 100, 2);
    on.pointer("move", 303, 100, 2);
    on.pointer("up", 303, 100, 2);
    on.pointer("up", 103, 100, 1);
    expect(on.seen.strokes).toEqual([]);
    expect(on.view().scale).toBeCloseTo(2, 9);
  });

  it("draws with a finger that rests before it moves on slowly", () => {
    const on = sheet();
    on.pointer("down", 100, 100);
    on.wait(200);
    on.pointer("move", 101, 100);
    expect(on.seen.strokes).toEqual([
      [
        [100, 100, 0],
        [101, 100, 200],
      ],
    ]);
  });

  it("ignores the palm while it draws, even when the palm stays", () => {
    const on = sheet();
    on.pointer("down", 100, 100, 1, "pen");
    on.pointer("down", 200, 200, 2);
    on.pointer("move", 240, 240, 2);
    on.pointer("move", 110, 100, 1, "pen");
    on.pointer("up", 110, 100, 1, "pen");
    on.pointer("move", 250, 260, 2);
    on.pointer("up", 250, 260, 2);
    expect(on.seen.strokes.map((stroke) => stroke.length)).toEqual([2]);
    expect(on.view()).toEqual({ scale: 1, offsetX: 0, offsetY: 0 });
  });

  it("only moves the sheet with a finger once a stylus has drawn", () => {
    const on = sheet();
    line(on, "pen", 1);
    line(on, "touch", 2);
    expect(on.seen.strokes.length).toBe(1);
    // Its first pixels could have been a tap.
    expect(on.view().offsetX).toBe(26);
  });

  it("moves the sheet with the middle button", () => {
    const on = sheet();
    const middle = { button: 1, pointerId: 1, pointerType: "mouse", clientY: 0 };
    on.send("pointerdown", { ...middle, clientX: 10 });
    on.send("pointermove", { ...middle, clientX: 60 });
    on.send("pointerup", { ...middle, clientX: 60 });
    expect(on.seen.strokes).toEqual([]);
    expect(on.view().offsetX).toBe(50);
    line(on, "mouse");
    expect(on.seen.strokes.length).toBe(1);
  });

  it("draws nothing, and moves nothing, while the drawing takes no stroke", () => {
    const on = sheet();
    on.seen.isFull = true;
    line(on, "touch");
    line(on, "mouse");
    expect(on.seen.strokes).toEqual([]);
    expect(on.view().offsetX).toBe(0);
    on.seen.isFull = false;
    line(on, "touch");
    expect(on.seen.strokes.length).toBe(1);
  });

  it("ends its stroke when the system takes the pointer, and drops a finger that has not begun", () => {
    const on = sheet();
    on.pointer("down", 100, 100);
    on.pointer("cancel", 100, 100);
    expect(on.seen.strokes).toEqual([]);
    on.pointer("down", 100, 100);
    on.pointer("move", 120, 100);
    on.pointer("cancel", 120, 100);
    expect(on.seen.strokes.length).toBe(1);
    expect(on.seen.open).toBe(0);
  });
});
