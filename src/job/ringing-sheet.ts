/**
 * The ringing sheet: a strip of lines with two bends. At the first one the carriage's speed across the line ends at once,
 * so the pen swings. The straight part, which is drawn at a known speed, then has ripples:
 *
 *     /~~~~----\      horizontal lines show the swing of y, vertical ones that of x
 *
 * The second bend is there so that the pen does not brake on the straight part.
 */
import { PlotwrightError } from "../errors.js";
import type { Springs } from "../machines/profile.js";
import { SpringAxis } from "../plan/shaping/spring-axis.js";
import { DEFAULT_MOTION, type MotionSettings } from "../settings/motion.js";
import { SPRINGS_TABLE } from "../settings/machine.js";
import { isAllowed, rangeInWords } from "../settings/setting.js";

export const RINGING_SHEET_MM = { width: 60, height: 40 } as const;

/** Ripples of 12 to 45 Hz are 12 to 3 mm long, and the first one is 1.3 to 0.3 mm high. */
const SPEED = 150;
const ACCEL = 3_000;

/** The settings for plotting it: through the bends at full speed, not shaped. */
export const RINGING_MOTION: MotionSettings = {
  ...DEFAULT_MOTION,
  mode: "junction",
  shaper: "none",
  draw: { ...DEFAULT_MOTION.draw, speedMmPerS: SPEED, accelMmPerS2: ACCEL, cornerMm: 1 },
};

/** At a bend, a motor's speed jumps by at most 0.88 of the pen's speed: less than at a right angle drawn at 75 mm/s. */
const TURN = (40 * Math.PI) / 180;
const [ALONG, ACROSS] = [Math.cos(TURN), Math.sin(TURN)];
/** Length of the parts before the first bend and after the second one, mm. */
const RUN_UP_MM = 5;
export const STRAIGHT_MM = RINGING_SHEET_MM.height - 2 * RUN_UP_MM * ALONG;

/** Distances of the lines for x, and of those for y, which have more room, mm. The person reads the clearest line. */
const NEXT_MM = { x: 6, y: 12 };
const LINES = 3;

export type Axis = "x" | "y";

/** Path data of the sheet's lines for an axis. */
export function ringingPath(axis: Axis): string {
  const [runMm, bendMm] = [RUN_UP_MM * ALONG, RUN_UP_MM * ACROSS];
  const first = axis === "x" ? RINGING_SHEET_MM.width - bendMm - (LINES - 1) * NEXT_MM.x : 6;
  return Array.from({ length: LINES }, (_, i) => {
    const at = first + i * NEXT_MM[axis];
    return axis === "x"
      ? `M${at} 0l${bendMm} ${runMm}v${STRAIGHT_MM}l${-bendMm} ${runMm}`
      : `M0 ${at + bendMm}l${runMm} ${-bendMm}h${STRAIGHT_MM}l${runMm} ${bendMm}`;
  }).join("");
}

/** The sheet as an SVG drawing. */
export function ringingSheet(): string {
  const { width, height } = RINGING_SHEET_MM;
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width}mm" height="${height}mm" viewBox="0 0 ${width} ${height}">\n` +
    `<path d="${ringingPath("y")}${ringingPath("x")}" fill="none" stroke="#000"/>\n</svg>\n`
  );
}

/** A point of the straight part as the pen draws it, mm: from the bend along the line, and beside it on the outer side. */
export interface RingingPoint {
  readonly alongMm: number;
  readonly besideMm: number;
}

const STEP_S = 0.000_5;

/** The straight part of a line for an axis, drawn by a pen on these springs. */
export function ringingLine({ xHz, yHz, damping }: Springs, axis: Axis): RingingPoint[] {
  const [hz, otherHz] = axis === "x" ? [xHz, yHz] : [yHz, xHz];
  const across = new SpringAxis(hz, damping);
  const along = new SpringAxis(otherHz, damping);
  across.advance(SPEED / ACCEL, ACCEL * ACROSS);
  along.advance(SPEED / ACCEL, ACCEL * ALONG);
  const atSpeedS = (RUN_UP_MM - SPEED ** 2 / (2 * ACCEL)) / SPEED;
  across.advance(atSpeedS, 0);
  along.advance(atSpeedS, 0);
  across.rate += SPEED * ACROSS;
  along.rate -= SPEED * (1 - ALONG);
  const points: RingingPoint[] = [];
  for (let tS = 0; tS * SPEED <= STRAIGHT_MM; tS += STEP_S) {
    points.push({ alongMm: tS * SPEED + along.d, besideMm: across.d });
    across.advance(STEP_S, 0);
    along.advance(STEP_S, 0);
  }
  return points;
}

