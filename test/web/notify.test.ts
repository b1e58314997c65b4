import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import { noticeOfChange, watchJobs } from "../../web/state/notify.js";
import { DEFAULT_VIEW } from "../../web/state/persist.js";
import { createPageStore } from "../../web/state/store.js";
import { makeJob } from "./fixtures.js";

describe("notices of jobs", () => {
  it("are for ends and interruptions, not for what the user does", () => {
    expect(noticeOfChange("plotting", "done", "Moon")).toContain("Moon");
    expect(noticeOfChange("plotting", "failed", "Moon")).toContain("Moon");
    expect(noticeOfChange("plotting", "interrupted", "Moon")).toContain("Moon");
    expect(noticeOfChange("plotting", "paused", "Moon")).toBeNull();
    expect(noticeOfChange("plotting", "cancelled", "Moon")).toBeNull();
    expect(noticeOfChange(null, "done", "Moon")).toBeNull();
  });

  it("are said once, and not for the history that a first snapshot brings", () => {
    const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
    const said: string[] = [];
    watchJobs(store, (sentence) => said.push(sentence));
    store.setState({ jobs: [makeJob("old", { state: "done" }), makeJob("a", { state: "plotting" })] });
    store.setState({ jobs: [makeJob("old", { state: "done" }), makeJob("a", { state: "done" })] });
    store.setState({ jobs: [makeJob("old", { state: "done" }), makeJob("a", { state: "done" })] });
    expect(said).toHaveLength(1);
  });
});
