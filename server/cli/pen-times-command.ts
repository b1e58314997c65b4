/** `plotwright pen-times`: writes the pen sheet, and stores the extra waits that a person has read from it. */
import { PlotwrightError } from "../../src/index.js";
import {
  isAllowed,
  PEN_SHEET_MOTION,
  PEN_SHEET_WAITS_MS,
  PEN_TABLE,
  penOfSheet,
  penSheet,
  rangeInWords,
} from "../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, plotterPartOf, type GivenSettings } from "../../src/schema/index.js";
import { withChosenPlotter } from "./client/known-plotters.js";
import { addServer } from "./client/server-client.js";
import { writeOut } from "./files.js";
import { printed, row, type CliIo } from "./io.js";
import { addPlotter, number, type Declare } from "./options.js";
import type { OptionValues } from "./settings-options.js";

export const declarePenTimes: Declare = (command, { io }) => {
  addPlotter(addServer(command))
    .argument("[out]", "SVG file to write the sheet to; its settings are written beside it", "pen-times.svg")
    .option("--right <ms>", "store this extra wait, the number of the lowest line that is right", number)
    .option(
      "--lift <ms>",
      "store this extra wait only for lifting, where lines with a lower number have tails",
      number,
    )
    .option("--drop <ms>", "store this one only for lowering, where they lack beginnings and dots", number)
    .action(async (out: string, options: OptionValues) => {
      const { right, lift = right, drop = right } = options;
      if (lift === undefined && drop === undefined) writeSheet(out, io);
      else await store({ extraLiftMs: lift, extraDropMs: drop }, options, io);
    });
};

/** The plot's settings beside a drawing's: "pen-times.svg" has "pen-times.json". */
const settingsFileOf = (out: string): string => `${out.replace(/\.svg$/i, "")}.json`;

function writeSheet(out: string, io: CliIo): void {
  if (out === "-") {
    throw new PlotwrightError(
      "bad-setting",
      "-: give a file name, because the sheet is plotted with a second file.",
    );
  }
  const config = settingsFileOf(out);
  const { overlap, layers } = penOfSheet(DEFAULT_PLOT_SETTINGS.pen);
  const settings: GivenSettings = {
    prepare: { fit: false, order: "none" },
    motion: PEN_SHEET_MOTION,
    pen: { overlap, layers },
  };
  writeOut(out, penSheet(), io);
  writeOut(config, `${JSON.stringify(settings, null, 2)}\n`, io);
  io.err(
    printed`Plot it: plotwright plot ${out} --config ${config}\n` +
      "The carriage waits less in each line than in the one above. Find the lowest line that is as right as the first one: " +
      "no tails after dashes, no missing beginnings, no missing dots.\n" +
      `Then store its number (${PEN_SHEET_WAITS_MS.slice(1).join(", ")}): plotwright pen-times --right NUMBER\n`,
  );
}

async function store(
  waits: Readonly<Record<"extraLiftMs" | "extraDropMs", unknown>>,
  options: OptionValues,
  io: CliIo,
): Promise<void> {
  const chosen = Object.entries(waits).filter(([, ms]) => ms !== undefined);
  for (const [key, ms] of chosen) {
    const row = PEN_TABLE[key as keyof typeof waits];
    if (!isAllowed(row, Number(ms)))
      throw new PlotwrightError("bad-setting", `${String(ms)} ms: it must be ${rangeInWords(row)}.`);
  }
  await withChosenPlotter(options, async (plotter, { saveSettings }) => {
    const own = plotter.stored.own ?? { ...plotterPartOf(DEFAULT_PLOT_SETTINGS), presets: [] };
    await saveSettings(plotter.id, { ...own, pen: { ...own.pen, ...Object.fromEntries(chosen) } });
    for (const [key, ms] of chosen) {
      const { label } = PEN_TABLE[key as keyof typeof waits];
      io.out(row(label, `${String(ms)} ms`, `plotter ${plotter.name}`));
    }
  });
}
