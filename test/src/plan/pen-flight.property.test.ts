/**
 * Pens that land in flight leave no mark beside a stroke, and no gap, even if the servo deviates from the planner's
 * assumptions: in its speed, its frames, and the height at which the tip touches.
 */
import { readdirSync } from "node:fs";
import path from "node:path";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { compile } from "../../../src/drivers/ebb/compile/compile.js";
import { motionForFirmware } from "../../../src/drivers/ebb/protocol/firmware-motion.js";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  machineById,
  plan,
  type MachineProfile,
  type MotionSettings,
  type PenSettings,
  type StrokeSet,
} from "../../../src/index.js";
import { MOTION_MODES, type PenOverlap } from "../../../src/internal.js";
import { strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { cases, IS_FULL } from "../../support/runs/full-run.js";
import { sampleStrokes } from "../../support/drawings/sample-strokes.js";
import { SPRINGS, swinging } from "../../support/machines/swinging.js";
import { tipMarks, type TipMarks, type TipServo } from "../../support/drawings/tip-marks.js";

const unmeasured = machineById("axidraw-v3");
const FIRMWARES = ["2.4.4", "2.5.3", "2.7.0", "2.8.1", "3.0.3"];
const SAFE_MM = 0.15;
const FAST_MM = 0.3;

const penOf = (overlap: PenOverlap, more: Partial<PenSettings> = {}): PenSettings => ({
  ...DEFAULT_PEN,
  overlap,
  ...more,
});

interface Job {
  readonly strokes: StrokeSet;
  readonly pen: PenSettings;
  readonly motion?: MotionSettings;
  readonly firmware?: string;
  readonly dropsAtStroke?: boolean;
  readonly machine?: MachineProfile;
}

/** Plans and compiles a job. The result answers what the tip of a servo draws. */
function planned(job: Job): (servo: TipServo) => TipMarks {
  const {
    strokes,
    pen,
    motion = DEFAULT_MOTION,
    firmware = "3.0.3",
    machine = unmeasured,
    dropsAtStroke,
  } = job;
  const trajectory = plan(strokes, motionForFirmware(motion, firmware), pen, { machine, dropsAtStroke });
  const stream = compile(trajectory, { machine, firmware, pen });
  return (servo) => tipMarks(trajectory, stream, machine, pen, servo);
}

const marksOf = (job: Job, servo: TipServo): TipMarks => planned(job)(servo);

/** Strokes near together and far apart: the next one begins at a random distance from the last one's end. */
const arbitraryStrokes: fc.Arbitrary<StrokeSet> = fc
  .array(
    fc.record({
      gapMm: fc.oneof(
        fc.double({ min: 0.05, max: 3, noNaN: true }),
        fc.double({ min: 1, max: 120, noNaN: true }),
      ),
      turn: fc.double({ min: 0, max: 2 * Math.PI, noNaN: true }),
      lengthMm: fc.oneof(fc.constant(0), fc.double({ min: 0.3, max: 20, noNaN: true })),
      bend: fc.double({ min: -2, max: 2, noNaN: true }),
    }),
    { minLength: 2, maxLength: 8 },
  )
  .map((parts) => {
    let [x, y] = [100, 100];
    const strokes = parts.map(({ gapMm, turn, lengthMm, bend }): Point[] => {
      x += gapMm * Math.cos(turn);
      y += gapMm * Math.sin(turn);
      if (lengthMm === 0) return [[x, y]];
      const points: Point[] = [[x, y]];
      for (let i = 0; i < 3; i++) {
        x += (lengthMm / 3) * Math.cos(turn + i * bend);
        y += (lengthMm / 3) * Math.sin(turn + i * bend);
        points.push([x, y]);
      }
      return points;
    });
    return strokeSetOf(strokes);
  });

const arbitraryServo: fc.Arbitrary<TipServo> = fc.record({
  speed: fc.oneof(fc.constantFrom(0.8, 1.2), fc.double({ min: 0.8, max: 1.2, noNaN: true })),
  phaseMs: fc.double({ min: 0, max: 24, noNaN: true }),
  contact: fc.oneof(fc.constantFrom(0.45, 0.55), fc.double({ min: 0.45, max: 0.55, noNaN: true })),
});

/** A servo as the planner assumes it, with its frames at any phase. */
const arbitraryPhase: fc.Arbitrary<TipServo> = fc
  .double({ min: 0, max: 24, noNaN: true })
  .map((phaseMs) => ({ speed: 1, phaseMs, contact: 0.5 }));

const arbitraryJob = (overlap: PenOverlap): fc.Arbitrary<Job> =>
  fc.record({
    strokes: arbitraryStrokes,
    pen: fc
      .record({
        liftMs: fc.integer({ min: 100, max: 400 }),
        dropMs: fc.integer({ min: 100, max: 500 }),
        fullHeightMm: fc.constantFrom(0, 5, 20, 1_000),
      })
      .map((more) => penOf(overlap, more)),
    motion: fc
      .record({ mode: fc.constantFrom(...MOTION_MODES), accel: fc.integer({ min: 200, max: 1_000 }) })
      .map(({ mode, accel }) => ({
        ...DEFAULT_MOTION,
        mode,
        travel: { ...DEFAULT_MOTION.travel, accelMmPerS2: accel },
      })),
    firmware: fc.constantFrom(...FIRMWARES),
    dropsAtStroke: fc.boolean(),
  });

/** The motion is shaped for a machine that swings. */
const shaped = (jobs: fc.Arbitrary<Job>, shaper: "zv" | "ei"): fc.Arbitrary<Job> =>
  fc
    .tuple(jobs, fc.constantFrom(...SPRINGS), fc.constantFrom("junction", "blend"))
    .map(([job, springs, mode]): Job => ({
      ...job,
      motion: { ...(job.motion ?? DEFAULT_MOTION), mode, shaper },
      firmware: job.firmware === "2.4.4" ? "2.5.3" : (job.firmware ?? "3.0.3"),
      machine: swinging(springs),
    }));

/** The longest marks of all drawings; the full run prints them. */
class Longest {
  private strayMm = 0;
  private lateMm = 0;

  constructor(private readonly what: string) {}

  note({ strayMm, lateMm }: TipMarks): void {
    this.strayMm = Math.max(this.strayMm, strayMm);
    this.lateMm = Math.max(this.lateMm, lateMm);
  }

  print(): void {
    if (IS_FULL) console.info(`${this.what}: stray ${this.strayMm} mm, late ${this.lateMm} mm`);
  }
}

describe("random drawings", () => {
  it("have no stray marks and late starts in mode safe, even if the servo deviates", () => {
    const longest = new Longest("random drawings, safe");
    fc.assert(
      fc.property(arbitraryJob("safe"), arbitraryServo, (job, servo) => {
        const marks = marksOf(job, servo);
        longest.note(marks);
        expect(marks.strayMm).toBeLessThanOrEqual(SAFE_MM);
        expect(marks.lateMm).toBeLessThanOrEqual(SAFE_MM);
        expect(marks.brokenCount).toBe(0);
      }),
      { numRuns: cases() },
    );
    longest.print();
  });

  it("have at most 0.3 mm of marks and late starts in mode fast if the servo does not deviate", () => {
    const longest = new Longest("random drawings, fast");
    fc.assert(
      fc.property(arbitraryJob("fast"), arbitraryPhase, (job, servo) => {
        const marks = marksOf(job, servo);
        longest.note(marks);
        expect(marks.strayMm).toBeLessThanOrEqual(FAST_MM);
        expect(marks.lateMm).toBeLessThanOrEqual(FAST_MM);
        expect(marks.brokenCount).toBe(0);
      }),
      { numRuns: cases() },
    );
    longest.print();
  });

  it.each([
    ["safe", SAFE_MM, "zv"],
    ["fast", FAST_MM, "zv"],
    ["safe", SAFE_MM, "ei"],
  ] as const)(
    "are drawn as well when the motion is shaped: %s, within %d mm, by %s",
    (overlap, mm, shaper) => {
      const servos = overlap === "safe" ? arbitraryServo : arbitraryPhase;
      fc.assert(
        fc.property(shaped(arbitraryJob(overlap), shaper), servos, (job, servo) => {
          const marks = marksOf(job, servo);
          expect(marks.strayMm).toBeLessThanOrEqual(mm);
          expect(marks.lateMm).toBeLessThanOrEqual(mm);
          expect(marks.brokenCount).toBe(0);
        }),
        { numRuns: cases(1_000, 60) },
      );
    },
  );
});

const FOLDER = path.join(import.meta.dirname, "..", "..", "..", "samples");
/** Moonrise takes longer than all the others together: only the full run has it here. */
const samples = readdirSync(FOLDER)
  .flatMap((name) => (name.endsWith(".svg") ? name.slice(0, -4) : []))
  .filter((name) => IS_FULL || name !== "moonrise");
const STATED: TipServo = { speed: 1, phaseMs: 23, contact: 0.5 };
/** As slow and as fast as the pen's settings allow for; the full run also has them with the other contact. */
const EXTREMES: readonly TipServo[] = [
  { speed: 0.8, phaseMs: 1, contact: 0.55 },
  { speed: 1.2, phaseMs: 7, contact: 0.45 },
  { speed: 1.2, phaseMs: 13, contact: 0.55 },
  { speed: 0.8, phaseMs: 23, contact: 0.45 },
].slice(0, cases(4, 2));

describe.each(samples)("the sample %s", (name) => {
  const strokes = sampleStrokes(name);
  const safe = planned({ strokes, pen: penOf("safe") });

  it.each(EXTREMES)(
    "is drawn safely by a servo with $speed times the speed whose pen touches at $contact",
    (servo) => {
      const marks = safe(servo);
      expect(marks.strayMm).toBeLessThanOrEqual(SAFE_MM);
      expect(marks.lateMm).toBeLessThanOrEqual(SAFE_MM);
      expect(marks.brokenCount).toBe(0);
    },
  );

  it("is drawn in mode fast by a servo that does not deviate", () => {
    const marks = marksOf({ strokes, pen: penOf("fast") }, STATED);
    expect(marks.strayMm).toBeLessThanOrEqual(FAST_MM);
    expect(marks.lateMm).toBeLessThanOrEqual(FAST_MM);
    expect(marks.brokenCount).toBe(0);
  });

  it("takes less time with more overlap", () => {
    const [off, safe, fast] = (["off", "safe", "fast"] as const).map(
      (overlap) => plan(strokes, DEFAULT_MOTION, penOf(overlap), { machine: unmeasured }).totalS,
    );
    expect(safe).toBeLessThan(off);
    expect(fast).toBeLessThan(safe);
  });
});

describe("the check itself", () => {
  it("detects a planner that assumes that the tip is clear at 30 % of the lift", () => {
    const strokes = sampleStrokes("flower-meadow");
    const marks = marksOf({ strokes, pen: penOf("fast", { contactPct: 30 }) }, STATED);
    expect(marks.strayMm).toBeGreaterThan(SAFE_MM);
  });

  it("finds nothing where the carriage waits for the pen", () => {
    const strokes = sampleStrokes("hello-paper");
    const marks = marksOf({ strokes, pen: penOf("off") }, STATED);
    expect(marks.strayMm).toBeLessThan(1e-9);
    expect([marks.lateMm, marks.brokenCount]).toEqual([0, 0]);
  });
});

it("the sample moonrise takes at most 5 000 s in mode safe and 4 300 s in mode fast", () => {
  const strokes = sampleStrokes("moonrise");
  const [safe, fast] = (["safe", "fast"] as const).map(
    (overlap) => plan(strokes, DEFAULT_MOTION, penOf(overlap), { machine: unmeasured }).totalS,
  );
  expect(safe).toBeLessThanOrEqual(5_000);
  expect(fast).toBeLessThanOrEqual(4_300);
});
