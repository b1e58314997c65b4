import { DEFAULT_PLOT_SETTINGS, type Job, type Plotter } from "../../src/schema/index.js";
import type { Frame } from "../../web/scene/renderer.js";

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
  expectedS: null,
  wait: null,
  createdAt: "2026-01-01T00:00:00.000Z",
  startedAt: null,
  endedAt: null,
  ...more,
});

export const makePlotter = (id: string, more: Partial<Plotter> = {}): Plotter => ({
  id,
  name: "Virtual plotter",
  boardName: null,
  boardSerialNumber: null,
  emergencyStopMs: null,
  machine: null,
  kind: "virtual",
  device: null,
  connection: "idle",
  firmware: "3.0.3",
  message: null,
  penUp: true,
  penMoving: false,
  activity: "none",
  motorsOn: false,
  xMm: 0,
  yMm: 0,
  ...more,
});

export const makeFrame = (offsetX: number): Frame => ({
  view: { scale: 1, offsetX, offsetY: 0 },
  width: 100,
  height: 100,
  ratio: 1,
  colorBy: "layer",
  showTravel: false,
  layerColors: [],
  layerWidthsMm: [],
  untilS: null,
});
