/**
 * What the page remembers between visits, parsed by the same schema as everything that crosses a wire:
 * a stored value that does not fit, from an older version for example, is replaced by its default. The rest stays.
 */
import { z } from "zod";
import { findMachine, LENGTH_UNITS, type LengthUnit } from "../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, plotSettingsSchema, type PlotSettings } from "../../src/schema/index.js";
import { COLOR_MODES, type ColorMode } from "../scene/color-mode.js";
import { plannable } from "./motion-of-machine.js";

export const PAGE_KEY = "plotwright.page.v1";

export const THEMES = ["auto", "light", "dark"] as const;
export type Theme = (typeof THEMES)[number];

export interface ViewSettings {
  readonly showTravel: boolean;
  readonly colorBy: ColorMode;
  readonly showGraph: boolean;
  readonly theme: Theme;
  /** What fields and rulers show lengths in. */
  readonly lengthUnit: LengthUnit;
  /** Ids of the groups of settings that are folded open. */
  readonly openGroups: readonly string[];
  /** Where the camera's picture comes from; empty: no camera. */
  readonly cameraUrl: string;
  /** Seconds between still pictures; 0: it is a stream. */
  readonly cameraEveryS: number;
  /** The steps of a first plot were put away. */
  readonly hidesFirstPlot: boolean;
}

export const DEFAULT_VIEW: ViewSettings = {
  showTravel: false,
  colorBy: "speed",
  showGraph: false,
  theme: "auto",
  lengthUnit: "mm",
  openGroups: ["drawing", "paper", "layers", "motion"],
  cameraUrl: "",
  cameraEveryS: 0,
  hidesFirstPlot: false,
};

const viewSchema = z.object({
  showTravel: z.boolean(),
  colorBy: z.enum(COLOR_MODES),
  showGraph: z.boolean(),
  theme: z.enum(THEMES),
  lengthUnit: z.enum(LENGTH_UNITS),
  openGroups: z.array(z.string().max(50)).max(50),
  cameraUrl: z.string().max(2_000),
  cameraEveryS: z.number().min(0).max(3_600),
  hidesFirstPlot: z.boolean(),
}) satisfies z.ZodType<ViewSettings>;

export interface Remembered {
  readonly settings: PlotSettings;
  readonly view: ViewSettings;
}

/** What of localStorage is used; a private window may refuse it. */
export interface TextStore {
  getItem(key: string): string | null;
  setItem(key: string, value: string): void;
}

/** Never throws: each part that does not parse is the default. */
export const parseRemembered = (stored: string | null): Remembered => {
  const root = recordOf(parseJson(stored));
  return { settings: settingsOr(recordOf(root.settings)), view: partOr(viewSchema, DEFAULT_VIEW, root.view) };
};

/** Each part (paper and fill, speeds, pen, machine …) by itself, so that each takes up the fields it lacks. */
const settingsOr = (stored: Record<string, unknown>): PlotSettings => {
  const defaults: Record<string, unknown> = DEFAULT_PLOT_SETTINGS;
  const parts = Object.entries(plotSettingsSchema.shape).map(([name, schema]) => [
    name,
    partOr<unknown>(schema, defaults[name], stored[name]),
  ]);
  const result = plotSettingsSchema.safeParse(Object.fromEntries(parts));
  if (!result.success) return DEFAULT_PLOT_SETTINGS;
  // A machine whose profile does not parse any more is no machine.
  const machine = findMachine(result.data);
  const motion = plannable(result.data.motion, machine?.springs ?? null);
  return { ...result.data, machine: machine?.id ?? DEFAULT_PLOT_SETTINGS.machine, motion };
};

/** How many values of a part are replaced one by one; a part with more faults than that is replaced as a whole. */
const MOST_FAULTS = 100;

/** Fields that a newer version added come from the default, and so does each value that does not fit. */
const partOr = <T>(schema: z.ZodType<T>, whole: T, stored: unknown): T => {
  let part: unknown = isRecord(whole) ? { ...whole, ...recordOf(stored) } : stored;
  for (let faults = 0; faults < MOST_FAULTS; faults++) {
    const result = schema.safeParse(part);
    if (result.success) return result.data;
    part = mended(part, whole, result.error.issues[0]?.path ?? []);
  }
  return whole;
};

/** `value` with the default's at `path`; what the default does not have (a pen, a layer's entry) is left out. */
const mended = (value: unknown, whole: unknown, path: readonly PropertyKey[]): unknown => {
  const [key, ...rest] = path;
  if (Array.isArray(value) && Array.isArray(whole) && key !== undefined) {
    return value.filter((_, index) => index !== key);
  }
  if (typeof key !== "string" || !isRecord(value) || !isRecord(whole)) return whole;
  if (Object.hasOwn(whole, key)) return { ...value, [key]: mended(value[key], whole[key], rest) };
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

/** Layer switches too: the drawing that they belong to comes back with them (see kept-drawing.ts). */
export const writeRemembered = (store: TextStore | null, { settings, view }: Remembered): void => {
  try {
    store?.setItem(PAGE_KEY, JSON.stringify({ settings, view }));
  } catch {
    // A full or refused store only means that the next visit begins with the defaults.
  }
};
