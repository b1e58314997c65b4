/**
 * A folder whose drawings become queued jobs. Each drawing, by name and content, is queued once, also across
 * restarts. A drawing is taken when its size no longer changes, so that a file still being copied or exported
 * is left alone.
 *
 * The settings are those of the newest job, without the parts specific to that drawing (placement and
 * layers). `NAME.settings.json` beside the drawing, or `settings.json` for the whole folder, overrides them.
 * Either file may contain complete settings or only a part, such as { "pen": … }.
 *
 * A drawing that can't be read is reported in the log and in a notice, and not tried again. After any other error, such
 * as too little memory or too many open files, it is tried again when it is saved again or the server restarts. If its
 * settings are at fault, it is also tried again when a settings file changes.
 */
import { readdir, stat } from "node:fs/promises";
import { basename, dirname, extname, join } from "node:path";
import { watch, type FSWatcher } from "chokidar";
import { PlotwrightError, type ErrorCode } from "../../../src/index.js";
import { isDrawingName, withGiven } from "../../../src/internal.js";
import {
  firstFault,
  cleanName,
  DEFAULT_PLOT_SETTINGS,
  givenSettingsSchema,
  type GivenSettings,
  type Job,
} from "../../../src/schema/index.js";
import type { DrawingFiles } from "../../storage/drawing-files.js";
import type { JobQueue } from "../../../host/queue/job-queue.js";
import type { Notices } from "../../../host/queue/notices.js";
import type { Store } from "../../storage/store.js";
import { settingsText, withDrawing, type WatchedDrawing } from "./watched-file.js";

interface WatchParts {
  readonly queue: Pick<JobQueue, "add" | "list" | "firstPlotter" | "settingsOf">;
  readonly files: DrawingFiles;
  readonly store: Pick<Store, "isSeen" | "saveSeen">;
  readonly notices: Pick<Notices, "add" | "list">;
  readonly log: (line: string) => void;
  /** How long a file's size must stay the same; default 2 s. */
  readonly stableMs?: number;
}

const STABLE_MS = 2_000;
/** Other settings may cure these: those of a settings file, or of the newest job. */
const SETTINGS_FAULTS: readonly ErrorCode[] = ["bad-setting", "out-of-bounds"];

export class WatchFolder {
  private readonly watcher: FSWatcher;
  private readonly abort = new AbortController();
  /** Paths of the drawings whose settings are at fault. */
  private readonly refused = new Set<string>();
  /** Files are handled one after the other, in the order of their events. */
  private last: Promise<void> = Promise.resolve();

  /** Throws `bad-setting` if there is no such folder. */
  static async open(dir: string, parts: WatchParts): Promise<WatchFolder> {
    const found = await stat(dir).catch(() => null);
    if (found === null || !found.isDirectory()) {
      throw new PlotwrightError(
        "bad-setting",
        `The folder ${dir} can't be watched, because it does not exist. Create it first.`,
      );
    }
    return new WatchFolder(dir, parts);
  }

  private constructor(
    dir: string,
    private readonly parts: WatchParts,
  ) {
    const stableMs = parts.stableMs ?? STABLE_MS;
    this.watcher = watch(dir, {
      depth: 0,
      followSymlinks: false,
      ignored: (path, stats) => stats?.isFile() === true && !isDrawing(path) && !isSettings(path),
      awaitWriteFinish: { stabilityThreshold: stableMs, pollInterval: Math.min(200, stableMs / 2) },
    });
    const later = (work: () => Promise<void>): void => {
      this.last = this.last
        .then(work)
        .catch((error: unknown) => parts.log(`watched folder: ${words(error)}`));
    };
    const changed = (path: string): void => {
      if (isSettings(path)) later(() => this.takeRefused());
      else later(() => this.take(path));
    };
    this.watcher.on("add", changed).on("change", changed);
    const removed = (path: string): void => {
      if (isSettings(path)) changed(path);
    };
    this.watcher.on("unlink", removed).on("unlinkDir", removed);
    this.watcher.on("error", (error) => parts.log(`watched folder: ${words(error)}`));
    this.watcher.once("ready", () => later(() => this.addUnnoticed(dir)));
  }

  async close(): Promise<void> {
    this.abort.abort();
    await this.watcher.close();
    await this.last;
  }

  /** chokidar reads the folder first and watches it then. Adds what was saved in between. */
  private async addUnnoticed(dir: string): Promise<void> {
    const entries = await readdir(dir, { withFileTypes: true });
    if (this.abort.signal.aborted) return;
    // It ignores those that it knows. A folder would be watched, too.
    this.watcher.add(entries.filter((entry) => entry.isFile()).map(({ name }) => join(dir, name)));
  }

