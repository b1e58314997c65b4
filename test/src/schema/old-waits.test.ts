import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, machineById, MACHINES, type PenSettings } from "../../../src/index.js";
import { dropTime, liftTime, timedPen } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, withExtraWaits, type PlotSettings } from "../../../src/schema/index.js";

/** Settings as they were stored while the waits were whole ones. */
const old = (pen: object, more: object = {}): unknown => {
  const { extraLiftMs, extraDropMs, ...heights } = DEFAULT_PEN;
  expect([extraLiftMs, extraDropMs]).toEqual([0, 0]);
  return { ...DEFAULT_PLOT_SETTINGS, ...more, pen: { ...heights, liftMs: 250, dropMs: 300, ...pen } };
};
const penOf = (stored: unknown): PenSettings => (withExtraWaits(stored) as PlotSettings).pen;

describe("waits of older settings", () => {
  it("that nobody chose become the times of the machine's servo", () => {
    expect(withExtraWaits(old({}))).toEqual(DEFAULT_PLOT_SETTINGS);
  });

  it("that a person chose stay as long as they were, on every machine and at any height", () => {
    fc.assert(
      fc.property(
        fc.constantFrom(...MACHINES),
        fc.integer({ min: 0, max: 3_000 }).filter((ms) => ms !== 250 && ms !== 300),
        fc.integer({ min: 0, max: 50 }),
        fc.integer({ min: 1, max: 50 }),
        (machine, ms, downPct, wayPct) => {
          const upPct = downPct + wayPct;
          const pen = penOf(old({ downPct, upPct, liftMs: ms, dropMs: ms }, { machine: machine.id }));
          const timed = timedPen(pen, machine);
          for (const s of [liftTime(timed, upPct), dropTime(timed, upPct)]) {
            // In whole milliseconds; a pen can't be more than 500 ms faster than its servo, and takes some time.
            if (pen.extraLiftMs > -500) expect(Math.abs(1_000 * s - Math.max(ms, 4))).toBeLessThanOrEqual(4);
          }
        },
      ),
    );
  });

  it("stay extra waits if a rate is set, since they were that already", () => {
    const pen = penOf(old({ liftMs: 60, dropMs: 90, liftPctPerS: 40, dropPctPerS: 20 }));
    expect(pen).toMatchObject({ extraLiftMs: 60, extraDropMs: 90 });
  });

  it("of layers are converted at the layers' own heights", () => {
    const layers = {
      low: { downPct: 10, dropMs: 900 },
      slow: { liftMs: 400 },
      own: { extraDropMs: 7 },
      high: { upPct: 80 },
    };
    expect(penOf(old({ layers })).layers).toEqual({
      low: { downPct: 10, extraDropMs: 900 - 227 },
      slow: { extraLiftMs: 400 - 131 },
      own: { extraDropMs: 7 },
      high: { upPct: 80 },
    });
  });

  it("of a plotter and its presets are converted for its model", () => {
    const nextdraw = machineById("nextdraw-8511");
    const stored = {
      pen: { upPct: 60, downPct: 30, liftMs: 100, dropMs: 300 },
      pens: [],
      presets: [{ name: "ink", pen: { upPct: 50, downPct: 30, liftMs: 80, dropMs: 80 } }],
    };
    expect(withExtraWaits(stored, nextdraw)).toEqual({
      pen: { upPct: 60, downPct: 30, extraLiftMs: 100 - 60, extraDropMs: 0 },
      pens: [],
      presets: [{ name: "ink", pen: { upPct: 50, downPct: 30, extraLiftMs: 80 - 46, extraDropMs: 80 - 48 } }],
    });
  });

  it("are left alone in anything else, and converting twice changes nothing more", () => {
    for (const other of [
      null,
      3,
      "pen",
      [],
      {},
      { pen: null },
      { pen: { layers: 3 } },
      { machine: 7, pen: {} },
    ]) {
      expect(withExtraWaits(other)).toEqual(other);
    }
    const once = withExtraWaits(old({ liftMs: 400 }));
    expect(withExtraWaits(once)).toEqual(once);
  });
});
