/** `plotwright ringing`: writes the ringing sheets, and computes frequencies from counted ripples. */
import { PlotwrightError } from "../../src/index.js";
import {
  frequencyOfRipples,
  ringingChecks,
  RINGING_MOTION,
  RINGING_SPEEDS,
  ringingSheet,
} from "../../src/internal.js";
import { writeOut } from "./files.js";
import type { CliIo } from "./io.js";
import { positive, type Declare } from "./options.js";

interface RingingOptions {
  readonly check?: boolean;
  readonly springX?: number;
  readonly springY?: number;
  readonly ripples?: number;
  readonly at?: number;
  readonly over: number;
}

/** Positions of the figures of the second sheet on A4, mm. */
const PLACES = [15, 110, 205].flatMap((x) => [15, 110].map((y) => `${x},${y}`));

export const declareRinging: Declare = (command, { io }) => {
  command
    .argument("[out]", "SVG file to write the sheet to, or - for stdout", "ringing.svg")
    .option(
      "--ripples <count>",
      "print the frequency for this number of counted ripples, instead of writing a sheet",
      positive,
    )
    .option("--at <mm/s>", "speed of the figure on which the ripples were counted", positive)
    .option("--over <mm>", "length over which the ripples were counted", positive, 10)
    .option(
      "--check",
      "write the second sheets: one figure without shaping and one for each of several frequencies, to choose the best by eye",
    )
    .option("--spring-x <Hz>", "for --check: the frequency read for x", positive)
    .option("--spring-y <Hz>", "for --check: the frequency read for y", positive)
    .action((out: string, options: RingingOptions) => {
      mustFitTogether(options);
      if (options.ripples !== undefined) sayFrequency(options, io);
      else if (options.check) writeCheck(out, options, io);
      else writeSheet(out, io);
    });
};

/** Alone, these options would have no effect. */
function mustFitTogether({ at, ripples, check, springX, springY }: RingingOptions): void {
  if (at !== undefined && ripples === undefined) {
    throw new PlotwrightError("bad-setting", "--at: give --ripples too, the number that you counted.");
  }
  if ((springX ?? springY) !== undefined && check !== true) {
    throw new PlotwrightError("bad-setting", "--spring-x and --spring-y are for --check: add it.");
  }
}

function sayFrequency({ ripples = 0, at, over }: RingingOptions, io: CliIo): void {
  if (at === undefined) {
    throw new PlotwrightError(
      "bad-setting",
      `--at is missing: give the speed of the figure whose ripples you counted, ${RINGING_SPEEDS.join(", ")} mm/s.`,
    );
  }
  io.out(`${frequencyOfRipples(at, ripples, over).toFixed(1)} Hz\n`);
}

function writeSheet(out: string, io: CliIo): void {
  writeOut(out, ringingSheet(), io);
  const { mode, draw } = RINGING_MOTION;
  io.err(
    `Plot it: plotwright plot ${out} --no-fit --mode ${mode} --accel ${draw.accelMmPerS2} --corner ${draw.cornerMm}\n` +
      `Count the ripples after a corner, over 10 mm: horizontal lines show the swing of y, vertical lines that of x.\n` +
      `Then: plotwright ringing --ripples COUNT --at SPEED; the figures are drawn at ${RINGING_SPEEDS.join(", ")} mm/s.\n`,
  );
}

function writeCheck(out: string, { springX, springY }: RingingOptions, io: CliIo): void {
  if (springX === undefined || springY === undefined) {
    throw new PlotwrightError(
      "bad-setting",
      "--check: give --spring-x and --spring-y, as read from the first sheet.",
    );
  }
  const checks = ringingChecks({ xHz: springX, yHz: springY, damping: 0.05 });
  writeOut(out, checks[0].svg, io);
  const { draw } = RINGING_MOTION;
  const common = `plotwright plot ${out} --no-fit --accel ${draw.accelMmPerS2}`;
  checks.forEach(({ factor, springs }, i) => {
    const shaping =
      springs === null
        ? ""
        : ` --shaper zv --spring-x ${springs.xHz.toFixed(1)} --spring-y ${springs.yHz.toFixed(1)}`;
    const what = factor === null ? "not shaped" : `frequencies × ${factor}`;
    io.err(`${what}: ${common} --place ${PLACES[i]}${shaping}\n`);
  });
}
