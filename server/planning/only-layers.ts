/** `--only NAME…`: which layers that leaves out. */
import { PlotwrightError, prepare, type Drawing } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";

/** Settings with every layer hidden that is not named (by name or id, in any case of letters). */
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
  // Who names a layer wants it, whatever its own name says.
  const prepareSettings = { ...settings.prepare, hiddenLayers: idsOf(false), shownLayers: idsOf(true) };
  return { ...settings, prepare: prepareSettings };
}
