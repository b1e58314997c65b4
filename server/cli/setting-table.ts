/** The settings that have an option on the command line: the flag, where its value goes, how it is read. */
import { InvalidArgumentError } from "commander";
import {
  LAYER_MODES,
  MIRROR_MODES,
  MOTION_MODES,
  ORDER_MODES,
  PAPER_SIZES,
  SPREAD_MODES,
  type FourMargins,
  type PaperSize,
  type PlacedBox,
} from "../../src/index.js";
import { length, sizeMm } from "./lengths.js";

export interface SettingOption {
  readonly flags: string;
  readonly about: string;
  /** Where in PlotSettings. */
  readonly path: string;
  readonly parse?: (text: string) => unknown;
  readonly choices?: readonly string[];
}

const row = (
  flags: string,
  path: string,
  about: string,
  more: Partial<SettingOption> = {},
): SettingOption => ({
  flags,
  path,
  about,
  ...more,
});
const amount = (flags: string, path: string, about: string): SettingOption =>
  row(flags, path, about, { parse: number });

const lengthOf = (flags: string, path: string, about: string): SettingOption =>
  row(flags, path, about, { parse: length });

export const SETTING_OPTIONS: readonly SettingOption[] = [
  row("--machine <id>", "machine", "plotter model, for example axidraw-v3"),
  row("--paper <size>", "prepare.paper", "A4, A3, Letter, … or WIDTHxHEIGHT in mm, or as in 8.5x11in", {
    parse: paper,
  }),
  row("--landscape", "prepare.landscape", "a named paper lies on its long side (default)"),
  row("--no-landscape", "prepare.landscape", "a named paper stands upright"),
  lengthOf("--margin <mm>", "prepare.marginMm", "free edge around the drawing"),
  row("--margins <mm,mm,mm,mm>", "prepare.margins", "top, right, bottom, left", { parse: fourMargins }),
  row("--fit", "prepare.fit", "scale the drawing to the paper inside the margins (default)"),
  row("--no-fit", "prepare.fit", "draw in true size"),
  row("--place <x,y[,w,h]>", "prepare.place", "the drawing's own box, mm from the paper's corner", {
    parse: place,
  }),
  amount("--rotate <deg>", "prepare.rotateDeg", "turn the drawing clockwise"),
  row("--mirror <how>", "prepare.mirror", "mirror the drawing", { choices: MIRROR_MODES }),
  row("--clip", "prepare.clipToMargins", "cut off what lies outside the margins (default)"),
  row("--no-clip", "prepare.clipToMargins", "draw over the margins"),
  row("--crop-to-page", "prepare.cropToPage", "cut off what lies outside the file's own page"),
  lengthOf("--hatch <mm>", "prepare.hatch.spacingMm", "fill areas with lines so far apart"),
  amount("--hatch-angle <deg>", "prepare.hatch.angleDeg", "direction of the hatch lines"),
  row("--hatch-cross", "prepare.hatch.cross", "hatch both ways"),
  row("--no-outline-fills", "prepare.outlineFills", "leave out the outline of shapes that are only filled"),
  row("--hide-covered", "prepare.hideCovered", "leave out what lies under filled shapes"),
  lengthOf("--drop-repeats <mm>", "prepare.dropRepeatsMm", "leave out what is drawn already, this near"),
  lengthOf("--drop-shorter <mm>", "prepare.dropShorterMm", "leave out strokes shorter than this"),
  lengthOf("--join <mm>", "prepare.joinMm", "join ends that are closer than this"),
  lengthOf("--simplify <mm>", "prepare.simplifyMm", "drop points closer than this to the line"),
  amount("--smooth <rounds>", "prepare.smoothRounds", "round off corners, 0 to 5 times"),
  lengthOf("--flatten <mm>", "prepare.flattenMm", "largest gap between a curve and its chords"),
  row("--reloop", "prepare.reloop", "begin closed strokes at a random point"),
  row("--order <how>", "prepare.order", "order of strokes", { choices: ORDER_MODES }),
  amount("--order-s <s>", "prepare.orderS", "how long --order best may search"),
  row("--spread <how>", "prepare.spread", "draw neighbours apart in time", { choices: SPREAD_MODES }),
  lengthOf("--reink <mm>", "prepare.reinkMm", "split layers after so much drawing, to take up ink"),
  row("--layers <by>", "prepare.layers", "what makes a layer", { choices: LAYER_MODES }),
  row("--mode <how>", "motion.mode", "how corners are taken", { choices: MOTION_MODES }),
  amount("--speed <mm/s>", "motion.draw.speedMmPerS", "largest speed, pen down"),
  amount("--accel <mm/s²>", "motion.draw.accelMmPerS2", "acceleration, pen down"),
  lengthOf("--corner <mm>", "motion.draw.cornerMm", "how far corners and tight curves may be left, pen down"),
  amount("--jerk <mm/s³>", "motion.draw.jerkMmPerS3", "largest change of acceleration, pen down (scurve)"),
  amount("--travel-speed <mm/s>", "motion.travel.speedMmPerS", "largest speed, pen up"),
  amount("--travel-accel <mm/s²>", "motion.travel.accelMmPerS2", "acceleration, pen up"),
  amount(
    "--travel-jerk <mm/s³>",
    "motion.travel.jerkMmPerS3",
    "largest change of acceleration, pen up (scurve)",
  ),
  amount("--pen-up <percent>", "pen.upPct", "height while travelling"),
  amount("--pen-down <percent>", "pen.downPct", "height while drawing"),
  amount("--pen-lift-ms <ms>", "pen.liftMs", "wait for the pen to lift"),
  amount("--pen-drop-ms <ms>", "pen.dropMs", "wait for the pen to drop"),
];

const NAMED_SIZES: readonly unknown[] = Object.values(PAPER_SIZES);

/** A size given by numbers, which is meant as it is said, wide or high. */
export const isOwnSize = (size: unknown): size is PaperSize =>
  size !== undefined && !NAMED_SIZES.includes(size);

function number(text: string): number {
  const value = text.trim() === "" ? NaN : Number(text);
  if (!Number.isFinite(value)) throw new InvalidArgumentError("It must be a number.");
  return value;
}

function numbers(text: string, counts: readonly number[]): number[] {
  const parts = text.split(",");
  if (!counts.includes(parts.length)) {
    throw new InvalidArgumentError(`It must be ${counts.join(" or ")} lengths with commas between.`);
  }
  return parts.map(length);
}

function fourMargins(text: string): FourMargins {
  const [topMm, rightMm, bottomMm, leftMm] = numbers(text, [4]) as [number, number, number, number];
  return { topMm, rightMm, bottomMm, leftMm };
}

function place(text: string): PlacedBox {
  const [xMm, yMm, widthMm, heightMm] = numbers(text, [2, 3, 4]) as [number, number, number?, number?];
  return { xMm, yMm, widthMm: widthMm ?? null, heightMm: heightMm ?? null };
}

/** A name, or WIDTHxHEIGHT. */
function paper(text: string): PaperSize {
  const name = Object.keys(PAPER_SIZES).find((one) => one.toLowerCase() === text.toLowerCase());
  if (name !== undefined) return PAPER_SIZES[name as keyof typeof PAPER_SIZES];
  const size = sizeMm(text);
  if (size !== null) return size;
  const names = Object.keys(PAPER_SIZES).join(", ");
  throw new InvalidArgumentError(
    `It must be one of ${names} or WIDTHxHEIGHT in mm, or as in 8.5x11in or 20x20cm.`,
  );
}
