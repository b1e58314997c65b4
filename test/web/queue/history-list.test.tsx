/** The history on the page: how many jobs it lists, and what its last button does. */
import { renderToStaticMarkup } from "react-dom/server";
import { expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import type { Backend } from "../../../web/backend/backend.js";
import { HistoryList } from "../../../web/queue/history-list.js";
import type { Actions } from "../../../web/state/actions.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore, type PageState } from "../../../web/state/store.js";
import { PageContext } from "../../../web/state/use-store.js";
import { makeJob, makePlotter } from "../../support/jobs/jobs-on-page.js";

/** The number of rows, and the text of the button below them; null if there is none. */
function shown(jobCount: number, state: Partial<PageState>): readonly [rows: number, button: string | null] {
  const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
  const jobs = Array.from({ length: jobCount }, (_, i) => makeJob(String(i), { state: "done" }));
  // React writes a page as text from the store's first state.
  const page = { ...store, getInitialState: () => ({ ...store.getState(), jobs, ...state }) };
  const html = renderToStaticMarkup(
    <PageContext value={{ store: page, backend: {} as Backend, actions: {} as Actions }}>
      <HistoryList jobs={jobs} />
    </PageContext>,
  );
  return [html.match(/<article/g)?.length ?? 0, /class="link"[^>]*>([^<]*)</.exec(html)?.[1] ?? null];
}

it("offers the jobs that the page has, then those that it must fetch", () => {
  expect(shown(7, {})).toEqual([7, null]);
  expect(shown(25, {})).toEqual([20, "Show 5 more"]);
  expect(shown(50, { hasOlderJobs: true })).toEqual([20, "Show 20 more"]);
  expect(shown(25, { hasOlderJobs: true })).toEqual([20, "Show older plots"]);
  expect(shown(0, { hasOlderJobs: true })).toEqual([0, "Show older plots"]);
  expect(shown(7, { hasOlderJobs: true, wholeHistories: [""] })).toEqual([7, null]);
});

it("asks for the history of the plotter that it shows", () => {
  const plotters = [makePlotter("virtual"), makePlotter("other")];
  const state = { plotters, plotterId: "virtual", hasOlderJobs: true };
  expect(shown(7, { ...state, wholeHistories: ["other"] })).toEqual([7, "Show older plots"]);
  expect(shown(7, { ...state, wholeHistories: ["virtual"] })).toEqual([7, null]);
});
