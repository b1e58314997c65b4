/** The filter over time: a box turns jumps of acceleration into jerk, impulses repeat the motion later. */
import { describe, expect, it } from "vitest";
import { BlockColumns } from "../../../src/plan/block-columns.js";
import { writeFiltered } from "../../../src/plan/shaping/filter.js";
import { ImpulseFilter, impulseKernel } from "../../../src/plan/shaping/impulse-filter.js";

/** 40 mm along x: accelerate for a quarter of a second, hold for half a second, slow down again. */
function planned(): BlockColumns {
  const from = new BlockColumns(0, false);
  from.push(0.25, 10, 5, 0, 0, 200, 0, 0);
  from.push(0.5, 16.25, 5, 50, 0, 0, 0, 6.25);
  from.push(0.25, 41.25, 5, 50, 0, -200, 0, 31.25);
  return from;
}
const END = { x: 47.5, y: 5, alongMm: 37.5 };

/** x, vx, ax at the end of the last block. */
function endOf(out: BlockColumns): readonly number[] {
  const k = out.count - 1;
  const s = out.durationS[k];
  const [v, a, j] = [out.vx[k], out.ax[k], out.jx?.[k] ?? 0];
  return [out.x[k] + s * (v + s * (a / 2 + (s * j) / 6)), v + s * (a + (s * j) / 2), a + s * j];
}

describe("a box of 0.1 s", () => {
  const out = new BlockColumns(0, true);
  writeFiltered(planned(), END, 0.1, out);

  it("takes 0.1 s more and ends in the same place, at rest", () => {
    expect(out.clockS).toBeCloseTo(1.1, 9);
    const [x, v, a] = endOf(out);
    expect(x).toBeCloseTo(47.5, 9);
    expect(v).toBeCloseTo(0, 9);
    expect(a).toBeCloseTo(0, 9);
  });

  it("turns each jump of acceleration a into jerk a/w", () => {
    const jerks = Array.from(out.jx!.subarray(0, out.count), (j) => Math.round(j));
    expect(jerks).toEqual([2_000, 0, -2_000, 0, -2_000, 0, 2_000]);
  });

  it("never exceeds the input's speed and acceleration", () => {
    for (let k = 0; k < out.count; k++) {
      expect(out.vx[k]).toBeLessThanOrEqual(50 + 1e-9);
      expect(Math.abs(out.ax[k])).toBeLessThanOrEqual(200 + 1e-9);
    }
  });
});

describe("two impulses 0.05 s apart", () => {
  const impulses = [
    { delayS: 0, weight: 0.6 },
    { delayS: 0.05, weight: 0.4 },
  ];
  const out = new BlockColumns(0, false);
  new ImpulseFilter(impulseKernel(impulses, impulses)).write(planned(), 0, END, out);

  it("give blocks of constant acceleration, 0.05 s longer, that end in the same place at rest", () => {
    expect(out.clockS).toBeCloseTo(1.05, 9);
    const [x, v] = endOf(out);
    expect(x).toBeCloseTo(47.5, 9);
    expect(v).toBeCloseTo(0, 9);
    expect(out.ax[0]).toBeCloseTo(120, 9);
    expect(out.ax[1]).toBeCloseTo(200, 9);
  });
});
