import { describe, expect, it } from "vitest";
import { listenForGestures, type Point } from "../../../web/preview/gestures.js";
import type { View } from "../../../web/scene/view.js";

/** A sheet with one drawing that is under every pointer. */
const sheet = (canGrab: (isFinger: boolean) => boolean = () => true) => {
  const element = Object.assign(new EventTarget(), {
    setPointerCapture: () => undefined,
    getBoundingClientRect: () => ({ left: 0, top: 0 }),
    clientWidth: 400,
    clientHeight: 300,
  });
  let view: View = { scale: 1, offsetX: 0, offsetY: 0 };
  const seen = { at: [0, 0], taps: [] as Point[], drags: 0, view: () => view };
  listenForGestures(element as unknown as HTMLElement, {
    view: () => view,
    setView: (next) => {
      view = next;
    },
    fit: () => undefined,
    hover: () => undefined,
    grab: (_at, isFinger) =>
      canGrab(isFinger)
        ? {
            to: (dxPx, dyPx) => {
              seen.drags++;
              seen.at = [dxPx, dyPx];
            },
            end: () => undefined,
          }
        : null,
    nudge: () => false,
    tap: (at) => void seen.taps.push(at),
  });
  const pointer = (type: string, x: number, y: number, pointerId = 1, pointerType = "touch"): void => {
    const event = new Event(`pointer${type}`);
    element.dispatchEvent(
      Object.assign(event, { clientX: x, clientY: y, pointerId, pointerType, button: 0 }),
    );
  };
  return { seen, pointer };
};

describe("a drawing under the pointer", () => {
  it("follows the pointer", () => {
    const { seen, pointer } = sheet();
    pointer("down", 100, 100);
    pointer("move", 130, 80);
    pointer("up", 130, 80);
    expect(seen.at).toEqual([30, -20]);
    expect(seen.taps).toEqual([]);
  });

  it("stays where it was when a second finger comes, and the sheet is zoomed", () => {
    const { seen, pointer } = sheet();
    pointer("down", 100, 100);
    pointer("move", 109, 100);
    expect(seen.at).toEqual([9, 0]);
    pointer("down", 200, 100, 2);
    pointer("move", 291, 100, 2);
    pointer("up", 291, 100, 2);
    pointer("up", 109, 100);
    expect(seen.at).toEqual([0, 0]);
    expect(seen.view().scale).toBeCloseTo(2, 12);
    expect(seen.taps).toEqual([]);
  });

  it("is not moved by a finger that trembles: that is a tap", () => {
    const { seen, pointer } = sheet();
    pointer("down", 100, 100);
    for (let k = 0; k < 10; k++) pointer("move", 100 + (k % 2), 100 + (k % 3));
    pointer("up", 100, 100);
    expect(seen.drags).toBe(0);
    expect(seen.taps).toEqual([{ x: 100, y: 100 }]);
  });

  it("may be held by the mouse only; a finger then pans", () => {
    const { seen, pointer } = sheet((isFinger) => !isFinger);
    pointer("down", 100, 100);
    pointer("move", 130, 80);
    pointer("up", 130, 80);
    expect(seen.drags).toBe(0);
    expect([seen.view().offsetX, seen.view().offsetY]).toEqual([30, -20]);
    pointer("down", 100, 100, 1, "mouse");
    pointer("move", 130, 80, 1, "mouse");
    expect(seen.at).toEqual([30, -20]);
  });

  it("two fingers that only touch the sheet are no tap", () => {
    const { seen, pointer } = sheet();
    pointer("down", 100, 100);
    pointer("down", 200, 100, 2);
    pointer("up", 200, 100, 2);
    pointer("up", 100, 100);
    expect(seen.taps).toEqual([]);
    expect(seen.drags).toBe(0);
  });
});