/** The crests of a line on its outer side, which the person counts. */
export const crestsOf = (line: readonly RingingPoint[]): RingingPoint[] =>
  line.filter(({ besideMm }, i) => {
    if (i === 0 || i === line.length - 1) return false;
    return besideMm > 0 && besideMm > line[i - 1].besideMm && besideMm >= line[i + 1].besideMm;
  });

/** What a person reads from the lines of an axis: a number of ripples, and how long they are together. */
export interface RippleReading {
  readonly ripples: number;
  readonly lengthMm: number;
}

export type RippleReadings = Readonly<Record<Axis, RippleReading | null>>;

/** Hz; null: not read. */
export type Frequencies = Readonly<Record<Axis, number | null>>;

/** The swing of the other axis moves the crests along the line, so both are found together, in a few rounds. */
const ROUNDS = 6;

/**
 * The frequencies of the swing from what was read.
 *
 * @throws PlotwrightError "bad-setting" for a reading that no machine can draw
 */
export function frequenciesOf(readings: RippleReadings, damping: number): Frequencies {
  const { x, y } = readings;
  const hz = { x: x && plainHz("x", x), y: y && plainHz("y", y) };
  for (let round = 0; round < ROUNDS; round++) {
    const springs: Springs = {
      xHz: hz.x ?? SPRINGS_TABLE.xHz.default,
      yHz: hz.y ?? SPRINGS_TABLE.yHz.default,
      damping,
    };
    if (x && hz.x !== null) hz.x *= lengthOf(springs, "x", x.ripples, hz.x) / x.lengthMm;
    if (y && hz.y !== null) hz.y *= lengthOf(springs, "y", y.ripples, hz.y) / y.lengthMm;
  }
  if (x && hz.x !== null) checkHz("x", x, hz.x);
  if (y && hz.y !== null) checkHz("y", y, hz.y);
  return hz;
}

/** As if the pen moved evenly along the line. */
function plainHz(axis: Axis, reading: RippleReading): number {
  const { ripples, lengthMm } = reading;
  if (!(Number.isInteger(ripples) && ripples > 0 && lengthMm > 0)) {
    throw new PlotwrightError(
      "bad-setting",
      `${axis}: ${ripples} ripples in ${lengthMm} mm: give a whole number of ripples, and their length in mm.`,
    );
  }
  if (lengthMm > STRAIGHT_MM) {
    throw new PlotwrightError(
      "bad-setting",
      `${axis}: ${lengthMm} mm is longer than the straight part, ${Math.round(STRAIGHT_MM)} mm: measure again.`,
    );
  }
  const hz = (SPEED * ripples) / lengthMm;
  checkHz(axis, reading, hz);
  return hz;
}

function checkHz(axis: Axis, { ripples, lengthMm }: RippleReading, hz: number): void {
  if (isAllowed(SPRINGS_TABLE.xHz, hz)) return;
  throw new PlotwrightError(
    "bad-setting",
    `${axis}: ${ripples} ripples in ${lengthMm} mm would be ${Math.round(hz * 10) / 10} Hz; ` +
      `a machine swings at ${rangeInWords(SPRINGS_TABLE.xHz)}: count again, near the bend.`,
  );
}

/** Length of that many ripples on these springs, mm. */
function lengthOf(springs: Springs, axis: Axis, ripples: number, hz: number): number {
  const crests = crestsOf(ringingLine(springs, axis));
  if (ripples >= crests.length) return (SPEED * ripples) / hz;
  return crests[ripples].alongMm - crests[0].alongMm;
}

/** Dampings to choose from by pictures: a ripple's height is 0.88, 0.76, 0.61 or 0.46 of the one before. */
export const DAMPINGS: readonly number[] = [0.02, 0.045, 0.08, 0.125];
