/** No stroke leaves the paper unless that was allowed, whatever places the drawing. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { PlotwrightError } from "../../../src/errors.js";
import { prepareJob } from "../../../src/job/prepare-job.js";
import { machineById } from "../../../src/machines/profiles.js";
import { turnedOntoPaper } from "../../../src/prepare/files-page.js";
import { layOutDrawing } from "../../../src/prepare/layout.js";
import { isReached } from "../../../src/prepare/on-paper.js";
import { NO_PENS } from "../../../src/prepare/layers/pens.js";
import { prepare, type Prepared } from "../../../src/prepare/prepare.js";
import { DEFAULT_MOTION } from "../../../src/settings/motion.js";
import { DEFAULT_PEN } from "../../../src/settings/pen.js";
import { DEFAULT_PREPARE, type PrepareSettings } from "../../../src/settings/prepare.js";
import { drawingOf } from "../../support/drawings/drawings.js";
import { cases } from "../../support/runs/full-run.js";

/** Reaches any paper. */
const MACHINE = { ...machineById("axidraw-v3"), widthMm: 10_000, heightMm: 10_000 };
/** Half a pen's width; left and top are home, which the carriage can't pass. */
const TOLERANCE_MM = 0.5;
const HOME_TOLERANCE_MM = 0.01;
/** Rounding of areas. */
const ROUNDING_MM = 1e-3;

const mm = fc.oneof(fc.integer({ min: -60, max: 260 }), fc.double({ min: -60, max: 260, noNaN: true }));
const shape = fc
  .record({
    points: fc.array(fc.tuple(mm, mm), { minLength: 1, maxLength: 5 }),
    curve: fc.boolean(),
    isFilled: fc.boolean(),
    group: fc.nat(1),
    dash: fc.constantFrom(-1, 0),
  })
  .map(({ points, curve, isFilled, group, dash }) => {
    const [[x, y], ...rest] = points;
    const steps = rest.map(([u, v]) => (curve ? `C${u} ${y} ${x} ${v} ${u} ${v}` : `L${u} ${v}`)).join("");
    return { d: `M${x} ${y}${steps}${isFilled ? "Z" : ""}`, group, dash, fill: isFilled ? "#123456" : null };
  });
const drawing = fc
  .record({
    shapes: fc.array(shape, { minLength: 1, maxLength: 5 }),
    widthMm: fc.constantFrom(50, 100, 148, 210, 210.08, 297, 420),
    heightMm: fc.constantFrom(50, 100, 148, 210, 297, 297.13, 420),
    pageFrom: fc.constantFrom("extent" as const, "proportions" as const, undefined),
  })
  .map(({ shapes, widthMm, heightMm, pageFrom }) => ({
    ...drawingOf(shapes, { widthMm, heightMm, groups: ["a", "b"], dashes: [{ lengths: [7, 3], offset: 1 }] }),
    ...(pageFrom ? { pageFrom } : {}),
  }));

const settings = fc.record({
  paper: fc.constantFrom(
    { widthMm: 210, heightMm: 297 },
    { widthMm: 148, heightMm: 210 },
    { widthMm: 100, heightMm: 100 },
    { widthMm: 60, heightMm: 400 },
  ),
  landscape: fc.boolean(),
  marginMm: fc.constantFrom(0, 15),
  fit: fc.constantFrom("auto" as const, true, false),
  rotateDeg: fc.constantFrom("auto" as const, 0, 90, 33, 180, -90),
  mirror: fc.constantFrom("none" as const, "leftRight" as const, "upDown" as const),
  layout: fc.option(
    fc.record({
      xMm: fc.integer({ min: -50, max: 200 }),
      yMm: fc.integer({ min: -50, max: 200 }),
      widthMm: fc.option(fc.integer({ min: 5, max: 300 })),
      heightMm: fc.option(fc.integer({ min: 5, max: 300 })),
      turnDeg: fc.constantFrom(0, 30, 90, 200),
    }),
    { nil: null, freq: 3 },
  ),
  clipToMargins: fc.boolean(),
  cropToPage: fc.boolean(),
  hatch: fc.constantFrom(
    { spacingMm: 0, angleDeg: 0, cross: false },
    { spacingMm: 4, angleDeg: 30, cross: true },
  ),
  hideCovered: fc.boolean(),
  smoothRounds: fc.constantFrom(0, 1),
  joinMm: fc.constantFrom(0, 5),
  layerRepeats: fc.constantFrom({}, { g0: 2 }),
  hiddenLayers: fc.constantFrom([], ["g1"]),
  layerShifts: fc.constantFrom({}, { g0: { xMm: 40, yMm: -3 } }),
});

/** By how much the ink of a stroke leaves the paper at any edge, more than what counts as its edge, mm. */
function mostOutside({ strokes, paperWidthMm, paperHeightMm }: Prepared): number {
  let most = 0;
  for (let i = 0; i < strokes.layer.length; i++) {
    const shift = strokes.layers[strokes.layer[i]].shiftMm ?? { x: 0, y: 0 };
    for (let p = strokes.offsets[i]; p < strokes.offsets[i + 1]; p++) {
      const x = strokes.xy[2 * p] - shift.x;
      const y = strokes.xy[2 * p + 1] - shift.y;
      const beforeHome = Math.max(-x, -y) - HOME_TOLERANCE_MM;
      most = Math.max(most, beforeHome, x - paperWidthMm - TOLERANCE_MM, y - paperHeightMm - TOLERANCE_MM);
    }
  }
  return most;
}

