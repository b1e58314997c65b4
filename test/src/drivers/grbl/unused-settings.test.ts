/** Settings that a Grbl does not use are named, and change nothing. */
import { describe, expect, it } from "vitest";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  machineById,
  planSvg,
  type SvgSettings,
} from "../../../../src/index.js";
import { unusedSettings, usesSetting } from "../../../../src/internal.js";
import { GRBL } from "../../../support/machines/machine.js";

const SVG =
  '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="80mm" viewBox="0 0 100 80"><path d="M20 20H80V60" stroke="#000" fill="none"/></svg>';
const planned = (settings: SvgSettings) =>
  planSvg(SVG, { machine: GRBL.id, customMachine: GRBL, ...settings });

const SHAPED: SvgSettings = { motion: { shaper: "zv" } };
const CHANGED = {
  motion: {
    ...DEFAULT_MOTION,
    mode: "scurve",
    draw: { ...DEFAULT_MOTION.draw, accelMmPerS2: 700 },
    accelYMmPerS2: 300,
    layers: { ink: { speedMmPerS: 20, cornerMm: 0.1 } },
  },
  pen: { ...DEFAULT_PEN, overlap: "fast", contactPct: 70, fullHeightMm: 5, liftPctPerS: 100 },
} satisfies SvgSettings;
const START = `${GRBL.name} does not use these settings, because its controller plans by itself: `;

describe("a plan for Grbl", () => {
  it("names the shaper that it does not use, and draws the same", async () => {
    const { warnings, ...job } = await planned(SHAPED);
    expect(warnings).toEqual([`${START}Reduce ringing.`]);
    expect(job.lines()).toEqual((await planned({})).lines());
  });

  it("names all other settings that it does not use, and draws the same", async () => {
    const { warnings, ...job } = await planned(CHANGED);
    expect(warnings).toEqual([
      `${START}Corners, Acceleration (pen down), Corner rounding of a layer, Acceleration along y, Lifting speed, Move while the pen lifts, Tip touches at, Full lift for travels from.`,
    ]);
    expect(job.lines()).toEqual((await planned({})).lines());
  });

  it("names no settings if they are defaults or used", async () => {
    expect((await planned({})).warnings).toEqual([]);
    const draw = { ...DEFAULT_MOTION.draw, speedMmPerS: 20 };
    expect((await planned({ motion: { ...DEFAULT_MOTION, draw } })).warnings).toEqual([]);
  });

  it.each(["speedXMmPerS", "speedYMmPerS"])("uses %s, a limit of one axis", async (key) => {
    const { warnings, ...job } = await planned({ motion: { ...DEFAULT_MOTION, [key]: 10 } });
    expect(warnings).toEqual([]);
    expect(job.lines()).not.toEqual((await planned({})).lines());
  });

  it("does not use how far motion is sent ahead", () => {
    expect(usesSetting(GRBL, "sendAheadMs")).toBe(false);
    expect(usesSetting(machineById("axidraw-v3"), "sendAheadMs")).toBe(true);
  });

  it("has settings that an AxiDraw uses without a warning", () => {
    expect(unusedSettings(CHANGED, machineById("axidraw-v3"))).toEqual([]);
  });
});
