/** The pen sheet on the page: it fits the paper, and the number that was read becomes both extra waits. */
import { renderToStaticMarkup } from "react-dom/server";
import { expect, it } from "vitest";
import { importSvg, machineById, prepare } from "../../../src/index.js";
import { PEN_SHEET_WAITS_MS } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, plotSettingsSchema, type PlotSettings } from "../../../src/schema/index.js";
import type { Backend } from "../../../web/backend/backend.js";
import { PenSheet, penSheetJob } from "../../../web/pens/pen-sheet.js";
import type { Actions } from "../../../web/state/actions.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore } from "../../../web/state/store.js";
import { PageContext } from "../../../web/state/use-store.js";

const shown = (settings: PlotSettings): string => {
  const store = createPageStore({ settings, view: DEFAULT_VIEW });
  return renderToStaticMarkup(
    <PageContext
      value={{
        store: { ...store, getInitialState: store.getState },
        backend: {} as Backend,
        actions: {} as Actions,
      }}
    >
      <PenSheet />
    </PageContext>,
  );
};

it("is plotted in the middle of the paper that the machine reaches, with the plotter's pen", async () => {
  const pen = { ...DEFAULT_PLOT_SETTINGS.pen, upPct: 70, downPct: 40, layers: { sky: { downPct: 10 } } };
  for (const machine of ["axidraw-v3", "axidraw-minikit"]) {
    const job = penSheetJob({ ...DEFAULT_PLOT_SETTINGS, machine, pen }, "Pen sheet")!;
    const settings = plotSettingsSchema.parse(job.settings);
    expect(settings.pen).toMatchObject({ upPct: 70, downPct: 40, overlap: "off" });
    expect(Object.keys(settings.pen.layers ?? {})).toHaveLength(PEN_SHEET_WAITS_MS.length + 1);
    const { strokes } = prepare(await importSvg(job.drawing), settings.prepare);
    const { widthMm, heightMm } = machineById(machine);
    for (let i = 0; i < strokes.xy.length; i += 2) {
      expect(strokes.xy[i]).toBeGreaterThanOrEqual(0);
      expect(strokes.xy[i]).toBeLessThanOrEqual(widthMm);
      expect(strokes.xy[i + 1]).toBeGreaterThanOrEqual(0);
      expect(strokes.xy[i + 1]).toBeLessThanOrEqual(heightMm);
    }
  }
});

it("is not offered on paper that is too small for it", () => {
  const paper = { widthMm: 80, heightMm: 60 };
  const small = { ...DEFAULT_PLOT_SETTINGS, prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, paper } };
  expect(penSheetJob(small, "Pen sheet")).toBeNull();
  expect(shown(small)).toContain("The sheet needs 100 × 72 mm");
  expect(shown(DEFAULT_PLOT_SETTINGS)).not.toContain("The sheet needs");
});

it("shows the number that is stored, if both waits have it", () => {
  const chosenIn = (extraLiftMs: number, extraDropMs: number): string | undefined => {
    const pen = { ...DEFAULT_PLOT_SETTINGS.pen, extraLiftMs, extraDropMs };
    const [chosen] = /<option selected value[^>]*>/.exec(shown({ ...DEFAULT_PLOT_SETTINGS, pen })) ?? [];
    return chosen && (/value="(.*)"/.exec(chosen)?.[1] ?? "");
  };
  expect([chosenIn(0, 0), chosenIn(-40, -40), chosenIn(20, 0), chosenIn(7, 7)]).toEqual(["0", "-40", "", ""]);
});
