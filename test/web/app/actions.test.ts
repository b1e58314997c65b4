import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS, newJobSchema, type OperationClient } from "../../../src/schema/index.js";
import { createServerBackend } from "../../../web/backend/server/server-backend.js";
import { createActions, type Actions } from "../../../web/state/actions.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore } from "../../../web/state/store.js";
import type { Planned } from "../../../web/worker/protocol.js";
import { makeJob } from "../../support/jobs/jobs-on-page.js";

type Calls = { readonly [Group in keyof OperationClient]?: Partial<OperationClient[Group]> };

/** `more`: what the backend answers otherwise. */
function makePage(more: Calls = {}) {
  const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
  let isServerUp = false;
  const sent: (string | Blob)[] = [];
  const fromServer = createServerBackend((_path, init) => {
    if (typeof init?.body === "string" || init?.body instanceof Blob) sent.push(init.body);
    return isServerUp
      ? Promise.resolve(Response.json({ samples: [], id: "upload" }))
      : Promise.reject(new Error("refused"));
  });
  const { state, jobs, samples } = more;
  const backend = {
    ...fromServer,
    state: { ...fromServer.state, ...state },
    jobs: { ...fromServer.jobs, ...jobs },
    samples: { ...fromServer.samples, ...samples },
  };
  const planner = {
    request: () => undefined,
    export: () => undefined,
    strokes: () => undefined,
    sketches: () => undefined,
    measure: () => Promise.reject(new Error("not asked")),
  };
  const actions = createActions({ store, backend, planner, nowMs: () => 0, after: () => undefined });
  const errorCount = (): number => store.getState().notices.filter(({ kind }) => kind === "error").length;
  return { store, actions, errorCount, sent, startServer: () => (isServerUp = true) };
}

describe("the selected drawings of a sheet", () => {
  const box = { x0: 0, y0: 0, x1: 10, y1: 10 };
  const file = { key: "file", name: "leaf", text: "<svg/>", layerPrefix: "" };
  const extent = { widthMm: 10, heightMm: 10, content: box, onPage: box };
  const pieceAt = (id: string, e: number) => {
    return { id, fileKey: "file", map: { a: 1, b: 0, c: 0, d: 1, e, f: 20 }, isCropped: false };
  };
  const open = () => {
    const page = makePage();
    const sheet = { files: [{ ...file, extent }], pieces: [pieceAt("left", 20), pieceAt("right", 60)] };
    page.store.setState({
      drawing: { key: "sheet", name: "leaf", text: "", sheet, jobId: null, sourceId: null },
      selectedPieces: ["left"],
    });
    const selected = (): readonly string[] => page.store.getState().selectedPieces;
    return { ...page, selected };
  };

  it("are selected again after undo and redo of what made or removed others", async () => {
    const { actions, selected } = open();
    await actions.duplicatePieces();
    const [copy] = selected();
    expect(copy).not.toBe("left");
    actions.undo();
    expect(selected()).toEqual(["left"]);
    actions.redo();
    expect(selected()).toEqual(["left"]);
    actions.selectPieces([copy]);
    actions.undo();
    expect(selected()).toEqual(["left"]);
    actions.selectPieces(["right"]);
    await actions.removePieces();
    actions.undo();
    expect(selected()).toEqual(["right"]);
  });

  it("stay selected as far as they exist when another step is undone", async () => {
    const { actions, selected } = open();
    await actions.duplicatePieces();
    const [copy] = selected();
    actions.selectPieces(["right", copy]);
    actions.undo();
    expect(selected()).toEqual(["right"]);
    actions.changeSettings("paper", (settings) => settings);
    actions.selectPieces(["left", "right"]);
    actions.undo();
    expect(selected()).toEqual(["left", "right"]);
  });
});

describe("an error message", () => {
  it("stays until it is closed or an action succeeds", async () => {
    const { actions, errorCount, startServer } = makePage();
    await actions.loadSamples();
    await actions.loadSamples();
    expect(errorCount()).toBe(1);
    startServer();
    await actions.loadSamples();
    expect(errorCount()).toBe(0);
  });

  it("disappears with the next drawing", async () => {
    const { actions, errorCount } = makePage();
    await actions.loadSamples();
    expect(errorCount()).toBe(1);
    actions.openPasted("<svg width='9'/>");
    expect(errorCount()).toBe(0);
  });
});

