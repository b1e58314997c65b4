/** Numbers formatted for reading. A narrow space separates a number from its unit. */
import { lengthFromMm, mmFromLength, parseLength, type LengthUnit } from "../../src/internal.js";
import { language } from "./text.js";

const NARROW = "\u202f";

/** Durations from here on are shown without seconds. */
const LONG_S = 600;

/** Seconds as "42 s", "3 min 5 s", "22 min", "2 h 12 min". Not finite: "–". */
export const formatDuration = (s: number): string => {
  if (!Number.isFinite(s) || s < 0) return "–";
  const seconds = Math.round(s);
  if (seconds < LONG_S) return inUnits(Math.floor(seconds / 60), "min", seconds % 60, "s");
  const minutes = Math.round(s / 60);
  return inUnits(Math.floor(minutes / 60), "h", minutes % 60, "min");
};

/** Leaves out a first part of zero, and a second part of zero if there is a first. */
const inUnits = (large: number, largeUnit: string, small: number, smallUnit: string): string =>
  [
    ...(large > 0 ? [`${large}${NARROW}${largeUnit}`] : []),
    ...(small > 0 || large === 0 ? [`${small}${NARROW}${smallUnit}`] : []),
  ].join(" ");

/** A time in a plot: "0:03.4" under an hour, "1:02:03" above. */
export const formatMoment = (s: number): string => {
  const whole = Math.max(0, s);
  if (whole < 3600) {
    const tenths = Math.floor(whole * 10);
    return `${Math.floor(tenths / 600)}:${pad(Math.floor(tenths / 10) % 60)}.${tenths % 10}`;
  }
  const seconds = Math.floor(whole);
  return `${Math.floor(seconds / 3600)}:${pad(Math.floor(seconds / 60) % 60)}:${pad(seconds % 60)}`;
};

const pad = (n: number): string => String(n).padStart(2, "0");

/** A length in a unit that suits it: "42 mm", "3.1 m", "1.2 km". */
export const formatLength = (mm: number): string => {
  if (!Number.isFinite(mm)) return "–";
  if (mm < 1_000) return `${Math.round(mm)}${NARROW}mm`;
  if (mm < 100_000) return `${(mm / 1_000).toFixed(1)}${NARROW}m`;
  if (mm < 1_000_000) return `${Math.round(mm / 1_000)}${NARROW}m`;
  return `${(mm / 1_000_000).toFixed(2)}${NARROW}km`;
};

/** Parses a typed length to mm: a number in `unit`, or one with its own unit. Null if it is not a length. */
export const parseTypedLength = (typed: string, unit: LengthUnit): number | null => {
  const bare = parseNumber(typed);
  return bare === null ? parseLength(typed.replace(",", ".")) : mmFromLength(bare, unit);
};

/** A length for a field or a ruler, without its unit; `digits` applies to mm. */
export const formatInUnit = (mm: number, unit: LengthUnit, digits = 2): string =>
  formatNumber(lengthFromMm(mm, unit), unit === "mm" ? digits : digits + 1);

/** "297 × 210 mm", "11.69 × 8.27 in". */
export const formatSize = (widthMm: number, heightMm: number, unit: LengthUnit): string =>
  `${formatInUnit(widthMm, unit, 1)} × ${formatInUnit(heightMm, unit, 1)}${NARROW}${unit}`;

/** The size of a file: "12 kB", "3.4 MB". */
export const formatBytes = (bytes: number): string =>
  bytes < 1e6 ? `${Math.ceil(bytes / 1e3)}${NARROW}kB` : `${(bytes / 1e6).toFixed(1)}${NARROW}MB`;

/** A count with narrow spaces between thousands. */
export const formatCount = (n: number): string =>
  String(Math.round(n)).replace(/\B(?=(\d{3})+(?!\d))/g, NARROW);

/** Exactly `digits` decimals, and no "-0". */
export const formatFixed = (n: number, digits: number): string =>
  n.toFixed(digits).replace(/^-(?=[0.]+$)/, "");

/** At most `digits` decimals, without trailing zeros. */
export const formatNumber = (n: number, digits = 2): string =>
  Number.isFinite(n) ? String(Number(n.toFixed(digits))) : "–";

export const formatPercent = (share: number): string =>
  `${Math.floor(Math.min(1, Math.max(0, share)) * 100 + 1e-9)}${NARROW}%`;

/** The time of day in `s` seconds: "16:42", or "Sun 16:42" on another day. */
export const formatClockIn = (nowMs: number, s: number): string =>
  momentOf(new Date(nowMs + s * 1_000), nowMs);

/** A time in the past: "14:05" today, "Sun 14:05" or "3 Nov 14:05" before. */
export const formatWhen = (iso: string, nowMs: number = Date.now()): string => momentOf(new Date(iso), nowMs);

const DAY_MS = 86_400_000;

/** The 24-hour clock in every browser language, so that the page never shows both 18:41 and 06:41 PM. */
const momentOf = (at: Date, nowMs: number): string => {
  if (Number.isNaN(at.getTime())) return "–";
  const now = new Date(nowMs);
  const clock = `${pad(at.getHours())}:${pad(at.getMinutes())}`;
  if (at.toDateString() === now.toDateString()) return clock;
  // At most six days away, so that the weekday is unambiguous.
  const isNear = Math.abs(at.getTime() - nowMs) < 6 * DAY_MS;
  const isThisYear = at.getFullYear() === now.getFullYear();
  const day = at.toLocaleDateString(
    language,
    isNear
      ? { weekday: "short" }
      : { day: "numeric", month: "short", ...(isThisYear ? {} : { year: "numeric" }) },
  );
  return `${day} ${clock}`;
};

/** Parses a typed number: comma or point, spaces ignored. Null if it is not a number. */
export const parseNumber = (typed: string): number | null => {
  const clean = typed.replace(/[\s\u202f]/g, "").replace(",", ".");
  if (clean === "" || !/^[+-]?(\d+\.?\d*|\.\d+)$/.test(clean)) return null;
  return Number(clean);
};
