/** Messages and errors are shown once: on the page, or in the dialog that covers it. */
import { renderToStaticMarkup } from "react-dom/server";
import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import type { Backend } from "../../../web/backend/backend.js";
import type { Actions } from "../../../web/state/actions.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore, type DialogName } from "../../../web/state/store.js";
import { PageContext } from "../../../web/state/use-store.js";
import { Notices } from "../../../web/ui/notices.js";

const FAULT = "The server can’t be reached.";

const countShown = (openDialog: DialogName | null): { readonly page: number; readonly dialog: number } => {
  const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
  store.setState({ openDialog, notices: [{ id: 1, kind: "error", text: FAULT }] });
  const page = {
    store: { ...store, getInitialState: store.getState },
    backend: {} as Backend,
    actions: {} as Actions,
  };
  const countIn = (isInDialog: boolean): number =>
    renderToStaticMarkup(
      <PageContext value={page}>
        <Notices isInDialog={isInDialog} />
      </PageContext>,
    ).split(FAULT).length - 1;
  return { page: countIn(false), dialog: countIn(true) };
};

describe("an error", () => {
  it("is on the page while no dialog covers it", () => {
    expect(countShown(null)).toEqual({ page: 1, dialog: 0 });
    // The search is a dialog without messages.
    expect(countShown("search")).toEqual({ page: 1, dialog: 0 });
  });

  it("is in the open dialog, and not on the page behind it too", () => {
    expect(countShown("sharing")).toEqual({ page: 0, dialog: 1 });
  });
});