describe("a file that is dropped", () => {
  const unreadable = { name: "sketches", arrayBuffer: () => Promise.reject(new Error("is a folder")) };

  it.each([
    ["is a folder, or gone", unreadable as unknown as File],
    ["holds no text", new File(["PK\x03\x04\0\0"], "photos.zip")],
    ["is a picture", new File(["\xff\xd8\xff"], "photo.jpg", { type: "image/jpeg" })],
  ])("a dropped file that %s is named, with advice; the drawing on the paper stays", async (_what, file) => {
    const { store, actions } = makePage();
    actions.openPasted("<svg width='9'/>");
    const { drawing } = store.getState();
    await actions.openFile(file);
    expect(store.getState().drawing).toBe(drawing);
    const [notice] = store.getState().notices;
    expect(notice?.kind).toBe("error");
    expect(notice?.text).toContain(file.name);
  });

  it.each([
    ["PNG", [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0, 0, 0, 13]],
    ["JPEG", [0xff, 0xd8, 0xff, 0xe0, 0, 0x10, 0x4a, 0x46, 0x49, 0x46]],
    ["GIF", [...Buffer.from("GIF89a"), 10, 0, 10, 0]],
    ["WebP", [...Buffer.from("RIFF"), 9, 0, 0, 0, ...Buffer.from("WEBPVP8 ")]],
    ["BMP", [...Buffer.from("BM"), 70, 0, 0, 0, 0, 0]],
    ["TIFF", [...Buffer.from("II*"), 0, 8, 0, 0, 0]],
    ["HEIC", [0, 0, 0, 24, ...Buffer.from("ftypheic"), 0, 0]],
  ])("is called a picture if it is one, also without a type and an ending: %s", async (_format, bytes) => {
    const { store, actions } = makePage();
    await actions.openFile(new File([Uint8Array.from(bytes)], "scan"));
    expect(store.getState().notices[0]?.text).toMatch(/^scan is a picture: .*Trace it first/);
  });

  it("is not called a picture if it is something else", async () => {
    const { store, actions } = makePage();
    await actions.openFile(new File(["PK\x03\x04\0\0"], "scan"));
    expect(store.getState().notices[0]?.text).toMatch(/^scan is not a text file/);
  });

  it("is put on the paper without its extension", async () => {
    const { store, actions } = makePage();
    await actions.openFile(new File(["<svg width='9'/>"], "waves.svg"));
    expect(store.getState().drawing?.name).toBe("waves");
  });

  it("is stored unchanged if it is large, and goes to the queue as a file", async () => {
    const { store, actions, sent, startServer } = makePage();
    startServer();
    const svg = `<svg width="9">\n<!-- ${"größer \t\u{1f58b}\u0001".repeat(200_000)} --></svg>`;
    await actions.openFile(new File([svg], "waves.svg"));
    const { drawing } = store.getState();
    expect(drawing?.text).toBeInstanceOf(ArrayBuffer);
    await actions.queueDrawing();
    const [upload, job] = sent as [Blob, string];
    // Not by toBe: it would print all of both.
    expect((await upload.text()) === svg).toBe(true);
    expect(newJobSchema.parse(JSON.parse(job))).toEqual({
      name: "waves",
      drawingId: "upload",
      settings: DEFAULT_PLOT_SETTINGS,
    });
  });
});

describe("the number of copies", () => {
  it("is sent with the drawing to the queue, and is 1 again with the next drawing", async () => {
    const { store, actions, sent, startServer } = makePage();
    startServer();
    actions.openDrawing("hills", "<svg width='9'/>");
    store.setState({ copies: 3 });
    await actions.queueDrawing();
    expect(newJobSchema.parse(JSON.parse(String(sent.at(-1)))).copies).toBe(3);
    actions.openDrawing("waves", "<svg width='8'/>");
    await actions.queueDrawing();
    expect(newJobSchema.parse(JSON.parse(String(sent.at(-1)))).copies).toBeUndefined();
  });

  it("does not count for Plot", async () => {
    const { store, actions, sent, startServer } = makePage();
    startServer();
    actions.openDrawing("hills", "<svg width='9'/>");
    store.setState({ copies: 3 });
    await actions.plotDrawing();
    expect(newJobSchema.parse(JSON.parse(String(sent.at(-1)))).copies).toBeUndefined();
  });
});

