import { afterEach, describe, expect, it, vi } from "vitest";
import { DEFAULT_PLOT_SETTINGS, type Job } from "../../../src/schema/index.js";
import { noticeOfChange, showNotification, watchJobs } from "../../../web/queue/notify.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore } from "../../../web/state/store.js";
import { makeJob } from "../../support/jobs/jobs-on-page.js";

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

describe("system notifications", () => {
  afterEach(() => vi.unstubAllGlobals());

  /** Collects what is shown, and by what. `isPhone`: as in Chrome on Android, pages can't show one themselves. */
  function browserWith(options: {
    isPhone?: boolean;
    worker?: "active" | "installing";
    permission?: string;
  }) {
    const { isPhone = false, worker, permission = "granted" } = options;
    const shown: string[] = [];
    class Shown {
      static readonly permission = permission;
      constructor(_title: string, { body }: { body: string }) {
        if (isPhone) throw new TypeError("Illegal constructor");
        shown.push(`page: ${body}`);
      }
    }
    const registration = {
      active: worker === "active" ? {} : null,
      showNotification: (_title: string, { body }: { body: string }) => {
        shown.push(`worker: ${body}`);
        return Promise.resolve();
      },
    };
    const getRegistration = () => Promise.resolve(worker && registration);
    vi.stubGlobal("Notification", Shown);
    vi.stubGlobal("window", { Notification: Shown });
    vi.stubGlobal("navigator", { serviceWorker: { getRegistration } });
    return shown;
  }

  it("are shown by the service worker, on phones too", async () => {
    const shown = browserWith({ isPhone: true, worker: "active" });
    await showNotification("Moon is done");
    expect(shown).toEqual(["worker: Moon is done"]);
  });

  it("are shown by the page if no service worker is ready", async () => {
    for (const worker of [undefined, "installing"] as const) {
      const shown = browserWith(worker ? { worker } : {});
      await showNotification("Moon is done");
      expect(shown).toEqual(["page: Moon is done"]);
    }
  });

  it("are left out, without an error, if the browser can't or may not show them", async () => {
    const onPhone = browserWith({ isPhone: true });
    await showNotification("Moon is done");
    const denied = browserWith({ worker: "active", permission: "denied" });
    await showNotification("Moon is done");
    expect([...onPhone, ...denied]).toEqual([]);
  });
});
