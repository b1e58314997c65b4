/**
 * What a plot of the command line needs to resume after a crash: its drawing, its settings, and the journal that its
 * driver writes. One folder per device, deleted when the plot has ended.
 */
import { copyFileSync, existsSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { z } from "zod";
import { PlotwrightError } from "../../src/index.js";
import { plotSettingsSchema, type PlotSettings } from "../../src/schema/index.js";
import type { JournalEntry } from "../../host/plotter/types.js";
import { makeDataFolder } from "../storage/data-dir.js";
import { fileFault } from "../storage/file-fault.js";

const plotSchema = z.object({
  name: z.string(),
  settings: plotSettingsSchema,
  only: z.array(z.string()).optional(),
  pid: z.number(),
});
const placeSchema = z.object({ stroke: z.int().min(0), alongMm: z.number().min(0) });
const entrySchema = z.object({
  place: placeSchema,
  sent: placeSchema.optional(),
  progress: z.number(),
});

/** What is plotted. */
export interface Plotted {
  readonly name: string;
  readonly settings: PlotSettings;
  /** The layers that are drawn, by name. Absent: all. */
  readonly only: readonly string[] | undefined;
}

/** An interrupted plot. */
export interface CutShort extends Plotted {
  readonly from: JournalEntry["place"];
  readonly sent: JournalEntry["sent"];
  /** 0 … 1. */
  readonly progress: number;
}

export class PlotRecord {
  readonly #folder: string;
  readonly #dataDir: string;
  readonly #names: readonly string[];

  constructor(dataDir: string, device = "auto") {
    this.#dataDir = dataDir;
    this.#names = ["command-line", encodeURIComponent(device)];
    this.#folder = join(dataDir, ...this.#names);
  }

  /** The drawing as it was when the plot began. */
  get drawingPath(): string {
    return join(this.#folder, "drawing");
  }

  begin(path: string, plot: Plotted): void {
    makeDataFolder(this.#dataDir, ...this.#names);
    try {
      rmSync(join(this.#folder, "journal.json"), { force: true });
      copyFileSync(path, this.drawingPath);
      this.takeOver(plot);
    } catch (cause) {
      throw new PlotwrightError(
        "bad-setting",
        `The data folder ${this.#dataDir} can't be written to: ${fileFault(cause)}. Choose another one with --data.`,
        { cause },
      );
    }
  }

  /** Begun or resumed by this process. */
  takeOver({ name, settings, only }: Plotted): void {
    this.#write("plot.json", { name, settings, only, pid: process.pid });
  }

  /** `progress`: 0 … 1. */
  save(entry: JournalEntry, progress: number): void {
    this.#write("journal.json", { ...entry, progress });
  }

  end(): void {
    rmSync(this.#folder, { recursive: true, force: true });
  }

  /** Null if the last plot ended, had drawn nothing, or still runs in another process. */
  find(): CutShort | null {
    const plot = plotSchema.safeParse(this.#read("plot.json"));
    const entry = entrySchema.safeParse(this.#read("journal.json"));
    if (!plot.success || !entry.success || !existsSync(this.drawingPath)) return null;
    if (plot.data.pid !== process.pid && isRunning(plot.data.pid)) return null;
    const { name, settings, only } = plot.data;
    const { place, sent, progress } = entry.data;
    return { name, settings, only, from: place, sent, progress };
  }

  /** Throws `not-found`. */
  mustFind(): CutShort {
    const found = this.find();
    if (found !== null) return found;
    throw new PlotwrightError(
      "not-found",
      "No plot was interrupted on this device: there is nothing to resume.",
    );
  }

  #read(name: string): unknown {
    try {
      return JSON.parse(readFileSync(join(this.#folder, name), "utf8"));
    } catch {
      return null;
    }
  }

  /** Writes the file atomically. */
  #write(name: string, value: unknown): void {
    const path = join(this.#folder, name);
    writeFileSync(`${path}.new`, JSON.stringify(value));
    renameSync(`${path}.new`, path);
  }
}

function isRunning(pid: number): boolean {
  try {
    process.kill(pid, 0);
    return true;
  } catch {
    return false;
  }
}