describe("a drawing of the last visit", () => {
  const ofJob = { name: "waves", text: "<svg width='9'/>", jobId: "a", sourceId: "a" };
  const jobSettings = { ...DEFAULT_PLOT_SETTINGS, penStops: "layers" as const };

  it("is restored with its last settings", () => {
    const { store, actions } = makePage();
    store.setState({ settings: jobSettings });
    void actions.restoreDrawing({ ...ofJob, jobId: null });
    actions.takeJobSettings();
    expect(store.getState()).toMatchObject({
      settings: jobSettings,
      drawing: { name: "waves", jobId: null },
    });
  });

  it("a drawing of the last visit that belongs to a job has the job's settings", () => {
    const { store, actions } = makePage();
    void actions.restoreDrawing(ofJob);
    store.setState({ jobs: [makeJob("a", { settings: jobSettings })] });
    actions.takeJobSettings();
    expect(store.getState()).toMatchObject({ settings: jobSettings, drawing: { jobId: "a" } });
  });

  it("is no longer a job's after that was removed", () => {
    const { store, actions } = makePage();
    void actions.restoreDrawing(ofJob);
    actions.takeJobSettings();
    expect(store.getState().drawing?.jobId).toBe(null);
  });
});

const hideLayer1 = (actions: Actions): void =>
  actions.changeSettings("layer1", (now) => ({
    ...now,
    prepare: { ...now.prepare, hiddenLayers: ["layer1"] },
  }));

describe("a drawing that is opened", () => {
  const fault = { message: "The file ends too soon.", stage: "import" as const };

  it("leaves the previous one on the paper, with its settings, if it can't be read", () => {
    const { store, actions } = makePage();
    actions.openDrawing("hills", "<svg width='9'/>");
    actions.noteRead(store.getState().drawing?.key ?? "");
    store.setState({ planned: {} as Planned });
    const { drawing, settings } = store.getState();
    actions.openDrawing("torn", "<svg");
    expect(actions.revertedAfterFault(fault)).toBe(true);
    expect(store.getState().drawing).toBe(drawing);
    expect(store.getState().settings).toBe(settings);
    expect(store.getState().notices.map(({ text }) => text)).toEqual([
      "torn can’t be drawn: The file ends too soon.",
    ]);
  });

  it("has no previous one to return to on an empty sheet, or after it was read", () => {
    const { store, actions } = makePage();
    actions.openDrawing("torn", "<svg");
    expect(actions.revertedAfterFault(fault)).toBe(false);
    actions.noteRead(store.getState().drawing?.key ?? "");
    expect(actions.revertedAfterFault(fault)).toBe(false);
  });

  it("asks again what happens outside the paper, and keeps its own place", () => {
    const { store, actions } = makePage();
    actions.openDrawing("hills", "<svg width='9'/>");
    actions.changeSettings("outside", (now) => ({
      ...now,
      prepare: { ...now.prepare, outside: "allow", fit: false },
    }));
    actions.openDrawing("hills", "<svg width='8'/>");
    expect(store.getState().settings.prepare).toMatchObject({ outside: "allow", fit: false });
    actions.openDrawing("waves", "<svg width='9'/>");
    expect(store.getState().settings.prepare).toMatchObject({ outside: "refuse", fit: false });
  });

  it("never gets the layers of the drawing before by Undo", () => {
    const { store, actions } = makePage();
    const openRead = (name: string): void => {
      actions.openDrawing(name, "<svg width='9'/>");
      actions.noteRead(store.getState().drawing?.key ?? "");
    };
    const prepare = () => store.getState().settings.prepare;
    openRead("hills");
    hideLayer1(actions);
    actions.changeSettings("margin", (now) => ({ ...now, prepare: { ...now.prepare, marginMm: 3 } }));
    openRead("waves");
    actions.undo();
    expect(prepare()).toMatchObject({ hiddenLayers: [], marginMm: 3 });
    actions.undo();
    expect(prepare()).toMatchObject({ hiddenLayers: [], marginMm: 3 });
  });

  it.each([
    [
      "pasted with another content does not keep the layer settings of the one before",
      "<svg width='8'/>",
      [],
    ],
    ["pasted again keeps its layer settings", "<svg width='9'/>", ["layer1"]],
  ])("%s", (_what, next, hiddenLayers) => {
    const { store, actions } = makePage();
    actions.openPasted("<svg width='9'/>");
    hideLayer1(actions);
    actions.openPasted(next);
    expect(store.getState().settings.prepare.hiddenLayers).toEqual(hiddenLayers);
  });

  it("a file with the name of the drawing before it keeps its layer settings, because it may have been edited", () => {
    const { store, actions } = makePage();
    actions.openDrawing("hills", "<svg width='9'/>");
    hideLayer1(actions);
    actions.openDrawing("hills", "<svg width='8'/>");
    expect(store.getState().settings.prepare.hiddenLayers).toEqual(["layer1"]);
  });

  it("can't be read: the steps of the previous one can still be undone", () => {
    const { store, actions } = makePage();
    actions.openDrawing("hills", "<svg width='9'/>");
    actions.noteRead(store.getState().drawing?.key ?? "");
    hideLayer1(actions);
    store.setState({ planned: {} as Planned });
    actions.openDrawing("torn", "<svg");
    actions.revertedAfterFault(fault);
    actions.undo();
    expect(store.getState().settings.prepare.hiddenLayers).toEqual([]);
  });
});

