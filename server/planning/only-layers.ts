/** `--only NAME…`: hides all other layers. */
import { PlotwrightError, prepare, type Drawing } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";

/** The settings with every layer hidden that is not in `only` (by name or id, case-insensitive). */
export function withOnlyLayers(
  drawing: Drawing,
  settings: PlotSettings,
  only: readonly string[] | undefined,
): PlotSettings {
  if (only === undefined) return settings;
  const { layers } = prepare(drawing, { ...settings.prepare, order: "none", hiddenLayers: [] });
  const wanted = new Set(only.map((name) => name.toLowerCase()));
  const isWanted = (layer: { id: string; name: string }): boolean =>
    wanted.has(layer.name.toLowerCase()) || wanted.has(layer.id.toLowerCase());
  const missing = only.find(
    (name) =>
      !layers.some((layer) => [layer.name, layer.id].some((one) => one.toLowerCase() === name.toLowerCase())),
  );
  if (missing !== undefined) {
    const known = layers.map((layer) => JSON.stringify(layer.name)).join(", ");
    throw new PlotwrightError(
      "bad-setting",
      `--only: there is no layer ${JSON.stringify(missing)}. The drawing has ${known}.`,
    );
  }
  const idsOf = (isOn: boolean): string[] =>
    layers.filter((layer) => isWanted(layer) === isOn).map((layer) => layer.id);
  // A layer named here is drawn even if a code in its own name hides it.
  const prepareSettings = { ...settings.prepare, hiddenLayers: idsOf(false), shownLayers: idsOf(true) };
  return { ...settings, prepare: prepareSettings };
}
