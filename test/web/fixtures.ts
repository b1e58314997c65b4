import { DEFAULT_PLOT_SETTINGS, type Job, type Plotter } from "../../src/schema/index.js";

export const makeJob = (id: string, more: Partial<Job> = {}): Job => ({
  id,
  plotterId: "virtual",
  name: `Job ${id}`,
  state: "queued",
  settings: DEFAULT_PLOT_SETTINGS,
  stats: null,
  warnings: [],
  progress: 0,
  elapsedS: 0,
  remainingS: null,
  message: null,
  place: null,
  speedPct: 100,
  plottedS: null,
  createdAt: "2026-01-01T00:00:00.000Z",
  startedAt: null,
  endedAt: null,
  ...more,
});

export const makePlotter = (id: string, more: Partial<Plotter> = {}): Plotter => ({
  id,
  name: "Virtual plotter",
  kind: "virtual",
  device: null,
  connection: "idle",
  firmware: "3.0.3",
  message: null,
  penUp: true,
  motorsOn: false,
  xMm: 0,
  yMm: 0,
  ...more,
});
