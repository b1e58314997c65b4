/** A disk that fills up while a plot runs: the pen can still be stopped, and all reports are right. */
import { mkdirSync, rmSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { Access } from "../../../server/security/access.js";
import { DISK_FULL, isDiskFault } from "../../../host/disk-fault.js";
import { DEFAULT_PLOT_SETTINGS, apiErrorSchema, jobSchema, type Job } from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";
import { EventStream } from "../../support/servers/event-stream.js";
import type { LedRun } from "../../support/jobs/led-plotter.js";
import { openQueueIn } from "../../support/jobs/open-queue.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
let app: TestApp;
let run: LedRun;
let id: string;
beforeEach(async () => {
  app = await startApp();
  id = jobSchema.parse(await (await upload()).json()).id;
  await post("start");
  run = await app.plotter.nextRun();
  run.record({ place: { stroke: 0, alongMm: 2 } });
});
afterEach(async () => {
  vi.restoreAllMocks();
  await app.close();
});

const upload = (): Promise<Response> => fetch(`${app.url}/api/v1/jobs?name=a`, { method: "POST", body: SVG });
const post = (action: string): Promise<Response> =>
  fetch(`${app.url}/api/v1/jobs/${id}/${action}`, { method: "POST" });
const remove = (): Promise<Response> => fetch(`${app.url}/api/v1/jobs/${id}`, { method: "DELETE" });
const job = async (): Promise<Job> =>
  jobSchema.parse(await (await fetch(`${app.url}/api/v1/jobs/${id}`)).json());
const stored = (): Job => app.store.jobs().find((one) => one.id === id)!;

/** The next try to store a job comes soon, not only after 5 s. */
function fillDisk(store = app.store): void {
  const later = setTimeout;
  vi.spyOn(globalThis, "setTimeout").mockImplementation((act: () => void, ms?: number) =>
    later(act, ms === 5_000 ? 100 : ms),
  );
  const writes = ["saveJob", "addJob", "moveJob", "saveJournal", "clearJournal", "saveSetting"] as const;
  for (const name of writes) {
    vi.spyOn(store, name).mockImplementation(() => {
      throw Object.assign(new Error("database or disk is full"), { name: "SQLite3Error" });
    });
  }
}

describe("while the disk is full", () => {
  it.each([
    ["pause", "paused"],
    ["emergency-stop", "paused"],
    ["cancel", "cancelled"],
  ])("%s is answered, and the job's real state is shown", async (action, state) => {
    const events = await EventStream.open(app.url);
    fillDisk();
    const answer = await post(action);
    expect(answer.status).toBe(200);
    const { job: shown } = await events.find("job", (event) => event.job.state === state);
    expect(shown.message).toContain(DISK_FULL);
    expect((await job()).state).toBe(state);
    expect(stored().state).toBe("plotting");
    vi.restoreAllMocks();
    await events.find(
      "job",
      (event) => event.job.state === state && event.job.message?.includes(DISK_FULL) !== true,
    );
    expect(stored()).toEqual(await job());
    events.close();
  });

  it("a paused plot resumes at the first try, with or without space", async () => {
    fillDisk();
    await post("pause");
    expect((await post("resume")).status).toBe(200);
    expect((await job()).state).toBe("plotting");
    await post("pause");
    vi.restoreAllMocks();
    expect((await post("resume")).status).toBe(200);
    expect(run.asked).toEqual(["pause", "resume", "pause", "resume"]);
    expect([(await job()).state, stored().state]).toEqual(["plotting", "plotting"]);
  });

  it("the plot's job reports it, and its end is known", async () => {
    fillDisk();
    run.record({ place: { stroke: 0, alongMm: 3 } });
    expect((await job()).message).toBe(DISK_FULL);
    run.end({ kind: "done" });
    await expect.poll(async () => (await job()).state).toBe("done");
  });

  it("several copies are added together, or none of them", async () => {
    const addJob = app.store.addJob.bind(app.store);
    let count = 0;
    vi.spyOn(app.store, "addJob").mockImplementation((...added) => {
      if (++count === 3) throw new Error("database or disk is full");
      addJob(...added);
    });
    const body = JSON.stringify({ name: "a", drawing: SVG, settings: DEFAULT_PLOT_SETTINGS, copies: 5 });
    const headers = { "Content-Type": "application/json" };
    const response = await fetch(`${app.url}/api/v1/jobs`, { method: "POST", headers, body });
    expect([response.status, count]).toEqual([507, 3]);
    expect(app.store.jobs().map((one) => one.id)).toEqual([id]);
    expect(app.queue.list().map((one) => one.id)).toEqual([id]);
    expect(app.drawingsOnDisk()).toHaveLength(1);
  });

  it("requests that need the disk are refused with an explanation, and nothing moves", async () => {
    run.end({ kind: "cancelled" });
    await expect.poll(async () => (await job()).state).toBe("cancelled");
    const next = jobSchema.parse(await (await upload()).json());
    fillDisk();
    for (const response of [
      await upload(),
      await fetch(`${app.url}/api/v1/jobs/${next.id}/start`, { method: "POST" }),
    ]) {
      const { error } = apiErrorSchema.parse(await response.json());
      expect([response.status, error.code]).toEqual([507, "disk-full"]);
      expect(error.message).toMatch(/disk is full.*Make room/);
    }
    expect(app.queue.isPlotterBusy(app.plotter.id)).toBe(false);
    expect(app.drawingsOnDisk()).toHaveLength(2);
  });

  it.each([
    "disk I/O error",
    "database or disk is full",
    "unable to open database file",
    "attempt to write a readonly database",
  ])("removing a job is refused with an explanation (%s), and the job is still there", async (fault) => {
    const events = await EventStream.open(app.url);
    run.end({ kind: "cancelled" });
    await expect.poll(async () => (await job()).state).toBe("cancelled");
    // The store begins a transaction, and SQLite fails within it.
    const isUsed = vi.spyOn(app.store, "isUsed").mockImplementation(() => {
      throw Object.assign(new Error(fault), { name: "SQLite3Error" });
    });
    const refused = await remove();
    const { error } = apiErrorSchema.parse(await refused.json());
    expect([refused.status, error.code, error.message]).toEqual([
      507,
      "disk-full",
      expect.stringMatching(/disk is full or can't be written to\. Make room/),
    ]);
    expect((await job()).state).toBe("cancelled");
    expect([app.store.jobs().length, app.queue.list().length]).toEqual([1, 1]);
    expect(app.drawingsOnDisk()).toHaveLength(1);
    isUsed.mockRestore();
    expect((await remove()).status).toBe(200);
    await events.find("job-removed");
    expect([app.store.jobs(), app.drawingsOnDisk()]).toEqual([[], []]);
    events.close();
  });

  it("a removed job is gone even if its drawing's file can't be removed", async () => {
    run.end({ kind: "cancelled" });
    await expect.poll(async () => (await job()).state).toBe("cancelled");
    const file = join(app.dir, "drawings", app.drawingsOnDisk()[0]);
    // A folder in the file's place can't be removed as a file, by any user.
    rmSync(file);
    mkdirSync(file);
    expect((await remove()).status).toBe(200);
    expect([app.store.jobs(), app.queue.list()]).toEqual([[], []]);
    expect(app.logged).toContainEqual(expect.stringContaining("could not be removed"));
    expect((await remove()).status).toBe(404);
  });

  it("a paired device is still known, and an operator's turn may end", () => {
    const kept = new Map<string, unknown>();
    const store = { setting: (key: string) => kept.get(key), saveSetting: kept.set.bind(kept) };
    let at = Date.parse("2026-01-01T00:00:00Z");
    const access = new Access(store, { now: () => new Date(at) });
    const { secret } = access.createKey("script", "operate");
    at += 3_600_000;
    store.saveSetting = () => {
      throw new Error("disk I/O error");
    };
    expect(access.roleOf(secret)).toBe("operate");
  });
});

describe("a queue that continues automatically", () => {
  it("survives a disk that fills up between the end of a plot and the next start", async () => {
    const { queue, store, plotter, logged, add, close } = openQueueIn(folderOfTest());
    const [first] = [await add("fern"), await add("moss")];
    queue.saveSettings({ runOn: true });
    await queue.start(first.id);
    const plot = await plotter.nextRun();
    const saveExpected = store.saveExpected.bind(store);
    vi.spyOn(store, "saveExpected").mockImplementation((...changed) => {
      fillDisk(store);
      return saveExpected(...changed);
    });
    plot.end({ kind: "done" });
    await expect.poll(() => logged).toEqual(["the next job can't be started: database or disk is full"]);
    expect(queue.list().map(({ name, state }) => `${name} ${state}`)).toEqual(["moss queued", "fern done"]);
    await close();
  });
});

describe("an error", () => {
  it("is recognised as the disk's by the messages of systems and SQLite", () => {
    for (const code of ["ENOSPC", "EDQUOT", "EROFS"]) {
      expect(isDiskFault(Object.assign(new Error("x"), { code }))).toBe(true);
    }
    expect(isDiskFault(new Error("disk I/O error"))).toBe(true);
    expect(isDiskFault(new Error("constraint failed"))).toBe(false);
    expect(isDiskFault(undefined)).toBe(false);
  });
});
