/**
 * Stores a plot started from the command line, so that it can resume after a crash: its drawing, its settings, and the
 * driver's journal. One folder per device, deleted when the plot has ended.
 */
import {
  appendFileSync,
  copyFileSync,
  existsSync,
  readFileSync,
  renameSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { join } from "node:path";
import { z } from "zod";
import { PlotwrightError } from "../../../src/index.js";
import { plotSettingsSchema, type PlotSettings } from "../../../src/schema/index.js";
import { journalSchema } from "../../../host/plotter/resume-position.js";
import type { JournalEntry, StoppedAt } from "../../../host/plotter/plotter-port.js";
import { makeDataFolder } from "../../storage/data-dir.js";
import { fileFault } from "../../storage/file-fault.js";
import { isAlive, thisProcess } from "../../storage/process-owner.js";

/** The process that begins or resumes a plot. */
const ownerSchema = z.object({ pid: z.number(), began: z.string().default("") });
const plotSchema = ownerSchema.extend({
  name: z.string(),
  settings: plotSettingsSchema,
  only: z.array(z.string()).optional(),
});
const entrySchema = journalSchema.extend({ progress: z.number() });

/** What is stored of a plot when it begins, beside its drawing. */
interface StoredPlot {
  readonly name: string;
  readonly settings: PlotSettings;
  /** The layers that are drawn, by name. Absent: all. */
  readonly only: readonly string[] | undefined;
}

/** An interrupted plot. */
export interface InterruptedPlot extends StoredPlot {
  readonly from: JournalEntry["place"];
  readonly stopped: StoppedAt;
  /** 0 … 1. */
  readonly progress: number;
}

export class PlotRecord {
  private readonly folder: string;
  private readonly names: readonly string[];
  private readonly device: string;
  /** False while another process stores its plot in this folder. */
  private isOurs = true;

  constructor(
    private readonly dataDir: string,
    device = "auto",
    kind: "command-line" | "live" = "command-line",
  ) {
    this.device = device;
    this.names = [kind, encodeURIComponent(device)];
    this.folder = join(dataDir, ...this.names);
  }

  /** The drawing as it was when the plot began. */
  get drawingPath(): string {
    return join(this.folder, "drawing");
  }

  /** The font file with which it began; undefined: without one. */
  get fontPath(): string | undefined {
    return existsSync(this.fontFile) ? this.fontFile : undefined;
  }

  private get fontFile(): string {
    return join(this.folder, "font");
  }

  /**
   * Only one process can open a serial port, but several can plot on a virtual board: then only the first plot is
   * stored. `path` null: the drawing is added by `append`. Throws `bad-file` if the drawing can't be read, `bad-setting` if the data folder can't be written to.
   */
  begin(path: string | null, plot: StoredPlot, font?: string): void {
    this.isOurs = this.device !== "virtual" || this.ownerElsewhere() === null;
    if (!this.isOurs) return;
    const drawing = path === null ? "" : readDrawing(path);
    makeDataFolder(this.dataDir, ...this.names);
    this.mustWrite(() => {
      rmSync(join(this.folder, "journal.json"), { force: true });
      writeFileSync(this.drawingPath, drawing);
      rmSync(this.fontFile, { force: true });
      if (font !== undefined) copyFileSync(font, this.fontFile);
    });
    this.takeOver(plot);
  }

  /** Call when this process begins or resumes a plot. Throws `bad-setting` if the data folder can't be written to. */
  takeOver({ name, settings, only }: StoredPlot): void {
    this.mustWrite(() => this.write("plot.json", { name, settings, only, ...thisProcess() }));
  }

  /** `progress`: 0 … 1. Throws the system's error if the disk is full. */
  save(entry: JournalEntry, progress: number): void {
    if (this.isOurs) this.write("journal.json", { ...entry, progress });
  }

  /** Adds to the drawing. */
  append(text: string): void {
    if (this.isOurs) appendFileSync(this.drawingPath, text);
  }

  end(): void {
    if (this.isOurs) rmSync(this.folder, { recursive: true, force: true });
  }

  /** Null if the last plot ended, had drawn nothing, or still runs in another process. */
  find(): InterruptedPlot | null {
    const plot = plotSchema.safeParse(this.read("plot.json"));
    const entry = entrySchema.safeParse(this.read("journal.json"));
    if (!plot.success || !entry.success || !existsSync(this.drawingPath)) return null;
    if (this.ownerElsewhere() !== null) return null;
    const { name, settings, only } = plot.data;
    const { place, progress, ...stopped } = entry.data;
    return { name, settings, only, from: place, stopped, progress };
  }

  /** Throws `not-found`, or `conflict` if the plot still runs in another process. */
  mustFind(): InterruptedPlot {
    const found = this.find();
    if (found !== null) return found;
    const pid = this.ownerElsewhere();
    if (pid !== null) throw stillRuns(pid, this.device);
    throw new PlotwrightError(
      "not-found",
      "No plot was interrupted on this device: there is nothing to resume.",
    );
  }

  /** The other process that is plotting; null if none is. */
  private ownerElsewhere(): number | null {
    const { success, data } = ownerSchema.safeParse(this.read("plot.json"));
    return success && data.pid !== process.pid && isAlive(data) ? data.pid : null;
  }

  private read(name: string): unknown {
    try {
      return JSON.parse(readFileSync(join(this.folder, name), "utf8"));
    } catch {
      return null;
    }
  }

  private mustWrite(write: () => void): void {
    try {
      write();
    } catch (cause) {
      throw new PlotwrightError(
        "bad-setting",
        `The data folder ${this.dataDir} can't be written to: ${fileFault(cause)}. Choose another one with --data.`,
        { cause },
      );
    }
  }

  /** Writes the file atomically. */
  private write(name: string, value: unknown): void {
    const path = join(this.folder, name);
    writeFileSync(`${path}.new`, JSON.stringify(value));
    renameSync(`${path}.new`, path);
  }
}

const stillRuns = (pid: number, device: string): PlotwrightError =>
  new PlotwrightError(
    "conflict",
    `The plot${device === "auto" ? "" : ` on ${device}`} still runs in process ${pid}, so there is nothing to resume yet. ` +
      `Wait until it ends, or press Ctrl-C in its terminal. If that terminal is gone, end the process (kill ${pid}): ` +
      "the pen lifts, and plotwright plot --resume continues the plot.",
  );

function readDrawing(path: string): Buffer {
  try {
    return readFileSync(path);
  } catch (cause) {
    throw new PlotwrightError("bad-file", `${path} can't be read: ${fileFault(cause)}.`, { cause });
  }
}
