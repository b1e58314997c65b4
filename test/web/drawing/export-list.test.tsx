/** Saving to a file: only what was planned with the settings on the page. */
import { renderToStaticMarkup } from "react-dom/server";
import { expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import type { Backend } from "../../../web/backend/backend.js";
import { ExportList } from "../../../web/drawing/export-list.js";
import type { Actions } from "../../../web/state/actions.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore } from "../../../web/state/store.js";
import { PageContext } from "../../../web/state/use-store.js";
import { EXPORT_FORMATS } from "../../../web/worker/protocol.js";

/** What each button of the list says, and whether it is off. */
const buttons = (isPlanning: boolean): readonly string[] => {
  const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
  // React writes a page as text from the store's first state.
  const page = { ...store, getInitialState: () => ({ ...store.getState(), isPlanning }) };
  const html = renderToStaticMarkup(
    <PageContext value={{ store: page, backend: {} as Backend, actions: {} as Actions }}>
      <ExportList />
    </PageContext>,
  );
  return [...html.matchAll(/<button([^>]*)>([^<]*)</g)].map(
    ([, attributes, words]) => `${words} ${attributes.includes("disabled") ? "off" : "on"}`,
  );
};

it("waits for the plan of the last change, and says so", () => {
  expect(buttons(true)).toEqual(EXPORT_FORMATS.map(() => "Planning… off"));
  expect(buttons(false)).toEqual(EXPORT_FORMATS.map(() => "Save on"));
});