describe("a drawing that arrives late", () => {
  const SVG = "<svg width='9'/>";
  const makeSlowPage = () => {
    const arrivals = new Map<string, (svg: string) => void>();
    const arriving = (name: string): Promise<string> => new Promise((resolve) => arrivals.set(name, resolve));
    const page = makePage({ samples: { get: arriving }, jobs: { drawing: arriving } });
    const slowFile = {
      name: "late.svg",
      type: "",
      arrayBuffer: async () => new TextEncoder().encode(await arriving("late")).buffer,
    } as unknown as File;
    const asks: Readonly<Record<string, () => Promise<void>>> = {
      job: () => page.actions.openJob(makeJob("late")),
      sample: () => page.actions.openSample("late", "Late"),
      file: () => page.actions.openFile(slowFile),
    };
    return { ...page, asks, arrive: (name: string) => arrivals.get(name)?.(SVG) };
  };
  const newer: readonly (readonly [string, (page: ReturnType<typeof makeSlowPage>) => Promise<void>])[] = [
    [
      "job",
      ({ actions, arrive }) => {
        const opened = actions.openJob(makeJob("new", { name: "new" }));
        arrive("new");
        return opened;
      },
    ],
    [
      "sample",
      ({ actions, arrive }) => {
        const opened = actions.openSample("new", "new");
        arrive("new");
        return opened;
      },
    ],
    ["file", ({ actions }) => actions.openFile(new File([SVG], "new.svg"))],
    ["paste", ({ actions }) => Promise.resolve(actions.openPasted(SVG))],
  ];
  const pairs = ["job", "sample", "file"].flatMap((old) =>
    newer.map(([name, open]) => [old, name, open] as const),
  );

  it.each(pairs)("%s: does not replace a newer %s", async (old, _newer, open) => {
    const page = makeSlowPage();
    const late = page.asks[old]();
    await open(page);
    const { drawing } = page.store.getState();
    expect(drawing).not.toBeNull();
    page.actions.changeSettings("margin", (now) => ({ ...now, penStops: "layers" }));
    const { settings, undoStack } = page.store.getState();
    page.arrive("late");
    await late;
    expect(page.store.getState().drawing?.key).toBe(drawing?.key);
    expect(page.store.getState()).toMatchObject({ settings, undoStack });
  });

  it("is shown if nothing readable was pasted meanwhile", async () => {
    const page = makeSlowPage();
    const late = page.asks["job"]();
    page.actions.openPasted("a note");
    page.arrive("late");
    await late;
    expect(page.store.getState().drawing?.name).toBe("Job late");
  });
});
