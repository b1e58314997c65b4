import { describe, expect, it } from "vitest";
import { checkBounds, unreachedCount } from "../../../src/prepare/on-paper.js";
import { prepare } from "../../../src/prepare/prepare.js";
import { type PrepareSettings, DEFAULT_PREPARE } from "../../../src/settings/prepare.js";
import { drawingOf } from "../../support/drawings/drawings.js";

const TRUE_SIZE: PrepareSettings = {
  ...DEFAULT_PREPARE,
  landscape: false,
  marginMm: 0,
  fit: false,
  order: "none",
};

describe("checkBounds", () => {
  const machine = { name: "AxiDraw V3", widthMm: 300, heightMm: 218 };

  it("accepts a drawing that the machine can reach, and an empty one", () => {
    expect(() => checkBounds(prepare(drawingOf(["M0 0L210 200"]), TRUE_SIZE).strokes, machine)).not.toThrow();
    expect(() => checkBounds(prepare(drawingOf([]), TRUE_SIZE).strokes, machine)).not.toThrow();
  });

  it("counts the strokes that leave the reach, wholly or in part", () => {
    const paths = ["M0 0L210 200", "M10 10L20 290", "M10 250L30 290", "M5 218V100"];
    expect(unreachedCount(prepare(drawingOf(paths), TRUE_SIZE).strokes, machine)).toBe(2);
    expect(unreachedCount(prepare(drawingOf(paths.slice(0, 1)), TRUE_SIZE).strokes, machine)).toBe(0);
  });

  it("refuses one that reaches further, with the figures", () => {
    const { strokes } = prepare(drawingOf(["M10 10L20 290"]), TRUE_SIZE);
    expect(() => checkBounds(strokes, machine)).toThrow(
      expect.objectContaining({
        code: "out-of-bounds",
        message: expect.stringMatching(/290\).*AxiDraw V3.*218/),
      }),
    );
  });
});
