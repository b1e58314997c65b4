/** Named settings for a pen or a paper, kept in the browser and parsed by the schema like everything stored. */
import { z } from "zod";
import { motionSettingsSchema, penSettingsSchema, type PlotSettings } from "../../src/schema/index.js";
import type { TextStore } from "./persist.js";

const KEY = "plotwright.presets.v1";
const MAX_PRESETS = 100;

/** What a preset carries: how the pen moves and stands, not where the drawing lies. */
const presetSchema = z.object({
  name: z.string().trim().min(1).max(60),
  motion: motionSettingsSchema,
  pen: penSettingsSchema,
});
export type Preset = z.infer<typeof presetSchema>;

export const readPresets = (store: TextStore | null): Preset[] => {
  try {
    const list: unknown = JSON.parse(store?.getItem(KEY) ?? "[]");
    if (!Array.isArray(list)) return [];
    return list.flatMap((item) => {
      const parsed = presetSchema.safeParse(item);
      return parsed.success ? [parsed.data] : [];
    });
  } catch {
    return [];
  }
};

export const writePresets = (store: TextStore | null, presets: readonly Preset[]): void => {
  try {
    store?.setItem(KEY, JSON.stringify(presets));
  } catch {
    // A full or refused store: the presets last as long as the page.
  }
};

/** The list with the preset in it: in the place of one of the same name, else at the end. */
export const withPreset = (presets: readonly Preset[], name: string, settings: PlotSettings): Preset[] => {
  const preset = { name: name.trim(), motion: settings.motion, pen: settings.pen };
  const others = presets.filter((other) => other.name !== preset.name);
  return [...others, preset].slice(-MAX_PRESETS);
};
