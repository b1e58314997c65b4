/**
 * A kill after which the board stops at the end of any command, on drawings of sharp corners with the pen in flight: from
 * what the board reports, the plot resumes there. Two sides of a corner are told apart up to the rounding to steps.
 */
import { describe, expect, it } from "vitest";
import { JOURNAL_S, PROGRESS_S, resumePosition } from "../../../../host/plotter/resume-position.js";
import { streamOf } from "../../../../src/drivers/ebb/compile/command-stream.js";
import { planJob, type PenSettings, type StrokePosition, type StrokeSet } from "../../../../src/index.js";
import { machineOf } from "../../../../src/internal.js";
import { positionFromMotors } from "../../../../src/machines/motors.js";
import { isPenUpBefore } from "../../../../src/plan/pen/pen-moves.js";
import { estimatedPosition } from "../../../../src/position/pen-position.js";
import { pointAt, strokeLengthMm } from "../../../../src/position/on-drawing.js";
import type { PlotSettings } from "../../../../src/schema/index.js";
import { mmOf } from "../../../support/drawings/stop-truth.js";
import { HOPS, penSettings } from "../../../support/machines/flying-pens.js";
import { strokesOf } from "../../../support/plots/local-planner.js";

/** Left out, or drawn twice, mm. */
const UNSEEN_MM = 0.05;
/** Twice the length of the sides beside a corner that are nearer to each other than one motor step, mm. */
const ALIKE_MM = 0.11;
/** How long before the stop the board had received the journal's place, s. */
const RECEIVED_S = [0.02, 0.1, JOURNAL_S + PROGRESS_S, 0.5];

/** Twelve corners with sides of `mm` and an angle of `deg`, each in another direction. */
const corners = (deg: number, mm: number): StrokeSet =>
  strokesOf(
    ...Array.from({ length: 12 }, (_, i) => {
      const [x, y] = [20 + 12 * (i % 6), 20 + 24 * Math.floor(i / 6)];
      const [from, to] = [-1, 1].map((side) => 0.3 + 0.9 * i + (side * deg * Math.PI) / 360);
      return [
        ...[x + mm * Math.cos(from), y + mm * Math.sin(from), x, y],
        ...[x + mm * Math.cos(to), y + mm * Math.sin(to)],
      ];
    }),
  );

const zigzags = (deg: number, mm: number): StrokeSet =>
  strokesOf(
    ...Array.from({ length: 6 }, (_, i) => {
      const half = (deg * Math.PI) / 360;
      return Array.from({ length: 9 }, (_unused, k) => [
        15 + 14 * i + 2 * k * mm * Math.sin(half) + (k % 2) * 0.1 * i,
        20 + (k % 2) * mm * Math.cos(half),
      ]).flat();
    }),
  );

interface Resumed {
  readonly stop: StrokePosition;
  readonly from: StrokePosition;
  readonly penUp: boolean;
  /** Left out; negative: drawn twice. */
  readonly missingMm: number;
  /** From the carriage to where the plot resumes. */
  readonly apartMm: number;
}

/** Where the plot resumes after a stop behind each of its commands. */
function resumedAfterEach(strokes: StrokeSet, settings: PlotSettings, firmware: string): Resumed[] {
  const profile = machineOf(settings);
  const job = planJob({ strokes }, settings, profile, { firmware });
  const { steps1, steps2, planS, count } = streamOf(job.commands());
  const last = strokes.offsets.length - 2;
  const placeAt = (s: number): StrokePosition =>
    estimatedPosition(job.trajectory, s) ?? { stroke: last, alongMm: strokeLengthMm(strokes, last) };
  const found: Resumed[] = [];
  for (let i = 1; i < count; i++) {
    const at = positionFromMotors(profile, steps1[i], steps2[i]);
    const stop = placeAt(planS[i + 1]);
    const penUp = isPenUpBefore(job.trajectory, planS[i + 1]);
    // At home, nothing tells this stop from one before the plot.
    if (at.x === 0 && at.y === 0) continue;
    for (const agoS of RECEIVED_S) {
      const received = placeAt(Math.max(0, planS[i + 1] - agoS));
      const machine = { foundMidPlot: { penUp, isOfRun: () => true }, speed: 1, positionMm: () => at };
      const from = resumePosition(machine, strokes, settings, [], { from: received, received });
      const missingMm = mmOf(strokes, from) - mmOf(strokes, stop);
      const { x, y } = pointAt(strokes, from);
      found.push({ stop, from, penUp, missingMm, apartMm: Math.hypot(at.x - x, at.y - y) });
    }
  }
  return found;
}

