/** `plotwright ringing`: writes the ringing sheets, and computes and stores frequencies from counted ripples. */
import { InvalidArgumentError } from "commander";
import { PlotwrightError } from "../../src/index.js";
import {
  CHECK_ACCEL,
  frequenciesOf,
  isAllowed,
  machineOf,
  measuredMachine,
  rangeInWords,
  RINGING_MOTION,
  ringingChecks,
  ringingSheet,
  SPRINGS_TABLE,
  type RippleReading,
  type Springs,
} from "../../src/internal.js";
import { withChosenPlotter } from "./client/known-plotters.js";
import { addServer } from "./client/server-client.js";
import { writeOut } from "./files.js";
import { row, type CliIo } from "./io.js";
import { addPlotter, positive, type Declare } from "./options.js";
import { settingsOver, type OptionValues } from "./settings-options.js";

interface RingingOptions {
  readonly check?: boolean;
  readonly springX?: number;
  readonly springY?: number;
  readonly ripplesX?: RippleReading;
  readonly ripplesY?: RippleReading;
  readonly damping?: number;
  readonly store?: boolean;
  readonly plotter?: string;
}

/** Positions of the figures of the second sheet on A4, mm. */
const PLACES = [15, 110, 205].flatMap((x) => [15, 110].map((y) => `${x},${y}`));

export const declareRinging: Declare = (command, { io }) => {
  addPlotter(addServer(command))
    .argument("[out]", "SVG file to write the sheet to, or - for stdout", "ringing.svg")
    .option(
      "--ripples-x <count,mm>",
      "ripples counted on a vertical line, and their length: print the frequency, instead of writing a sheet",
      reading,
    )
    .option("--ripples-y <count,mm>", "the same for a horizontal line", reading)
    .option(
      "--check",
      "write the second sheets: one figure without shaping and one for each of several frequencies, to choose the best by eye",
    )
    .option("--spring-x <Hz>", "for --check: the frequency read for x", positive)
    .option("--spring-y <Hz>", "for --check: the frequency read for y", positive)
    .option(
      "--damping <ratio>",
      "how quickly the ripples fade: 0.02 very slowly, 0.12 at once (default: 0.05)",
      positive,
    )
    .option("--store", "store the frequencies and the damping with the plotter's machine")
    .action(async (out: string, options: RingingOptions & OptionValues) => {
      mustFitTogether(options);
      if (options.ripplesX ?? options.ripplesY) await evaluate(options, io);
      else if (options.check) writeCheck(out, options, io);
      else writeSheet(out, io);
    });
};

/** "3,18.5": three ripples in 18.5 mm. */
function reading(text: string): RippleReading {
  const [ripples = NaN, lengthMm = NaN, ...rest] = text.split(",").map(Number);
  if (rest.length > 0 || !(Number.isInteger(ripples) && ripples > 0 && lengthMm > 0)) {
    throw new InvalidArgumentError("It must be a whole number of ripples, and their length in mm: 3,18.5.");
  }
  return { ripples, lengthMm };
}

/** Alone, these options would have no effect. */
function mustFitTogether(options: RingingOptions): void {
  const { check, springX, springY, ripplesX, ripplesY, damping, store, plotter } = options;
  if ((springX ?? springY) !== undefined && check !== true) {
    throw new PlotwrightError("bad-setting", "--spring-x and --spring-y are for --check: add it.");
  }
  if (damping !== undefined && check !== true && (ripplesX ?? ripplesY) === undefined) {
    throw new PlotwrightError(
      "bad-setting",
      "--damping: give --ripples-x and --ripples-y too, what you counted.",
    );
  }
  const springs: Readonly<Record<string, number | undefined>> = { xHz: springX, yHz: springY, damping };
  for (const [key, setting] of Object.entries(SPRINGS_TABLE)) {
    const value = springs[key];
    if (value !== undefined && !isAllowed(setting, value))
      throw new PlotwrightError("bad-setting", `${setting.flag}: it must be ${rangeInWords(setting)}.`);
  }
  if (store === true && (ripplesX === undefined || ripplesY === undefined)) {
    throw new PlotwrightError("bad-setting", "--store: give both --ripples-x and --ripples-y.");
  }
  if (plotter !== undefined && store !== true) {
    throw new PlotwrightError("bad-setting", "--plotter is for --store: add it.");
  }
}

async function evaluate(options: RingingOptions & OptionValues, io: CliIo): Promise<void> {
  const { ripplesX = null, ripplesY = null, damping = SPRINGS_TABLE.damping.default } = options;
  const { x, y } = frequenciesOf({ x: ripplesX, y: ripplesY }, damping);
  if (x !== null) io.out(row("x", `${x.toFixed(1)} Hz`));
  if (y !== null) io.out(row("y", `${y.toFixed(1)} Hz`));
  if (x === null || y === null) return;
  if (options.store === true) return store({ xHz: x, yHz: y, damping }, options, io);
  io.err(
    `Store it with the plotter: add --store. Or plot with it: --quality fast --spring-x ${x.toFixed(1)} ` +
      `--spring-y ${y.toFixed(1)} --damping ${damping}\n`,
  );
}

/** With the machine of the plotter. A built-in machine becomes a copy, and the plotter's. */
async function store(springs: Springs, options: OptionValues, io: CliIo): Promise<void> {
  await withChosenPlotter(
    options,
    async (plotter, { withMachine, ownMachines, storeMachine, saveMachine }) => {
      const { settings } = settingsOver({ data: options["data"] }, plotter.stored, withMachine);
      const measured = measuredMachine(machineOf(settings), springs, ownMachines);
      await storeMachine(measured);
      await saveMachine(plotter.id, measured.id);
      io.out(row("stored", measured.name, `plotter ${plotter.name}`));
    },
  );
}

function writeSheet(out: string, io: CliIo): void {
  writeOut(out, ringingSheet(), io);
  const { mode, draw } = RINGING_MOTION;
  io.err(
    `Plot it: plotwright plot ${out} --no-fit --mode ${mode} --speed ${draw.speedMmPerS} --accel ${draw.accelMmPerS2} --corner ${draw.cornerMm} --shaper none\n` +
      "Count the ripples on the straight part of a vertical line for x and of a horizontal one for y, from crest to crest on " +
      "its outer side, and measure their length to half a mm.\n" +
      "Then: plotwright ringing --ripples-x COUNT,MM --ripples-y COUNT,MM --store\n",
  );
}

function writeCheck(
  out: string,
  { springX, springY, damping = SPRINGS_TABLE.damping.default }: RingingOptions,
  io: CliIo,
): void {
  if (springX === undefined || springY === undefined) {
    throw new PlotwrightError(
      "bad-setting",
      "--check: give --spring-x and --spring-y, as read from the first sheet.",
    );
  }
  const checks = ringingChecks({ xHz: springX, yHz: springY, damping });
  writeOut(out, checks[0].svg, io);
  const common = `plotwright plot ${out} --no-fit --accel ${CHECK_ACCEL}`;
  checks.forEach(({ factor, springs }, i) => {
    const shaping =
      springs === null
        ? "--shaper none"
        : `--shaper zv --spring-x ${springs.xHz.toFixed(1)} --spring-y ${springs.yHz.toFixed(1)} --damping ${springs.damping}`;
    const what = factor === null ? "not shaped" : `frequencies × ${factor}`;
    io.err(`${what}: ${common} --place ${PLACES[i]} ${shaping}\n`);
  });
}
