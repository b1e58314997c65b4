/** The basic shapes of the CSS property `clip-path`, drawn as Chromium draws them. */
import { describe, expect, it } from "vitest";
import { curveBox } from "../../../../src/import/shape-buffer.js";
import { cssClipShape } from "../../../../src/import/svg/masks/css-clip-shape.js";
import { draw } from "../../../support/import/shapes.js";

const BOX = { x0: 20, y0: 10, x1: 60, y1: 30 };
const BASIS = { fontSize: 16, rootFontSize: 16, viewportWidth: 100, viewportHeight: 100 };

describe("clip-path", () => {
  it.each([
    ["circle()", [30, 10, 50, 30]],
    ["circle(5px)", [35, 15, 45, 25]],
    ["circle(5px at 25% 50%)", [25, 15, 35, 25]],
    ["circle(farthest-side at top)", [20, -10, 60, 30]],
    ["ellipse(25% 50%)", [30, 10, 50, 30]],
    ["ellipse(4px closest-side at right)", [56, 10, 64, 30]],
    ["inset(1px 2px 3px 4px)", [24, 11, 58, 27]],
    ["inset(10%)", [24, 12, 56, 28]],
    ["polygon(0 0, 50% 0, 0 100%)", [20, 10, 40, 30]],
    ["path('M1 2H5V9z')", [21, 12, 25, 19]],
  ])("%s cuts to %j", (text, expected) => {
    const clip = cssClipShape(text, BOX, BASIS);
    const { x0, y0, x1, y1 } = curveBox(clip!.shape);
    expect([x0, y0, x1, y1].map((mm) => Math.round(1e3 * mm) / 1e3)).toEqual(expected);
  });

  it.each([
    ["polygon(0 0, 100% 0, 0 100%)", [20, 10, 60, 10, 20, 30]],
    ["polygon(0 0, 100% 0, 0 100%) view-box", [0, 0, 100, 0, 0, 100]],
    ["fill-box polygon(0 0, 100% 0, 0 100%)", [20, 10, 60, 10, 20, 30]],
  ])("%s is in its reference box", async (value, expected) => {
    const { clips, warnings } = await draw(
      `<rect x="20" y="10" width="40" height="20" clip-path="${value}"/>`,
    );
    expect(clips.map(({ coords }) => [...coords])).toEqual([expected]);
    expect(warnings).toEqual([]);
  });

  it("has the fill rule of a polygon", async () => {
    const body = '<rect width="40" height="20" style="clip-path:polygon(evenodd, 0 0, 10px 0, 0 10px)"/>';
    expect([...(await draw(body)).clips[0].rule]).toEqual([1]);
  });

  it("hides a shape of which nothing remains", async () => {
    expect((await draw('<rect width="40" height="20" style="clip-path:inset(50%)"/>')).paths.count).toBe(0);
  });

  it.each([
    "inset(1px round 2px)",
    "circle(-3px)",
    "polygon(1px)",
    "shape(from 0 0)",
    "circle(5px at left 10px top 0)",
  ])("%s is reported and not applied", async (value) => {
    const { warnings, clips } = await draw(`<rect width="40" height="20" style="clip-path:${value}"/>`);
    expect(clips).toEqual([]);
    expect(warnings.map(({ code }) => code)).toEqual(["clip-ignored"]);
  });
});