const DRAWINGS: readonly (readonly [string, StrokeSet])[] = [
  ["short strokes", HOPS],
  ...[20, 30, 47, 60, 90, 120, 150].map(
    (deg) => [`corners of ${String(deg)} degrees`, corners(deg, 9)] as const,
  ),
  ["small corners", corners(47, 2)],
  ["zigzags of 20 degrees", zigzags(20, 4)],
  ["zigzags of 40 degrees", zigzags(40, 1)],
];
const OVERLAPS = ["off", "safe", "fast"] as const satisfies readonly PenSettings["overlap"][];
const WAYS = ["2.8.1", "3.0.3"].flatMap((firmware) =>
  OVERLAPS.map((overlap) => [firmware, overlap] as const),
);

describe.each(WAYS)(
  "a plot on firmware %s with the pen's overlap %s, stopped after any command",
  (firmware, overlap) => {
    it.each(DRAWINGS)("leaves out nothing and draws nothing twice of %s", (_, strokes) => {
      const found = resumedAfterEach(strokes, penSettings(overlap), firmware);
      expect(found.length).toBeGreaterThan(400);
      expect(found.filter(({ missingMm }) => Math.abs(missingMm) > UNSEEN_MM)).toEqual([]);
    });

    it.each([3, 5, 10])(
      "leaves out nothing of corners of %s degrees, and draws only their tips twice",
      (deg) => {
        const found = resumedAfterEach(corners(deg, 9), penSettings(overlap), firmware);
        expect(found.filter(({ missingMm }) => missingMm > UNSEEN_MM)).toEqual([]);
        expect(found.filter(({ missingMm }) => missingMm < -ALIKE_MM)).toEqual([]);
      },
    );
  },
);

describe.each(["2.8.1", "3.0.3"])("a plot on firmware %s that rounds corners by 0.5 mm", (firmware) => {
  it.each([
    ["blend", "corners", corners(47, 9)],
    ["blend", "zigzags", zigzags(20, 4)],
    ["scurve", "corners", corners(47, 9)],
    ["scurve", "zigzags", zigzags(20, 4)],
  ] as const)(
    "leaves no gap in the line in mode %s, stopped after any command of sharp %s",
    (mode, _, strokes) => {
      const { motion, ...settings } = penSettings("off");
      const draw = { ...motion.draw, cornerMm: 0.5 };
      const found = resumedAfterEach(strokes, { ...settings, motion: { ...motion, mode, draw } }, firmware);
      expect(found.length).toBeGreaterThan(400);
      // Along a rounded corner the plan is shorter than the drawing.
      expect(found.filter((one) => one.missingMm > UNSEEN_MM && one.apartMm > UNSEEN_MM)).toEqual([]);
    },
  );
});

describe("a resumed plot that is killed as its pen comes down", () => {
  it("resumes at the same place, wherever it came from and whatever is drawn there later", () => {
    const strokes = strokesOf([10, 20, 50, 20], [19.85, 10, 19.85, 30]);
    const from = { stroke: 0, alongMm: 10 };
    const penDown = (x: number, y: number): StrokePosition => {
      const machine = {
        foundMidPlot: { penUp: false, isOfRun: () => true },
        speed: 1,
        positionMm: () => ({ x, y }),
      };
      return resumePosition(machine, strokes, penSettings("fast"), [], { from });
    };
    expect(penDown(19.85, 19.75)).toEqual(from);
    // Farther away than the pen comes down: it draws already.
    expect(penDown(21, 20).alongMm).toBeCloseTo(11, 6);
  });
});
