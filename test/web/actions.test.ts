import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import { createApiClient } from "../../web/api/client.js";
import { createActions } from "../../web/state/actions.js";
import { DEFAULT_VIEW } from "../../web/state/persist.js";
import { createPageStore } from "../../web/state/store.js";

function makePage() {
  const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
  let isServerUp = false;
  const api = createApiClient(() =>
    isServerUp ? Promise.resolve(Response.json({ samples: [] })) : Promise.reject(new Error("refused")),
  );
  const planner = { request: () => undefined, export: () => undefined };
  const actions = createActions({ store, api, planner, nowMs: () => 0, after: () => undefined });
  const errorCount = (): number => store.getState().notices.filter(({ kind }) => kind === "error").length;
  return { actions, errorCount, startServer: () => (isServerUp = true) };
}

describe("a message of what went wrong", () => {
  it("stays until it is closed or something goes right", async () => {
    const { actions, errorCount, startServer } = makePage();
    await actions.loadSamples();
    await actions.loadSamples();
    expect(errorCount()).toBe(1);
    startServer();
    await actions.loadSamples();
    expect(errorCount()).toBe(0);
  });

  it("goes away with the next drawing", async () => {
    const { actions, errorCount } = makePage();
    await actions.loadSamples();
    expect(errorCount()).toBe(1);
    actions.openPasted("<svg width='9'/>");
    expect(errorCount()).toBe(0);
  });
});
