/** The settings of jobs: what was given for them, on the plotter that they are for. */
import {
  movedSettings,
  onPlottersMachine,
  settingsOfPlotter,
  settingsWith,
  type OnPlotter,
  type SettingsOfPlotter,
} from "../plotter/settings-of-plotter.js";
import { PlotwrightError } from "../../src/index.js";
import type { GivenSettings, Job, JobChange, JobPatch, PlotSettings } from "../../src/schema/index.js";
import type { JobList } from "./job-list.js";
import type { QueueParts } from "./queue-parts.js";

/**
 * Each job stores its settings, and every client gets those of all waiting jobs. Only settings of single layers can
 * become that large: at 100 bytes each, those of a thousand layers.
 */
const MAX_SETTINGS_BYTES = 100_000;

type Parts = Pick<QueueParts, "settingsOf" | "withMachine">;

export class SettingsOfJobs {
  constructor(
    private readonly parts: Parts,
    private readonly jobs: JobList,
  ) {}

  /** The settings of a plotter, for jobs and manual moves. */
  of(plotterId: string): SettingsOfPlotter {
    const last = this.lastOn(plotterId);
    return (
      this.parts.settingsOf?.(plotterId, last) ??
      settingsOfPlotter({ machine: null, own: undefined, last }, this.withMachine)
    );
  }

  with(plotterId: string, given: GivenSettings = {}): OnPlotter {
    return settingsWith(this.of(plotterId), given, this.withMachine);
  }

  /** For a job from another server. Profiles are not taken from there: this plotter may be smaller. */
  withForeign(plotterId: string, { customMachine: _profile, ...given }: GivenSettings): OnPlotter {
    return this.with(plotterId, given);
  }

  /** The settings of a job after a change of its settings, its plotter, or both. */
  changed(job: Job, { settings = {}, plotterId = job.plotterId }: JobPatch): OnPlotter {
    const plotter = this.of(plotterId);
    const base =
      plotterId === job.plotterId
        ? job.settings
        : movedSettings(job.settings, this.of(job.plotterId), plotter);
    return settingsWith(plotter, settings, this.withMachine, base);
  }

  /** What changes when a job is plotted: the plotter's model may be another one than when the job was added. */
  onPlotter(job: Job): Pick<Job, "settings" | "warnings"> {
    const { settings, note } = onPlottersMachine(job.settings, this.of(job.plotterId), this.withMachine);
    const notes = note === null || job.warnings.includes(note) ? [] : [note];
    return { settings, warnings: [...job.warnings, ...notes] };
  }

  readonly withMachine = (settings: PlotSettings): PlotSettings =>
    this.parts.withMachine?.(settings) ?? settings;

  private lastOn(plotterId: string): PlotSettings | undefined {
    const begun = this.jobs
      .list()
      .filter((job) => job.plotterId === plotterId && job.startedAt !== null)
      .sort((a, b) => (b.startedAt ?? "").localeCompare(a.startedAt ?? ""));
    return begun[0]?.settings;
  }
}

/** Throws `too-large`. */
export function mustFit(settings: PlotSettings | JobChange): void {
  const bytes = JSON.stringify(settings).length;
  if (bytes <= MAX_SETTINGS_BYTES) return;
  throw new PlotwrightError(
    "too-large",
    `The settings of this job take ${Math.ceil(bytes / 1000)} kB, more than the ${MAX_SETTINGS_BYTES / 1000} kB that a job may have. Set fewer layers one by one.`,
  );
}