/** The job's strokes, or the message with which it was refused for leaving the paper. */
function jobOf(
  from: ReturnType<typeof drawingOf>,
  some: Partial<PrepareSettings>,
  machine = MACHINE,
): Prepared | string {
  const whole = { motion: DEFAULT_MOTION, pen: DEFAULT_PEN, ...NO_PENS };
  const all = { ...whole, prepare: { ...DEFAULT_PREPARE, ...some } };
  try {
    return { ...prepareJob(from, all, machine).prepared };
  } catch (error) {
    if (!(error instanceof PlotwrightError)) throw error;
    return error.message;
  }
}

describe("any drawing, placed in any way on any paper", () => {
  it("is refused, with figures and choices, exactly if a stroke leaves the paper", () => {
    fc.assert(
      fc.property(drawing, settings, (from, some) => {
        const free = prepare(from, { ...some, outside: "refuse" });
        const isOutside = mostOutside(free) > 0;
        expect(free.outside !== null).toBe(isOutside);
        const job = jobOf(from, some);
        if (typeof job !== "string") expect(mostOutside(job)).toBe(0);
        if (isOutside) expect(job).toMatch(/ strokes? reach(es)? up to .* mm over its .* --outside/);
        else if (typeof job === "string") expect(job).not.toContain("--outside");
      }),
      { numRuns: cases(400) },
    );
  });

  it("stays on the paper if it is cut, moved or fitted; one that is larger can't be moved", () => {
    const mode = fc.constantFrom("cut" as const, "move" as const, "fit" as const);
    fc.assert(
      fc.property(drawing, settings, mode, (from, some, outside) => {
        const prepared = prepare(from, { ...some, outside });
        if (mostOutside(prepared) > ROUNDING_MM) {
          expect([outside, prepared.outside?.canMove]).toEqual(["move", false]);
        }
      }),
      { numRuns: cases(400) },
    );
  });

  it("is advised to be cut, moved or drawn there only where that helps", () => {
    const advised = { cut: 0, move: 0, allow: 0 };
    const reach = { ...MACHINE, widthMm: 300, heightMm: 260 };
    fc.assert(
      fc.property(drawing, settings, (from, some) => {
        const refused = jobOf(from, some, reach);
        if (typeof refused !== "string" || !refused.includes("--outside")) return;
        for (const outside of ["cut", "move", "allow"] as const) {
          if (!refused.includes(`${outside} (`)) continue;
          advised[outside]++;
          const job = jobOf(from, { ...some, outside }, reach);
          if (typeof job === "string") expect(job).not.toMatch(/--outside|There is nothing to draw|is left/);
          if (outside === "allow") expect(job).toHaveProperty("strokes");
        }
      }),
      { numRuns: cases(400) },
    );
    expect(Math.min(...Object.values(advised))).toBeGreaterThan(0);
  });

  it("is turned onto the paper at its size, within the machine's reach, wherever a turn is offered", () => {
    let offered = 0;
    fc.assert(
      fc.property(drawing, settings, (from, some) => {
        const plain = { ...DEFAULT_PREPARE, ...some, outside: "refuse" as const };
        const reach = { widthMm: 300, heightMm: 260 };
        const turn = turnedOntoPaper(from, plain, reach);
        if (turn === null) return;
        offered++;
        const before = prepare(from, plain).size;
        const after = prepare(from, { ...plain, ...turn });
        expect(mostOutside(after)).toBeLessThan(ROUNDING_MM);
        expect([after.size.scaleX, after.size.scaleY].map((scale) => scale.toFixed(6))).toEqual(
          [before.scaleX, before.scaleY].map((scale) => scale.toFixed(6)),
        );
        const { content } = layOutDrawing(from, { ...plain, ...turn });
        expect(isReached(content, reach)).toBe(true);
      }),
      { numRuns: cases(400) },
    );
    expect(offered).toBeGreaterThan(0);
  });

  it("is drawn as it lies if that is allowed, and moved without any other change", () => {
    fc.assert(
      fc.property(drawing, settings, (from, some) => {
        const free = prepare(from, some);
        const allowed = prepare(from, { ...some, outside: "allow" });
        // Beside the paper a refused drawing has no dashes and hatches further away than 1 m.
        expect([...allowed.strokes.xy]).toEqual([...free.strokes.xy]);
        // Areas are rounded where they lie.
        const hatch = DEFAULT_PREPARE.hatch;
        const uncut = { ...some, clipToMargins: false, cropToPage: false, hideCovered: false, hatch };
        const moved = prepare(from, { ...uncut, outside: "move" });
        const still = prepare(from, uncut);
        expect(moved.size.widthMm).toBeCloseTo(still.size.widthMm, 3);
        expect(moved.size.scaleX).toBeCloseTo(still.size.scaleX, 9);
      }),
      { numRuns: cases(200) },
    );
  });
});