  private async takeRefused(): Promise<void> {
    for (const path of [...this.refused]) await this.take(path);
  }

  /** Rejects only if the error itself can't be stored. */
  private async take(path: string): Promise<void> {
    if (this.abort.signal.aborted) return;
    this.refused.delete(path);
    const name = basename(path);
    const { files, store, log, notices } = this.parts;
    let sha256: string | null = null;
    try {
      await withDrawing(path, async (drawing) => {
        files.mustFit(drawing.bytes);
        sha256 = await drawing.sha256(this.abort.signal);
        if (store.isSeen({ name, sha256 })) return;
        const job = await this.add(path, name, sha256, drawing);
        log(`watched folder: "${job.name}" is queued as ${job.id}`);
      });
    } catch (error) {
      const isGone = (error as NodeJS.ErrnoException).code === "ENOENT";
      if (isGone || this.abort.signal.aborted) return;
      const message = `"${cleanName(name)}" in the watched folder can't be plotted: ${words(error)}`;
      log(message);
      const code = error instanceof PlotwrightError ? error.code : null;
      if (code !== null && SETTINGS_FAULTS.includes(code)) this.refused.add(path);
      const isFinal = code === "bad-file";
      // What is tried again may fail again while its notice is still shown.
      if (isFinal || !notices.list().some((shown) => shown.message === message)) notices.add(message);
      // The notice comes before saveSeen: after a crash between the two it is shown twice rather than never.
      if (isFinal && sha256 !== null) store.saveSeen({ name, sha256 });
    }
  }

  private async add(path: string, name: string, sha256: string, file: WatchedDrawing): Promise<Job> {
    const { queue, files } = this.parts;
    const settings = withGiven(lookOfLast(queue), await settingsBeside(path));
    const drawing = await files.add(file.chunks());
    if (drawing.bytes === 0) {
      await files.remove(drawing.id);
      throw new PlotwrightError("bad-file", "The file is empty.");
    }
    return queue.add(
      { name: cleanName(name.slice(0, 200)), settings, drawing, watched: { name, sha256 } },
      { signal: this.abort.signal },
    );
  }
}

const isSettings = (path: string): boolean => /(^|\.)settings\.json$/.test(basename(path));

/** Settings files end in .json, which drawings may too, so they are excluded. */
const isDrawing = (path: string): boolean =>
  isDrawingName(path) && !basename(path).startsWith(".") && !isSettings(path);

/**
 * The settings of the plotter's newest job, without its model and pens, which are the plotter's, and without what belongs
 * to that job's drawing: placement and layers. The heights are the plotter's too, if they are set for it.
 */
function lookOfLast(queue: WatchParts["queue"]): GivenSettings {
  const plotter = queue.firstPlotter();
  const newest = queue
    .list()
    .filter(({ plotterId }) => plotterId === plotter)
    .reduce<Job | null>((best, job) => (best === null || job.createdAt > best.createdAt ? job : best), null);
  if (newest === null) return {};
  const { prepare, motion, pen, penStops, sendAheadMs } = newest.settings;
  const { layout, rotateDeg, outside } = DEFAULT_PLOT_SETTINGS.prepare;
  return {
    ...(queue.settingsOf(plotter).hasPen ? {} : { pen: { ...pen, layers: {} } }),
    prepare: {
      ...prepare,
      hiddenLayers: [],
      shownLayers: [],
      layerHatches: [],
      layerOrder: [],
      layerRepeats: {},
      layout,
      rotateDeg,
      outside,
    },
    motion: { ...motion, layers: {} },
    penStops,
    sendAheadMs,
  };
}

async function settingsBeside(path: string): Promise<GivenSettings> {
  const name = basename(path, extname(path));
  for (const file of [join(dirname(path), `${name}.settings.json`), join(dirname(path), "settings.json")]) {
    const text = await settingsText(file);
    if (text === null) continue;
    const result = givenSettingsSchema.safeParse(parsed(text, file));
    if (result.success) return result.data;
    const { path: field, words } = firstFault(result.error);
    throw new PlotwrightError("bad-setting", `${basename(file)}: ${field}: ${words}.`);
  }
  return {};
}

function parsed(text: string, file: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch (cause) {
    throw new PlotwrightError("bad-setting", `${basename(file)} is not valid JSON.`, { cause });
  }
}

const words = (error: unknown): string => (error instanceof Error ? error.message : String(error));
