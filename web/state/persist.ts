/**
 * What the page remembers between visits. It is parsed by the schema: a stored value that does not fit is replaced by its
 * default. The rest stays.
 */
import { z } from "zod";
import { findMachine, LENGTH_UNITS, withoutShaperIfUnmeasured } from "../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, plotSettingsSchema, type PlotSettings } from "../../src/schema/index.js";

const PAGE_KEY = "plotwright.page.v1";

export const THEMES = ["auto", "light", "dark"] as const;
export type Theme = (typeof THEMES)[number];

/** The panels beside the paper, one open at a time, in the order of the rail. */
export const PANELS = ["drawing", "paper", "layers", "lines", "speed", "plotter", "queue"] as const;
export type PanelName = (typeof PANELS)[number];

const viewSchema = z.object({
  /** The open panel of Prepare; null: none. */
  panel: z.enum(PANELS).nullable(),
  showTravel: z.boolean(),
  /** Id of a record of preview/view-modes.tsx. */
  viewMode: z.string().max(50),
  showGraph: z.boolean(),
  theme: z.enum(THEMES),
  /** How far the sheet's picture is turned clockwise, in quarters. */
  deskTurn: z.number().int().min(0).max(3),
  /** The unit of lengths in fields and on rulers. */
  lengthUnit: z.enum(LENGTH_UNITS),
  /** Of lines drawn on the page: 0 is as the hand drew them. */
  smoothingPct: z.number().min(0).max(100),
  /** Ids of the open groups of settings. */
  openGroups: z.array(z.string().max(50)).max(50),
  /** Address of the camera's picture; empty: no camera. */
  cameraUrl: z.string().max(2_000),
  /** Seconds between still pictures; 0: a stream. */
  cameraEveryS: z.number().min(0).max(3_600),
  /** The user has closed the first-plot guide. */
  hidesFirstPlot: z.boolean(),
  /** The user does not want to measure pen and ringing. */
  hidesTuning: z.boolean(),
});
export type ViewSettings = Readonly<z.infer<typeof viewSchema>>;

export const DEFAULT_VIEW: ViewSettings = {
  panel: "plotter",
  showTravel: false,
  viewMode: "ink",
  showGraph: false,
  theme: "auto",
  deskTurn: 0,
  lengthUnit: "mm",
  smoothingPct: 40,
  openGroups: [],
  cameraUrl: "",
  cameraEveryS: 0,
  hidesFirstPlot: false,
  hidesTuning: false,
};

export interface Remembered {
  readonly settings: PlotSettings;
  readonly view: ViewSettings;
}

/** The used part of localStorage. A private window may refuse it. */
export interface TextStore {
  getItem(key: string): string | null;
  setItem(key: string, value: string): void;
}

/** Never throws: a part that does not parse is replaced by its default. */
export const parseRemembered = (stored: string | null): Remembered => {
  const root = recordOf(parseJson(stored));
  return { settings: settingsOr(recordOf(root.settings)), view: partOr(viewSchema, DEFAULT_VIEW, root.view) };
};

/**
 * Parses each part (paper and fill, speeds, pen, machine …) separately, so that one bad part does not reset the rest.
 */
const settingsOr = (stored: Record<string, unknown>): PlotSettings => {
  const defaults: Record<string, unknown> = { ...DEFAULT_PLOT_SETTINGS };
  const parts = Object.entries(plotSettingsSchema.shape).map(([name, schema]) => [
    name,
    partOr<unknown>(schema, defaults[name], stored[name]),
  ]);
  const result = plotSettingsSchema.safeParse(Object.fromEntries(parts));
  if (!result.success) return DEFAULT_PLOT_SETTINGS;
  // A custom machine whose profile no longer parses is replaced by the default machine.
  const machine = findMachine(result.data);
  const motion = withoutShaperIfUnmeasured(result.data.motion, machine?.springs ?? null);
  return { ...result.data, machine: machine?.id ?? DEFAULT_PLOT_SETTINGS.machine, motion };
};

/** A part with more bad values than this is replaced as a whole. */
const MAX_FAULTS = 100;

/** Missing fields, and values that do not fit, come from the default. */
const partOr = <T>(schema: z.ZodType<T>, whole: T, stored: unknown): T => {
  let part: unknown = isRecord(whole) ? { ...whole, ...recordOf(stored) } : stored;
  for (let faults = 0; faults < MAX_FAULTS; faults++) {
    const result = schema.safeParse(part);
    if (result.success) return result.data;
    part = repaired(part, whole, result.error.issues[0]?.path ?? []);
  }
  return whole;
};

/** `value` with the default at `path`. An entry without a default (a pen, a layer's setting) is removed. */
const repaired = (value: unknown, whole: unknown, path: readonly PropertyKey[]): unknown => {
  const [key, ...rest] = path;
  if (Array.isArray(value) && Array.isArray(whole) && key !== undefined) {
    return value.filter((_, index) => index !== key);
  }
  if (typeof key !== "string" || !isRecord(value) || !isRecord(whole)) return whole;
  if (Object.hasOwn(whole, key)) return { ...value, [key]: repaired(value[key], whole[key], rest) };
  return Object.fromEntries(Object.entries(value).filter(([name]) => name !== key));
};

const parseJson = (stored: string | null): unknown => {
  if (stored === null) return null;
  try {
    return JSON.parse(stored);
  } catch {
    return null;
  }
};

const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);

const recordOf = (value: unknown): Record<string, unknown> => (isRecord(value) ? value : {});

export const readRemembered = (store: TextStore | null): Remembered => {
  try {
    return parseRemembered(store?.getItem(PAGE_KEY) ?? null);
  } catch {
    return parseRemembered(null);
  }
};

/** Includes the layers' settings: the drawing that they belong to is restored as well (see kept-drawing.ts). */
export const writeRemembered = (store: TextStore | null, { settings, view }: Remembered): void => {
  try {
    store?.setItem(PAGE_KEY, JSON.stringify({ settings, view }));
  } catch {
    // If the browser stores nothing, the next visit begins with the defaults.
  }
};
