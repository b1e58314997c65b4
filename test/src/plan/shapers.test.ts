/** Input shapers, and the pen at the end of a swinging gantry, both checked by other means than their formulas. */
import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, plan } from "../../../src/index.js";
import { maxShapingErrorMm } from "../../../src/plan/shaping/shapers.js";
import { shaperImpulses } from "../../../src/plan/shaping/shapers.js";
import { SpringAxis } from "../../../src/plan/shaping/spring-axis.js";
import { SHAPERS } from "../../../src/settings/motion.js";
import { strokeSetOf } from "../../support/drawings/arbitraries.js";
import { SPRINGS, swinging } from "../../support/machines/swinging.js";

const REAL_SHAPERS = SHAPERS.filter((shaper) => shaper !== "none");

/** Swing that the impulses leave on a spring, as a share of what a single impulse leaves. */
function leftSwing(
  shaper: (typeof REAL_SHAPERS)[number],
  plannedHz: number,
  hz: number,
  damping: number,
): number {
  const omega = 2 * Math.PI * hz;
  const [decay, swing] = [damping * omega, omega * Math.sqrt(1 - damping ** 2)];
  const impulses = shaperImpulses(shaper, plannedHz, damping);
  const lastS = impulses[impulses.length - 1].delayS;
  let [re, im] = [0, 0];
  for (const { delayS, weight } of impulses) {
    const left = weight * Math.exp(-decay * (lastS - delayS));
    re += left * Math.cos(swing * delayS);
    im += left * Math.sin(swing * delayS);
  }
  return Math.hypot(re, im);
}

describe("the impulses", () => {
  it.each(REAL_SHAPERS)("of %s have positive weights that sum to 1", (shaper) => {
    const impulses = shaperImpulses(shaper, 17, 0.08);
    expect(impulses.reduce((sum, { weight }) => sum + weight, 0)).toBeCloseTo(1, 12);
    expect(impulses.every(({ weight }) => weight > 0)).toBe(true);
    expect(impulses[0].delayS).toBe(0);
  });

  it.each(["zv", "mzv", "zvd"] as const)("of %s leave no swing at the frequency", (shaper) => {
    expect(leftSwing(shaper, 15, 15, 0)).toBeLessThan(1e-12);
    expect(leftSwing(shaper, 15, 15, 0.05)).toBeLessThan(shaper === "mzv" ? 0.01 : 1e-12);
  });

  it("of ei leave 5 % at the frequency, and less beside it", () => {
    expect(leftSwing("ei", 15, 15, 0)).toBeCloseTo(0.05, 6);
    expect(leftSwing("ei", 15, 15 * 1.1, 0)).toBeLessThan(0.05);
  });

  it("of zv leave less than 17 % at a frequency wrong by 10 %, zvd less than 3 %", () => {
    for (const factor of [0.9, 1.1]) {
      expect(leftSwing("zv", 15, 15 * factor, 0.05)).toBeLessThan(0.17);
      expect(leftSwing("zvd", 15, 15 * factor, 0.05)).toBeLessThan(0.03);
    }
  });
});

describe("the simulated pen", () => {
  it("moves by the differential equation", () => {
    const [hz, damping] = [15, 0.05];
    const omega = 2 * Math.PI * hz;
    const accelAt = (t: number): number => (t < 0.03 ? 900 : t < 0.05 ? 0 : t < 0.11 ? -500 : 0);
    const axis = new SpringAxis(hz, damping);
    // The same with small steps of Runge and Kutta.
    let [d, rate] = [0, 0];
    const dt = 1e-5;
    for (let i = 0; i < 20_000; i++) {
      const a = accelAt((i + 0.5) * dt);
      const slope = (x: number, v: number): readonly [number, number] => [
        v,
        -a - 2 * damping * omega * v - omega * omega * x,
      ];
      const k1 = slope(d, rate);
      const k2 = slope(d + (dt / 2) * k1[0], rate + (dt / 2) * k1[1]);
      const k3 = slope(d + (dt / 2) * k2[0], rate + (dt / 2) * k2[1]);
      const k4 = slope(d + dt * k3[0], rate + dt * k3[1]);
      d += (dt / 6) * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0]);
      rate += (dt / 6) * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1]);
    }
    for (const [t, a] of [[0.03, 900], [0.02, 0], [0.06, -500], [0.09, 0]]) axis.advance(t, a); // prettier-ignore
    expect(axis.d).toBeCloseTo(d, 7);
    expect(axis.rate).toBeCloseTo(rate, 5);
  });
});

describe("a shaped plan", () => {
  const [springs] = SPRINGS;
  const machine = swinging(springs);
  const line = strokeSetOf([
    [
      [20, 20],
      [60, 50],
    ],
  ]);

  it("keeps a straight line straight for axes with different frequencies, except for the swing that it removes", () => {
    const motion = { ...DEFAULT_MOTION, shaper: "zv" as const };
    const { x, y, blockCount, runs } = plan(line, motion, DEFAULT_PEN, { machine });
    const allowed = maxShapingErrorMm(motion, springs);
    for (let k = runs.firstBlock[1]; k < Math.min(runs.firstBlock[2], blockCount); k++) {
      const away = Math.abs((x[k] - 20) * 0.6 - (y[k] - 20) * 0.8);
      expect(away).toBeLessThan(allowed);
    }
  });

  it("is refused without a measured machine, in scurve mode, and for an unknown name, with what to do", () => {
    const zv = { ...DEFAULT_MOTION, shaper: "zv" as const };
    expect(() => plan(line, zv)).toThrow(/ringing sheet/);
    expect(() => plan(line, { ...zv, mode: "scurve" }, DEFAULT_PEN, { machine })).toThrow(
      /choose mode blend/,
    );
    const unknown = { ...zv, shaper: "abc" as "zv" };
    expect(() => plan(line, unknown, DEFAULT_PEN, { machine })).toThrow(/none, zv, mzv, zvd, ei/);
    const far = { ...machine, springs: { ...springs, xHz: 0 } };
    expect(() => plan(line, zv, DEFAULT_PEN, { machine: far })).toThrow(/Hz: it must be 2 to 200 Hz/);
  });

  it("with shaper none is the plan of a machine that was not measured", () => {
    const none = plan(line, { ...DEFAULT_MOTION, shaper: "none" }, DEFAULT_PEN, { machine });
    expect(none).toEqual(plan(line, DEFAULT_MOTION, DEFAULT_PEN, { machine: { ...machine, springs: null } }));
  });
});
