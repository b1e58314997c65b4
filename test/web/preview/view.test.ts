import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { pinched } from "../../../web/preview/gestures.js";
import {
  fitView,
  mmFromPx,
  mmFromScreen,
  panBy,
  rulerStep,
  screenBox,
  screenMap,
  screenPoint,
  zoomAt,
  type View,
} from "../../../web/scene/view.js";

const views = fc.record({
  scale: fc.double({ min: 0.1, max: 100, noNaN: true }),
  offsetX: fc.double({ min: -5_000, max: 5_000, noNaN: true }),
  offsetY: fc.double({ min: -5_000, max: 5_000, noNaN: true }),
  turn: fc.constantFrom(0, 1, 2, 3),
}) satisfies fc.Arbitrary<View>;
const px = fc.double({ min: 0, max: 2_000, noNaN: true });

describe("zooming", () => {
  it("keeps the point of the paper under the pointer", () => {
    fc.assert(
      fc.property(views, fc.double({ min: 0.3, max: 3, noNaN: true }), px, px, (view, factor, x, y) => {
        const before = mmFromScreen(view, x, y);
        const after = mmFromScreen(zoomAt(view, factor, x, y), x, y);
        const size = 1 + Math.abs(before[0]) + Math.abs(before[1]);
        expect(Math.abs(after[0] - before[0]) / size).toBeLessThan(1e-9);
        expect(Math.abs(after[1] - before[1]) / size).toBeLessThan(1e-9);
      }),
    );
  });

  it("never goes so far that the paper is lost", () => {
    const view = { scale: 1, offsetX: 0, offsetY: 0 };
    expect(zoomAt(view, 1e9, 0, 0).scale).toBeLessThanOrEqual(400);
    expect(zoomAt(view, 1e-9, 0, 0).scale).toBeGreaterThan(0);
  });
});

describe("pinching", () => {
  it("moves the paper with both fingers when they move alike", () => {
    fc.assert(
      fc.property(views, (view) => {
        const a = { x: 100, y: 100 };
        const b = { x: 300, y: 200 };
        const d = { x: 20, y: -30 };
        const moved = { x: a.x + d.x, y: a.y + d.y };
        const first = pinched(view, a, moved, b);
        const second = pinched(first, b, { x: b.x + d.x, y: b.y + d.y }, moved);
        const expected = panBy(view, d.x, d.y);
        expect(second.scale).toBeCloseTo(expected.scale, 6);
        expect(mmFromScreen(second, 200, 120)[0]).toBeCloseTo(mmFromScreen(expected, 200, 120)[0], 6);
      }),
    );
  });

  it("doubles the scale when the fingers are twice as far apart", () => {
    const view = { scale: 2, offsetX: 10, offsetY: 20 };
    expect(pinched(view, { x: 100, y: 0 }, { x: 200, y: 0 }, { x: 0, y: 0 }).scale).toBeCloseTo(4, 12);
  });
});

describe("a turned desk", () => {
  it("turns clockwise about home: x goes right, down, left, up, and y follows it", () => {
    const view = { scale: 2, offsetX: 100, offsetY: 50 };
    const ends = [0, 1, 2, 3].map((turn) => screenPoint({ ...view, turn }, 10, 3));
    expect(ends).toEqual([
      [120, 56],
      [94, 70],
      [80, 44],
      [106, 30],
    ]);
    expect(screenPoint(view, 10, 3)).toEqual(ends[0]);
  });

  it("takes each point and each distance there and back, and keeps lengths", () => {
    fc.assert(
      fc.property(views, px, px, px, px, (view, x, y, dx, dy) => {
        const [xMm, yMm] = mmFromScreen(view, x, y);
        const [backX, backY] = screenPoint(view, xMm, yMm);
        expect(Math.hypot(backX - x, backY - y)).toBeLessThan(1e-6);
        const { a, b, c, d, e, f } = screenMap(view);
        expect([a * xMm + c * yMm + e, b * xMm + d * yMm + f]).toEqual([backX, backY]);
        const [movedX, movedY] = mmFromScreen(view, x + dx, y + dy);
        const [dxMm, dyMm] = mmFromPx(view, dx, dy);
        expect(Math.hypot(xMm + dxMm - movedX, yMm + dyMm - movedY)).toBeLessThan(1e-6);
        expect(Math.hypot(dxMm, dyMm) * view.scale).toBeCloseTo(Math.hypot(dx, dy), 6);
      }),
    );
  });

  it("is fitted as it stands, in the middle", () => {
    const insets = { top: 40, right: 10, bottom: 20, left: 40 };
    const paper = { width: 297, height: 210 };
    const whole = { x0: 0, y0: 0, x1: 297, y1: 210 };
    const upright = screenBox(fitView(paper, { width: 900, height: 700 }, insets), whole);
    for (const turn of [0, 1, 2, 3]) {
      const view = fitView(paper, { width: 900, height: 700 }, insets, turn);
      const box = screenBox(view, whole);
      expect(box.x0 + box.x1).toBeCloseTo(upright.x0 + upright.x1, 9);
      expect(box.y0 + box.y1).toBeCloseTo(upright.y0 + upright.y1, 9);
      const [width, height] = turn % 2 === 0 ? [297, 210] : [210, 297];
      expect((box.x1 - box.x0) / view.scale).toBeCloseTo(width, 9);
      expect(Math.min(850 / width, 640 / height)).toBeCloseTo(view.scale, 9);
      expect((box.y1 - box.y0) / view.scale).toBeCloseTo(height, 9);
    }
  });
});

describe("fitting the paper", () => {
  it("shows all of it inside the insets, in the middle", () => {
    const insets = { top: 40, right: 10, bottom: 20, left: 40 };
    const view = fitView({ width: 297, height: 210 }, { width: 900, height: 700 }, insets);
    const right = view.offsetX + 297 * view.scale;
    const bottom = view.offsetY + 210 * view.scale;
    expect(view.offsetX).toBeGreaterThanOrEqual(40 - 1e-9);
    expect(right).toBeLessThanOrEqual(890 + 1e-9);
    expect(view.offsetY - 40).toBeCloseTo(680 - bottom, 9);
  });
});

describe("rulers", () => {
  it("step by 1, 2 or 5 of a power of ten, and leave room for the numbers", () => {
    fc.assert(
      fc.property(fc.double({ min: 0.05, max: 400, noNaN: true }), (scale) => {
        const step = rulerStep(scale, 60);
        const mantissa = Number((step / 10 ** Math.floor(Math.log10(step) + 1e-9)).toFixed(6));
        expect([1, 2, 5]).toContain(mantissa);
        expect(step * scale).toBeGreaterThanOrEqual(60 - 1e-6);
        expect(step * scale).toBeLessThanOrEqual(151);
      }),
    );
  });
});
