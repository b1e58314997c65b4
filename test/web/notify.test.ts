import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS, type Job } from "../../src/schema/index.js";
import { noticeOfChange, watchJobs } from "../../web/queue/notify.js";
import { DEFAULT_VIEW } from "../../web/state/persist.js";
import { createPageStore } from "../../web/state/store.js";
import { makeJob } from "./fixtures.js";

const moon = (more: Partial<Job>): Job => makeJob("moon", { name: "Moon", ...more });
const plotting = moon({ state: "plotting" });

describe("notices of jobs", () => {
  it("are for ends and interruptions, not for the user's actions", () => {
    expect(noticeOfChange(plotting, moon({ state: "done" }))).toContain("Moon");
    expect(noticeOfChange(plotting, moon({ state: "failed" }))).toContain("Moon");
    expect(noticeOfChange(plotting, moon({ state: "interrupted" }))).toContain("Moon");
    expect(noticeOfChange(plotting, moon({ state: "paused" }))).toBeNull();
    expect(noticeOfChange(plotting, moon({ state: "cancelled" }))).toBeNull();
    expect(noticeOfChange(null, moon({ state: "done" }))).toBeNull();
  });

  it("name the pen that a plot waits for, once", () => {
    const wait = { kind: "pen", layerName: "Sun", penName: "Red 0.5", color: "#c00" } as const;
    const waiting = moon({ state: "paused", wait });
    expect(noticeOfChange(plotting, waiting)).toContain("Red 0.5");
    expect(noticeOfChange(waiting, { ...waiting, message: "other words" })).toBeNull();
    const nameless = moon({ state: "paused", wait: { ...wait, penName: null } });
    expect(noticeOfChange(plotting, nameless)).toContain("Sun");
  });

  it("are shown once, and not for the history in a first snapshot", () => {
    const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
    const said: string[] = [];
    watchJobs(store, (sentence) => said.push(sentence));
    store.setState({ jobs: [makeJob("old", { state: "done" }), makeJob("a", { state: "plotting" })] });
    store.setState({ jobs: [makeJob("old", { state: "done" }), makeJob("a", { state: "done" })] });
    store.setState({ jobs: [makeJob("old", { state: "done" }), makeJob("a", { state: "done" })] });
    expect(said).toHaveLength(1);
  });
});
