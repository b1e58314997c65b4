import { describe, expect, it } from "vitest";
import {
  formatClockIn,
  formatCount,
  formatDuration,
  formatFixed,
  formatLength,
  formatMoment,
  formatPercent,
  formatWhen,
  parseNumber,
} from "../../../web/ui/format.js";

const plain = (text: string): string => text.replace(/\u202f/g, " ");

describe("durations", () => {
  it("are shown in suitable units", () => {
    expect(plain(formatDuration(0))).toBe("0 s");
    expect(plain(formatDuration(42.4))).toBe("42 s");
    expect(plain(formatDuration(185))).toBe("3 min 5 s");
    expect(plain(formatDuration(180))).toBe("3 min");
    expect(plain(formatDuration(22 * 60 + 2))).toBe("22 min");
    expect(plain(formatDuration(2 * 3600 + 12 * 60 + 9))).toBe("2 h 12 min");
    expect(plain(formatDuration(26 * 3600))).toBe("26 h");
  });

  it("never show sixty seconds or sixty minutes", () => {
    expect(plain(formatDuration(59.7))).toBe("1 min");
    expect(plain(formatDuration(599.7))).toBe("10 min");
    expect(plain(formatDuration(3599.6))).toBe("1 h");
    expect(plain(formatDuration(7199))).toBe("2 h");
  });

  it("show a dash for an invalid duration", () => {
    expect(formatDuration(Number.NaN)).toBe("–");
    expect(formatDuration(-1)).toBe("–");
  });
});

describe("times of day", () => {
  // A Friday.
  const nowMs = new Date(2026, 10, 20, 18, 41).getTime();
  const past = (...[year, month, day, hour, minute]: [number, number, number, number, number]): string =>
    formatWhen(new Date(year, month, day, hour, minute).toISOString(), nowMs);

  it("are in 24-hour format, in the past and the future", () => {
    expect(past(2026, 10, 20, 6, 5)).toBe("06:05");
    expect(past(2026, 10, 20, 18, 40)).toBe("18:40");
    expect(formatClockIn(nowMs, 60)).toBe("18:42");
  });

  it("include the day if it is not today", () => {
    expect(formatClockIn(nowMs, 22 * 3600)).toBe("Sat 16:41");
    expect(formatClockIn(nowMs, 46.8 * 3600)).toBe("Sun 17:29");
    expect(past(2026, 10, 19, 23, 59)).toBe("Thu 23:59");
  });

  it("include the date if the name of the day would be ambiguous", () => {
    expect(past(2026, 10, 13, 18, 41)).toBe("13 Nov 18:41");
    expect(formatClockIn(nowMs, 7 * 24 * 3600)).toBe("27 Nov 18:41");
    expect(past(2025, 10, 3, 14, 5)).toBe("3 Nov 2025 14:05");
  });

  it("are a dash for an invalid time", () => {
    expect(formatWhen("soon", nowMs)).toBe("–");
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
