/**
 * Pens that land in flight leave no mark beside a stroke, and no gap, even if the servo deviates from that of the machine's
 * profile: in its speed, its frames, and the height at which the tip touches.
 */
import { readdirSync } from "node:fs";
import path from "node:path";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { compile } from "../../../src/drivers/ebb/compile/compile.js";
import {
  dropsAtStroke as mustDropAtStroke,
  motionForFirmware,
} from "../../../src/drivers/ebb/protocol/firmware-motion.js";
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
import { HOBBY_SERVO } from "../../../src/machines/pen-servo.js";
import { MOTION_MODES, type PenOverlap } from "../../../src/internal.js";
import { strokeCount } from "../../../src/drawing/stroke-set.js";
import { strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { cases, IS_FULL } from "../../support/runs/full-run.js";
import { sampleStrokes } from "../../support/drawings/sample-strokes.js";
import { SPRINGS, swinging } from "../../support/machines/swinging.js";
import { tipMarks, type TipMarks, type TipServo } from "../../support/drawings/tip-marks.js";

const unmeasured = machineById("axidraw-v3");
const FIRMWARES = ["2.4.4", "2.5.3", "2.7.0", "2.8.1", "3.0.3"];
/** Longest mark beside a stroke. */
const STRAY_MM = 0.15;
/** No stroke begins visibly late: an old board's shortest command may delay a drop by some ms. */
const LATE_MM = 0.02;

/** An AxiDraw, with a slower servo, and with the brushless upgrade and a NextDraw (S2, 3 ms frames). */
const MACHINES: readonly MachineProfile[] = [
  unmeasured,
  machineById("nextdraw-8511"),
  machineById("axidraw-v3-brushless"),
  { ...unmeasured, penServo: HOBBY_SERVO },
];

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
  const trajectory = plan(strokes, motionForFirmware(motion, firmware), pen, {
    machine,
    // As jobs are planned for such firmware; newer one is also tried that way.
    dropsAtStroke: dropsAtStroke || mustDropAtStroke(firmware),
  });
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

const arbitraryJob = (overlap: PenOverlap): fc.Arbitrary<Job> =>
  fc.record({
    strokes: arbitraryStrokes,
    pen: fc
      .record({
        downPct: fc.integer({ min: 0, max: 50 }),
        wayPct: fc.integer({ min: 3, max: 50 }),
        fullHeightMm: fc.constantFrom(0, 5, 20, 1_000),
        extraLiftMs: fc.constantFrom(0, 0, -30, 50),
        extraDropMs: fc.constantFrom(0, 0, -30, 50),
      })
      .map(({ downPct, wayPct, ...more }) => penOf(overlap, { downPct, upPct: downPct + wayPct, ...more })),
    motion: fc
      .record({ mode: fc.constantFrom(...MOTION_MODES), accel: fc.integer({ min: 200, max: 1_000 }) })
      .map(({ mode, accel }) => ({
        ...DEFAULT_MOTION,
        mode,
        travel: { ...DEFAULT_MOTION.travel, accelMmPerS2: accel },
      })),
    firmware: fc.constantFrom(...FIRMWARES),
    dropsAtStroke: fc.boolean(),
    machine: fc.constantFrom(...MACHINES),
  });

/**
 * Short travels with a pen that always goes to its full height: a slow servo may still be rising when it is lowered to the hop
 * height.
 */
const lowHops: fc.Arbitrary<StrokeSet> = fc
  .array(fc.double({ min: 0.2, max: 6, noNaN: true }), { minLength: 4, maxLength: 8 })
  .map((gapsMm) => {
    let x = 20;
    return strokeSetOf(gapsMm.map((gapMm): Point[] => [[(x += gapMm), 50], [(x += 1), 50]])); // prettier-ignore
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

function expectClean({ strayMm, lateMm, brokenCount }: TipMarks): void {
  expect(strayMm).toBeLessThanOrEqual(STRAY_MM);
  expect(lateMm).toBeLessThanOrEqual(LATE_MM);
  expect(brokenCount).toBe(0);
}

describe("random drawings", () => {
  it.each(["safe", "fast"] as const)(
    "have no stray marks and late starts in mode %s, even if the servo deviates",
    (overlap) => {
      const longest = new Longest(`random drawings, ${overlap}`);
      fc.assert(
        fc.property(arbitraryJob(overlap), arbitraryServo, (job, servo) => {
          const marks = marksOf(job, servo);
          longest.note(marks);
          expectClean(marks);
        }),
        { numRuns: cases() },
      );
      longest.print();
    },
  );

  it.each(["safe", "fast"] as const)(
    "have no stray marks in mode %s where a servo is lowered to its hop height before it has reached the full one",
    (overlap) => {
      const jobs = fc
        .tuple(arbitraryJob(overlap), lowHops)
        .map(([job, strokes]): Job => ({ ...job, strokes, pen: { ...job.pen, fullHeightMm: 0 } }));
      fc.assert(
        fc.property(jobs, arbitraryServo, (job, servo) => expectClean(marksOf(job, servo))),
        { numRuns: cases(3_000, 300) },
      );
    },
  );

  it.each(["safe", "fast"] as const)(
    "have no stray marks and late starts in mode %s in layers with heights of their own",
    (overlap) => {
      const onPaper = fc.record({
        paperPct: fc.integer({ min: 30, max: 70 }),
        halfPct: fc.integer({ min: 2, max: 10 }),
      });
      const widths = fc.array(fc.integer({ min: 1, max: 3 }), { minLength: 3, maxLength: 3 });
      const jobs = fc
        .tuple(arbitraryJob(overlap), onPaper, widths)
        .map(([job, { paperPct, halfPct }, factors]): Job => {
          // One tip on one paper: every layer touches it at the same height, in the middle between its own two.
          const heights = (half: number) => ({ downPct: paperPct - half, upPct: paperPct + half });
          const layers = factors.map((_, i) => ({ id: `l${i}`, name: `Layer ${i}`, color: null }));
          const own = Object.fromEntries(factors.map((factor, i) => [`l${i}`, heights(factor * halfPct)]));
          const layer = job.strokes.layer.map((_, i) => Math.min(factors.length - 1, i >> 1));
          return {
            ...job,
            strokes: { ...job.strokes, layer, layers },
            pen: { ...job.pen, ...heights(halfPct), layers: own },
          };
        });
      fc.assert(
        fc.property(jobs, arbitraryServo, (job, servo) => expectClean(marksOf(job, servo))),
        { numRuns: cases(3_000, 300) },
      );
    },
  );

  it.each([
    ["safe", "zv"],
    ["fast", "zv"],
    ["safe", "ei"],
  ] as const)("are drawn as well when the motion is shaped: %s, by %s", (overlap, shaper) => {
    fc.assert(
      fc.property(shaped(arbitraryJob(overlap), shaper), arbitraryServo, (job, servo) =>
        expectClean(marksOf(job, servo)),
      ),
      { numRuns: cases(1_000, 60) },
    );
  });
});

const FOLDER = path.join(import.meta.dirname, "..", "..", "..", "samples");
/** Moonrise takes longer than all the others together: only the full run has it here. */
const samples = readdirSync(FOLDER)
  .flatMap((name) => (name.endsWith(".svg") ? name.slice(0, -4) : []))
  .filter((name) => IS_FULL || name !== "moonrise");
/** As slow and as fast as the planner allows for; the full run also has them with the other contact. */
const EXTREMES: readonly TipServo[] = [
  { speed: 0.8, phaseMs: 1, contact: 0.55 },
  { speed: 1.2, phaseMs: 7, contact: 0.45 },
  { speed: 1.2, phaseMs: 13, contact: 0.55 },
  { speed: 0.8, phaseMs: 23, contact: 0.45 },
].slice(0, cases(4, 2));

describe.each(samples)("the sample %s", async (name) => {
  const strokes = await sampleStrokes(name);
  const jobs = (["safe", "fast"] as const).map((overlap) => planned({ strokes, pen: penOf(overlap) }));

  it.each(EXTREMES)(
    "is drawn by a servo with $speed times the speed whose pen touches at $contact, in modes safe and fast",
    (servo) => {
      for (const marks of jobs) expectClean(marks(servo));
    },
  );

  it("takes less time with more overlap", () => {
    const [off, safe, fast] = (["off", "safe", "fast"] as const).map(
      (overlap) => plan(strokes, DEFAULT_MOTION, penOf(overlap), { machine: unmeasured }).totalS,
    );
    expect(safe).toBeLessThan(off);
    // A drawing of a single stroke has only its last lift in flight.
    if (strokeCount(strokes) > 1) expect(fast).toBeLessThan(safe);
    else expect(fast).toBe(safe);
  });
});

describe("the check itself", () => {
  const slow: TipServo = { speed: 0.8, phaseMs: 23, contact: 0.55 };

  it("detects a planner that assumes that the tip is clear at 20 % of the lift", async () => {
    const strokes = await sampleStrokes("flower-meadow");
    const marks = marksOf({ strokes, pen: penOf("fast", { contactPct: 20 }) }, slow);
    expect(marks.strayMm).toBeGreaterThan(STRAY_MM);
  });

  it("detects a servo that is slower than the planner allows for", async () => {
    const strokes = await sampleStrokes("flower-meadow");
    const marks = marksOf({ strokes, pen: penOf("fast") }, { ...slow, speed: 0.6 });
    expect(marks.strayMm + marks.lateMm).toBeGreaterThan(STRAY_MM);
  });

  it("finds nothing where the carriage waits for the pen", async () => {
    const strokes = await sampleStrokes("hello-paper");
    const marks = marksOf({ strokes, pen: penOf("off") }, { speed: 1, phaseMs: 23, contact: 0.5 });
    expect(marks.strayMm).toBeLessThan(1e-9);
    expect([marks.lateMm, marks.brokenCount]).toEqual([0, 0]);
  });
});

it("the samples take the time that the servo of their machine needs", async () => {
  const secondsOf = async (name: string, machine: string): Promise<number> =>
    plan(await sampleStrokes(name), DEFAULT_MOTION, DEFAULT_PEN, { machine: machineById(machine) }).totalS;
  expect(await secondsOf("moonrise", "axidraw-v3")).toBeLessThanOrEqual(3_760);
  expect(await secondsOf("moonrise", "nextdraw-8511")).toBeLessThanOrEqual(2_530);
  expect(await secondsOf("hello-paper", "axidraw-v3")).toBeLessThanOrEqual(455);
  expect(await secondsOf("hello-paper", "nextdraw-8511")).toBeLessThanOrEqual(342);
});
