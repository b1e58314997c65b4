/** The pens of a job, from which the page tells when the queue waits for a person. */
import { expect, it } from "vitest";
import { pensOf } from "../../../host/planning/stages.js";
import { importSvg, planJob, prepare } from "../../../src/index.js";
import { machineOf, prepareSettingsOf } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, plotSettingsSchema, type PlotSettings } from "../../../src/schema/index.js";

const PEN = { widthMm: 0.3, offsetXMm: 0, offsetYMm: 0 };

/** Layers of one line each, with their names. */
const pensOfLayers = async (names: readonly string[], more: Partial<PlotSettings> = {}) => {
  const layers = names.map(
    (name, i) =>
      `<g id="layer${i}" inkscape:groupmode="layer" inkscape:label="${name}"><path d="M10 ${10 + 10 * i}h80" stroke="#00${i}"/></g>`,
  );
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="100mm" height="100mm" viewBox="0 0 100 100" fill="none">${layers.join("")}</svg>`;
  const settings = { ...DEFAULT_PLOT_SETTINGS, ...more };
  const prepared = prepare(await importSvg(svg), prepareSettingsOf(settings));
  const job = planJob(prepared, settings, machineOf(settings));
  return { pens: pensOf(prepared.strokes, settings, job.trajectory), durationS: job.trajectory.totalS };
};

it("has no pens and no stops if none are assigned", async () => {
  expect((await pensOfLayers(["one", "two"])).pens).toEqual({ first: null, last: null, stops: [] });
});

it("names the first and the last pen, and when the plot waits for each", async () => {
  const twoPens = plotSettingsSchema.parse({
    ...DEFAULT_PLOT_SETTINGS,
    pens: [
      { id: "r", name: "Red", color: "#c8102e", ...PEN },
      { id: "b", name: "Black", color: null, ...PEN },
    ],
    layerPens: { layer0: "b", layer1: "r" },
  });
  const { pens, durationS } = await pensOfLayers(["one", "two"], twoPens);
  expect(pens.first?.name).toBe("Black");
  expect(pens.last).toEqual({ name: "Red", color: "#c8102e" });
  expect(pens.stops.map(({ name, strokeIndex }) => [name, strokeIndex])).toEqual([
    ["Black", 0],
    ["Red", 1],
  ]);
  // The two lines are equally long.
  expect(pens.stops[1].atS / durationS).toBeGreaterThan(0.3);
  expect(pens.stops[1].atS / durationS).toBeLessThan(0.7);
});

it("lists at most 20 stops, so that a page with many jobs stays quick", async () => {
  const names = Array.from({ length: 30 }, (_, i) => `!layer ${i}`);
  const { pens } = await pensOfLayers(names);
  expect(pens.stops.length).toBe(20);
  const times = pens.stops.map(({ atS }) => atS);
  expect(times).toEqual([...times].sort((a, b) => a - b));
});
