/** The button that gives each colour a pen: not shown when it would change nothing. */
import { renderToStaticMarkup } from "react-dom/server";
import { expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../src/schema/index.js";
import type { Backend } from "../../../web/backend/backend.js";
import { pensFromColors, setLayerPen } from "../../../web/layers/layer-settings.js";
import { PenList } from "../../../web/pens/pen-list.js";
import type { Actions } from "../../../web/state/actions.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore } from "../../../web/state/store.js";
import { PageContext } from "../../../web/state/use-store.js";
import type { Planned } from "../../../web/worker/protocol.js";

const LAYERS = [
  { id: "sky", name: "Sky", color: "#0000ff" },
  { id: "sun", name: "Sun", color: "#ffcc00" },
];

const isOffered = (settings: PlotSettings): boolean => {
  const store = createPageStore({ settings, view: DEFAULT_VIEW });
  store.setState({ planned: { layers: LAYERS } as unknown as Planned });
  const html = renderToStaticMarkup(
    <PageContext
      value={{
        store: { ...store, getInitialState: store.getState },
        backend: {} as Backend,
        actions: {} as Actions,
      }}
    >
      <PenList />
    </PageContext>,
  );
  return html.includes("A pen for each colour");
};

it("is shown until every colour has its pen, in whatever order the layers got them", () => {
  expect(isOffered(DEFAULT_PLOT_SETTINGS)).toBe(true);
  const done = pensFromColors(DEFAULT_PLOT_SETTINGS, LAYERS, String);
  expect(isOffered(done)).toBe(false);
  expect(isOffered(setLayerPen(done, "sky", done.layerPens.sky))).toBe(false);
  expect(isOffered(setLayerPen(done, "sky", null))).toBe(true);
});
