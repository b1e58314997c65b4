import { describe, expect, it } from "vitest";
import {
  formatCount,
  formatDuration,
  formatFixed,
  formatLength,
  formatMoment,
  formatPercent,
  parseNumber,
} from "../../web/ui/format.js";

const plain = (text: string): string => text.replace(/\u202f/g, " ");

describe("durations", () => {
  it("are read in the unit that suits them", () => {
    expect(plain(formatDuration(0))).toBe("0 s");
    expect(plain(formatDuration(42.4))).toBe("42 s");
    expect(plain(formatDuration(185))).toBe("3:05 min");
    expect(plain(formatDuration(2 * 3600 + 7 * 60))).toBe("2:07 h");
  });

  it("never show sixty seconds or sixty minutes", () => {
    expect(plain(formatDuration(59.7))).toBe("1:00 min");
    expect(plain(formatDuration(3599.6))).toBe("1:00 h");
    expect(plain(formatDuration(7199))).toBe("2:00 h");
  });

  it("show a dash for what is no duration", () => {
    expect(formatDuration(Number.NaN)).toBe("–");
    expect(formatDuration(-1)).toBe("–");
  });
});

describe("moments of a plot", () => {
  it("have tenths under an hour and seconds above", () => {
    expect(formatMoment(3.47)).toBe("0:03.4");
    expect(formatMoment(605)).toBe("10:05.0");
    expect(formatMoment(3723.9)).toBe("1:02:03");
  });
});

describe("lengths and counts", () => {
  it("change from mm to m to km", () => {
    expect(plain(formatLength(420))).toBe("420 mm");
    expect(plain(formatLength(3140))).toBe("3.1 m");
    expect(plain(formatLength(250_000))).toBe("250 m");
    expect(plain(formatLength(1_234_000))).toBe("1.23 km");
  });

  it("have no sign where they round to zero", () => {
    expect(formatFixed(-0.04, 1)).toBe("0.0");
    expect(formatFixed(-0, 1)).toBe("0.0");
    expect(formatFixed(-0.05001, 1)).toBe("-0.1");
    expect(formatFixed(-10, 1)).toBe("-10.0");
  });

  it("have spaces between thousands", () => {
    expect(plain(formatCount(1_234_567))).toBe("1 234 567");
    expect(plain(formatCount(999))).toBe("999");
  });

  it("say 100 % only when all is done", () => {
    expect(plain(formatPercent(0.9999))).toBe("99 %");
    expect(plain(formatPercent(1))).toBe("100 %");
  });
});

describe("typed numbers", () => {
  it.each([
    ["12", 12],
    ["12,5", 12.5],
    [" 1 200 ", 1200],
    ["-.5", -0.5],
    ["+3.", 3],
  ])("reads %j", (typed, number) => {
    expect(parseNumber(typed)).toBe(number);
  });

  it.each(["", "abc", "1.2.3", "1e9999", "Infinity", "0x10", "--1"])("refuses %j", (typed) => {
    expect(parseNumber(typed)).toBeNull();
  });
});
