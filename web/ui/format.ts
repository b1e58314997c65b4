/** Numbers as people read them. All in tabular figures, with thin spaces where a unit follows. */

const NARROW = "\u202f";

/** Seconds as "42 s", "3:05 min", "2:07 h" (hours and minutes). Not finite: "–". */
export const formatDuration = (s: number): string => {
  if (!Number.isFinite(s) || s < 0) return "–";
  if (s < 59.5) return `${Math.round(s)}${NARROW}s`;
  const wholeS = Math.round(s);
  if (wholeS < 3600) {
    return `${Math.floor(wholeS / 60)}:${pad(wholeS % 60)}${NARROW}min`;
  }
  const minutes = Math.round(wholeS / 60);
  return `${Math.floor(minutes / 60)}:${pad(minutes % 60)}${NARROW}h`;
};

/** A point of time in a plot: "0:03.4" under an hour, "1:02:03" above. */
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

/** A length in the unit that suits it: "42 mm", "3.1 m", "1.2 km". */
export const formatLength = (mm: number): string => {
  if (!Number.isFinite(mm)) return "–";
  if (mm < 1_000) return `${Math.round(mm)}${NARROW}mm`;
  if (mm < 100_000) return `${(mm / 1_000).toFixed(1)}${NARROW}m`;
  if (mm < 1_000_000) return `${Math.round(mm / 1_000)}${NARROW}m`;
  return `${(mm / 1_000_000).toFixed(2)}${NARROW}km`;
};

/** A count with thin spaces between thousands. */
export const formatCount = (n: number): string =>
  String(Math.round(n)).replace(/\B(?=(\d{3})+(?!\d))/g, NARROW);

/** Exactly `digits` decimals; what rounds to zero has no sign. */
export const formatFixed = (n: number, digits: number): string =>
  n.toFixed(digits).replace(/^-(?=[0.]+$)/, "");

/** At most `digits` decimals, none where they are zero. */
export const formatNumber = (n: number, digits = 2): string =>
  Number.isFinite(n) ? String(Number(n.toFixed(digits))) : "–";

export const formatPercent = (share: number): string =>
  `${Math.floor(Math.min(1, Math.max(0, share)) * 100 + 1e-9)}${NARROW}%`;

/** The clock at which something that takes `s` more seconds ends: "16:42". */
export const formatClockIn = (nowMs: number, s: number): string => {
  const end = new Date(nowMs + s * 1_000);
  return `${pad(end.getHours())}:${pad(end.getMinutes())}`;
};

/** A moment of the past: "14:05" today, "Nov 3, 14:05" before; in the browser's own language. */
export const formatWhen = (iso: string, nowMs: number = Date.now()): string => {
  const at = new Date(iso);
  if (Number.isNaN(at.getTime())) return "–";
  const isToday = at.toDateString() === new Date(nowMs).toDateString();
  const time = { hour: "2-digit", minute: "2-digit" } as const;
  return isToday
    ? at.toLocaleTimeString([], time)
    : at.toLocaleString([], { month: "short", day: "numeric", ...time });
};

/** A number as typed by a person: comma or point, spaces ignored. Null where it is none. */
export const parseNumber = (typed: string): number | null => {
  const clean = typed.replace(/[\s\u202f]/g, "").replace(",", ".");
  if (clean === "" || !/^[+-]?(\d+\.?\d*|\.\d+)$/.test(clean)) return null;
  return Number(clean);
};
