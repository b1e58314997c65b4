import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { prepareDataDir } from "../../../server/storage/data-dir.js";
import type { Planning } from "../../../host/planning/planning.js";
import { createPlanning } from "../../../server/planning/planner.js";
import { DrawingFiles } from "../../../server/storage/drawing-files.js";
import { JobQueue } from "../../../host/queue/job-queue.js";
import { Store } from "../../../server/storage/store.js";
import { DEFAULT_PLOT_SETTINGS, type Job, type JobPatch } from "../../../src/schema/index.js";
import { LedPlotter } from "../../support/jobs/led-plotter.js";
import { folderOfTest } from "../../support/processes/folders.js";

/** Travel across the page on which 1 000 mm/s² saves time. */
const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200">
  <path fill="none" stroke="black" d="M20 20h30 M150 150h30 M20 170h30 M150 30h30"/></svg>`;

let dir: string;
let store: Store;
let files: DrawingFiles;
let planning: Planning;
let queue: JobQueue;
const recent = new LedPlotter("recent");
const old = new LedPlotter("old");
old.firmware = "2.4.4";
const unknown = new LedPlotter("unknown");
unknown.firmware = null;

beforeEach(() => {
  dir = folderOfTest();
  prepareDataDir(dir);
  store = Store.open(dir);
  files = new DrawingFiles(dir, 1_000_000);
  planning = createPlanning(files);
  queue = new JobQueue({
    ...{ store, files, announce: () => undefined, nowIso: () => new Date().toISOString() },
    planning,
    plotters: new Map([recent, old, unknown].map((plotter) => [plotter.id, plotter])),
  });
});
afterEach(async () => {
  await queue.close();
  store.close();
});

async function add(plotterId: string): Promise<Job> {
  const drawing = await files.add([Buffer.from(SVG)]);
  return queue.add({ name: plotterId, settings: DEFAULT_PLOT_SETTINGS, drawing, plotterId });
}
const durationS = (job: Job): number => job.stats?.durationS ?? NaN;

describe("the estimated time of a job", () => {
  it("is that of its plotter's board: one before 2.5.3 accelerates more gently", async () => {
    const [forRecent, forOld, forUnknown] = [await add("recent"), await add("old"), await add("unknown")];
    expect(durationS(forOld)).toBeGreaterThan(1.01 * durationS(forRecent));
    expect(forOld.expectedS).toBe(durationS(forOld));
    expect(durationS(forUnknown)).toBe(durationS(forRecent));
  });

  it("is computed again when the job is moved to a board that moves differently", async () => {
    const [forRecent, forOld] = [await add("recent"), await add("old")];
    const moved = await queue.patch(forRecent.id, { plotterId: "old" });
    expect(durationS(moved)).toBe(durationS(forOld));
    expect(moved).toMatchObject({ plotterId: "old", settings: forRecent.settings });
    expect(moved.expectedS).toBe(durationS(forOld));
    expect(moved.remainingS).toBe(durationS(forOld));
    expect(durationS(await queue.patch(forRecent.id, { plotterId: "unknown" }))).toBe(durationS(forRecent));
  });
});

describe("a change that is measured longer than a newer one", () => {
  const withMargin = (marginMm: number): JobPatch => ({ settings: { prepare: { marginMm } } });
  const others: readonly [string, JobPatch, JobPatch][] = [
    ["settings after settings", withMargin(20), withMargin(12)],
    ["plotter after settings", { plotterId: "old" }, withMargin(12)],
    ["settings after plotter", withMargin(20), { plotterId: "old" }],
    ["settings after a plotter that moves alike", withMargin(20), { plotterId: "unknown" }],
  ];
  it.each(others)("is refused: %s", async (_name, older, newer) => {
    const { id, name } = await add("recent");
    const measure = planning.measure.bind(planning);
    let finish = (): void => undefined;
    const held = new Promise<void>((resolve) => (finish = resolve));
    vi.spyOn(planning, "measure").mockImplementationOnce(async (...wanted) => {
      await held;
      return measure(...wanted);
    });
    const refused = expect(queue.patch(id, older)).rejects.toMatchObject({
      code: "conflict",
      message: `"${name}" was changed meanwhile, so this change was not made. Check the job, then try again.`,
    });
    const changed = await queue.patch(id, newer);
    finish();
    await refused;
    expect(queue.get(id)).toEqual(changed);
  });

  it("is made if only the name changed", async () => {
    const { id } = await add("recent");
    const change = queue.patch(id, withMargin(12));
    await queue.patch(id, { name: "fern" });
    await change;
    expect(queue.get(id)).toMatchObject({ name: "fern", settings: { prepare: { marginMm: 12 } } });
  });
});
