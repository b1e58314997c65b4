import { createHash } from "node:crypto";
import type { StoredDrawing } from "../../../server/storage/drawing-files.js";
import { DEFAULT_PLOT_SETTINGS, type Job, type JobStats, type Plotter } from "../../../src/schema/index.js";

export const STATS: JobStats = {
  size: { widthMm: 60, heightMm: 40, scaleX: 1, scaleY: 1, turnedDeg: 0 },
  strokeCount: 3,
  pointCount: 30,
  drawMm: 120,
  travelMm: 40,
  penLiftCount: 3,
  durationS: 12,
};

export function makeJob(id: string, overrides: Partial<Job> = {}): Job {
  return {
    id,
    plotterId: "virtual",
    name: `Job ${id}`,
    state: "queued",
    settings: DEFAULT_PLOT_SETTINGS,
    stats: STATS,
    warnings: [],
    progress: 0,
    elapsedS: 0,
    remainingS: 12,
    message: null,
    place: null,
    speedPct: 100,
    plottedS: null,
    expectedS: null,
    wait: null,
    stopped: false,
    createdAt: "2026-01-01T00:00:00.000Z",
    startedAt: null,
    endedAt: null,
    ...overrides,
  };
}

export const drawingOf = (text: string): StoredDrawing => ({
  id: createHash("md5").update(text).digest("hex"),
  bytes: text.length,
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
  otherBoard: null,
  firmware: "3.0.3",
  message: null,
  penUp: true,
  penMoving: false,
  heightUnsure: false,
  activity: "none",
  motorsOn: false,
  xMm: 0,
  yMm: 0,
  ...more,
});
