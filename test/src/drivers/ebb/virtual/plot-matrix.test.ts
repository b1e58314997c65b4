/**
 * The samples × every generation of firmware × every mode, several plots in a row each without homing. All of
 * it takes minutes: PLOTWRIGHT_MATRIX=all (npm run test:matrix, and test:full), or one firmware version.
 * Otherwise a part in which each sample, and each firmware in each mode, occurs at least once.
 */
import { afterAll, describe, expect, it } from "vitest";
import {
  ALLOWED_MM,
  allowedJump,
  FIRMWARE,
  MODES,
  plotOften,
  SAMPLES,
  worstTable,
  type MatrixRow,
  type Sample,
} from "../../../../support/plots/plot-matrix.js";
import { cases, IS_FULL } from "../../../../support/runs/full-run.js";

const asked = process.env["PLOTWRIGHT_MATRIX"] ?? (IS_FULL ? "all" : undefined);
const isWhole = asked !== undefined;
const PLOTS = cases(3, 2);
/** The quick ones are used where any sample will do. */
const QUICK: readonly Sample[] = ["hello-paper", "three-colour-hills"];
const rows: MatrixRow[] = [];

const combinations = FIRMWARE.flatMap((firmware, f) => {
  if (isWhole && asked !== "all" && asked !== firmware) return [];
  return MODES.flatMap((mode, m) => {
    const often = QUICK[(f + m) % QUICK.length];
    // Each of the others once: along the diagonal of newer firmware.
    const others = SAMPLES.filter((sample) => !QUICK.includes(sample));
    const once = m === f % MODES.length && others[f - 2] ? others[f - 2] : often;
    return (isWhole ? SAMPLES : [once]).map((sample) => ({ sample, firmware, mode }));
  });
});

describe(`a sample plotted ${PLOTS} times in a row`, () => {
  it.each(combinations)(
    "is $sample, exact to the step on firmware $firmware in $mode",
    async (combination) => {
      const { sample, firmware, mode } = combination;
      const row = await plotOften(sample, firmware, mode, PLOTS);
      rows.push(row);
      expect(row).toMatchObject({ firstWrong: null, endSteps: [0, 0], errors: [] });
      expect(row.timeShare).toBeLessThan(0.002);
      expect(row.offMm).toBeLessThan(ALLOWED_MM);
      expect(row.missedMm).toBeLessThan(ALLOWED_MM);
      expect(row.jumpMmPerS).toBeLessThanOrEqual(allowedJump(mode, firmware) ?? Infinity);
    },
  );

  // The most commands per second are those of scurve.
  const ANY_IDLE = (isWhole ? SAMPLES : QUICK).flatMap((sample) =>
    (isWhole ? MODES : (["scurve"] as const)).map((mode) => ({ sample, mode })),
  );
  it.each(ANY_IDLE)(
    "is $sample, exact to the step in $mode on a 3.1.7 that idles after timed commands after all",
    async ({ sample, mode }) => {
      const row = await plotOften(sample, "3.1.7", mode, 1, 1);
      expect(row).toMatchObject({ firstWrong: null, endSteps: [0, 0], errors: [] });
      expect(row.timeShare).toBeLessThan(0.002);
    },
  );

  it("covers each sample, and each firmware in each mode", () => {
    expect(new Set(combinations.map(({ sample }) => sample)).size).toBe(SAMPLES.length);
    const firmwareCount = isWhole && asked !== "all" ? 1 : FIRMWARE.length;
    const pairs = new Set(combinations.map(({ firmware, mode }) => `${firmware} ${mode}`));
    expect(pairs.size).toBe(firmwareCount * MODES.length);
  });
});

afterAll(() => {
  // The table of docs/ebb.md, printed by a full run.
  if (isWhole) process.stdout.write(`\n${worstTable(rows)}\n`);
});
