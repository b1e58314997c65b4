import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import {
  keepDrawing,
  readKeptDrawing,
  type DrawingStorage,
  type KeptDrawing,
} from "../../../web/drawing/kept-drawing.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore } from "../../../web/state/store.js";
import type { Planned } from "../../../web/worker/protocol.js";

const SHEET = { name: "waves", text: "<svg/>", jobId: null, sourceId: null };

function makePage() {
  const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
  const written: KeptDrawing[] = [];
  const storage: DrawingStorage = {
    read: () => Promise.resolve(written.at(-1)),
    write: (drawing) => {
      written.push(drawing);
      return Promise.resolve();
    },
  };
  const faults: string[] = [];
  keepDrawing(store, storage, () => faults.push("not stored"));
  const plan = (drawingKey: string): void =>
    store.setState({ planned: { drawingKey } satisfies Partial<Planned> as unknown as Planned });
  return { store, storage, written, plan, faults };
}

describe("the last drawing", () => {
  it("is stored once it is planned, and again when it has become a job", async () => {
    const { store, storage, written, plan } = makePage();
    store.setState({ drawing: { key: "drawing-1", sheet: null, ...SHEET } });
    expect(written).toEqual([]);
    plan("drawing-1");
    expect(written).toEqual([SHEET]);
    store.setState({ isPlanning: true });
    plan("drawing-1");
    expect(written).toHaveLength(1);
    store.setState({ drawing: { key: "drawing-1", sheet: null, ...SHEET, jobId: "job-7" } });
    expect(await readKeptDrawing(storage)).toEqual({ ...SHEET, jobId: "job-7" });
  });

  it("a drawing which can't be stored is reported, once", async () => {
    const { store, storage, plan, faults } = makePage();
    storage.write = () => Promise.reject(new Error("full"));
    for (const key of ["drawing-1", "drawing-2"]) {
      store.setState({ drawing: { key, sheet: null, ...SHEET } });
      plan(key);
    }
    await expect.poll(() => faults).toEqual(["not stored"]);
  });

  it("stays if another one can't be read", () => {
    const { store, written, plan } = makePage();
    store.setState({ drawing: { key: "drawing-1", sheet: null, ...SHEET } });
    plan("drawing-1");
    store.setState({ drawing: { key: "drawing-2", sheet: null, ...SHEET, name: "torn" }, planned: null });
    store.setState({ fault: { message: "torn", stage: "import" } });
    expect(written.map(({ name }) => name)).toEqual(["waves"]);
  });

  it.each([
    ["nothing", () => Promise.resolve(undefined)],
    ["what is no drawing", () => Promise.resolve({ name: "waves", text: 7 })],
    ["a refusal", () => Promise.reject(new Error("a private window"))],
  ])("is absent if the browser gives %s", async (_what, read) => {
    expect(await readKeptDrawing({ read, write: () => Promise.resolve() })).toBeNull();
  });
});
