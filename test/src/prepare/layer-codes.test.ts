import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { NO_CODES, formatLayerName, parseLayerName } from "../../../src/prepare/layers/layer-codes.js";
import { cases } from "../../support/runs/full-run.js";

/** Only what differs from a plain name. */
const read = (name: string): object => {
  const codes = parseLayerName(name);
  return Object.fromEntries(
    Object.entries(codes).filter(([key, value]) => value !== NO_CODES[key as keyof typeof NO_CODES]),
  );
};

describe("parseLayerName", () => {
  it.each([
    ["outline", { text: "outline" }],
    ["", {}],
    ["%notes", { skip: true, text: "notes" }],
    ["%5+h10", { skip: true, text: "5+h10" }],
    ["!red", { pause: true, text: "red" }],
    ["!%red", { pause: true, text: "%red" }],
    ["12 blue", { number: 12, text: " blue" }],
    [
      "!3+h30+s50+d250 fine",
      { pause: true, number: 3, penDownPct: 30, drawSpeedPct: 50, delayMs: 250, text: " fine" },
    ],
    ["5+S80+H0", { number: 5, drawSpeedPct: 80, penDownPct: 0 }],
    ["+h10+h20", { penDownPct: 20 }],
    ["+h10+h101", { penDownPct: 10 }],
    ["+s0", {}],
    ["+s110", { drawSpeedPct: 110 }],
    ["+s111", {}],
    ["+d0", {}],
    ["+d9000", { delayMs: 9000 }],
    ["+hx", { text: "x" }],
    ["+h", { text: "+h" }],
    ["+h30 +s50", { penDownPct: 30, text: " +s50" }],
    ["pen +h30", { text: "pen +h30" }],
    [" %notes", { text: " %notes" }],
    ["+x5", { text: "+x5" }],
    ["2+v50 slow", { number: 2, speedSharePct: 50, text: " slow" }],
    ["+v0+v101", {}],
  ])("reads %j", (name, expected) => {
    expect(read(name)).toEqual(expected);
  });
});

describe("formatLayerName", () => {
  it("writes codes in the order d, h, s", () => {
    expect(
      formatLayerName({
        ...NO_CODES,
        pause: true,
        number: 2,
        drawSpeedPct: 50,
        penDownPct: 30,
        delayMs: 9,
        text: " a",
      }),
    ).toBe("!2+d9+h30+s50 a");
  });

  it("writes names that read back the same, except for a space where text looks like a code", () => {
    const maybe = (min: number, max: number): fc.Arbitrary<number | null> =>
      fc.option(fc.integer({ min, max }), { nil: null });
    const codes = fc.record({
      skip: fc.constant(false),
      pause: fc.boolean(),
      number: maybe(0, 1000),
      penDownPct: maybe(0, 100),
      drawSpeedPct: maybe(1, 110),
      speedSharePct: maybe(1, 100),
      delayMs: maybe(1, 5000),
      text: fc.oneof(fc.string(), fc.constantFrom("%x", "!x", "7", "+h5", "+s", "+S9 a", " 8")),
    });
    fc.assert(
      fc.property(codes, (given) => {
        const back = parseLayerName(formatLayerName(given));
        expect({ ...back, text: back.text.trim() }).toEqual({ ...given, text: given.text.trim() });
      }),
      { numRuns: cases() },
    );
    expect(parseLayerName(formatLayerName({ ...NO_CODES, skip: true, text: "!x" }))).toEqual({
      ...NO_CODES,
      skip: true,
      text: "!x",
    });
  });
});
