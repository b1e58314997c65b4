/** The jobs of the ringing sheets. They have their own motion and place, and the plotter's machine, pen and paper. */
import {
  CHECK_ACCEL,
  findMachine,
  NEXT_STAIRS_MM,
  orientedPaper,
  ringingChecks,
  RINGING_MOTION,
  RINGING_SHEET_MM,
  ringingSheet,
  STAIRS_MM,
  type PaperSize,
  type RingingCheck,
  type Springs,
} from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  machineProfileSchema,
  plotterPartOf,
  type NewJob,
  type PlotSettings,
} from "../../src/schema/index.js";

export type SheetJob = NewJob & { readonly drawing: string; readonly settings: PlotSettings };

/** Min. distance between the lines of the second sheet, mm: keeps their ripples apart. */
const MIN_NEXT_MM = 4;

interface PlaceMm {
  readonly xMm: number;
  readonly yMm: number;
}

/** The corner of a sheet in the middle of the part of the paper that the machine reaches. Null: not enough room. */
export const middlePlace = (settings: PlotSettings, widthMm: number, heightMm: number): PlaceMm | null => {
  const room = roomOn(settings);
  const xMm = (room.widthMm - widthMm) / 2;
  const yMm = (room.heightMm - heightMm) / 2;
  return xMm < 0 || yMm < 0 ? null : { xMm, yMm };
};

const roomOn = (settings: PlotSettings): PaperSize => {
  const paper = orientedPaper(settings.prepare.paper, settings.prepare.landscape);
  const machine = findMachine(settings) ?? paper;
  return {
    widthMm: Math.min(paper.widthMm, machine.widthMm),
    heightMm: Math.min(paper.heightMm, machine.heightMm),
  };
};

/** The first sheet. Null: not enough room. */
export const sheetJob = (settings: PlotSettings, name: string): SheetJob | null => {
  const place = middlePlace(settings, RINGING_SHEET_MM.width, RINGING_SHEET_MM.height);
  if (place === null) return null;
  return {
    name,
    drawing: ringingSheet(),
    settings: { ...sheetSettings(settings, place.xMm, place.yMm), motion: RINGING_MOTION },
  };
};

/** Where the second sheet's figures are. The first is at the bottom left, each next one `nextMm` up and right. */
interface ChecksPlace extends PlaceMm {
  readonly nextMm: number;
}

/** Null: not enough room. */
export const checksPlace = (settings: PlotSettings, figures: number): ChecksPlace | null => {
  const { widthMm, heightMm } = roomOn(settings);
  const room = (Math.min(widthMm, heightMm) - STAIRS_MM) / (figures - 1);
  if (room < MIN_NEXT_MM) return null;
  const nextMm = Math.min(NEXT_STAIRS_MM, Math.floor(room));
  const sizeMm = STAIRS_MM + (figures - 1) * nextMm;
  const place = middlePlace(settings, sizeMm, sizeMm);
  return place && { ...place, nextMm };
};

/** The second sheet: one figure, unshaped and shaped for each frequency. Each is a job, because the shaping differs. */
export const checkJobs = (
  settings: PlotSettings,
  springs: Springs,
  nameOf: (check: RingingCheck) => string,
): SheetJob[] => {
  const checks = ringingChecks(springs);
  const place = checksPlace(settings, checks.length);
  const machine = findMachine(settings);
  if (place === null || machine === null) return [];
  const plain = DEFAULT_PLOT_SETTINGS.motion;
  return checks.map((check, i) => ({
    name: nameOf(check),
    drawing: check.svg,
    settings: {
      ...sheetSettings(
        settings,
        place.xMm + i * place.nextMm,
        place.yMm + (checks.length - 1 - i) * place.nextMm,
      ),
      motion: {
        ...plain,
        shaper: check.springs === null ? "none" : "zv",
        draw: { ...plain.draw, accelMmPerS2: CHECK_ACCEL },
      },
      machine: machine.id,
      customMachine: machineProfileSchema.parse({ ...machine, springs: check.springs }),
    },
  }));
};

/** The plotter's machine, pen and paper, for a sheet with its corner at that place, mm. */
export const sheetSettings = (settings: PlotSettings, xMm: number, yMm: number): PlotSettings => ({
  ...settings,
  prepare: {
    ...DEFAULT_PLOT_SETTINGS.prepare,
    paper: settings.prepare.paper,
    landscape: settings.prepare.landscape,
    marginMm: 0,
    fit: false,
    clipToMargins: false,
    order: "none",
    layout: { xMm, yMm, widthMm: null, heightMm: null },
  },
  pen: plotterPartOf(settings).pen,
  pens: [],
  layerPens: {},
  layerStops: {},
  penStops: "never",
});
