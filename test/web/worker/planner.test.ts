import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import {
  Planner,
  type PlannerDrawing,
  type PlannerTask,
  type WorkerLike,
} from "../../../web/worker/planner.js";
import type {
  PlanFault,
  Planned,
  WorkerPlanRequest,
  WorkerReply,
  WorkerRequest,
} from "../../../web/worker/protocol.js";

const settings = DEFAULT_PLOT_SETTINGS;
const taskOf = (drawing: PlannerDrawing, firmware: string | null = null): PlannerTask => ({
  ...{ drawing, settings, firmware },
});
const BOX = { x0: 0, y0: 0, x1: 9, y1: 9 };
const HERE = { a: 1, b: 0, c: 0, d: 1, e: 0, f: 0 };
const planned = (drawingKey: string): Planned => ({ drawingKey }) as Planned;

class WorkerByHand implements WorkerLike {
  readonly asked: WorkerPlanRequest[] = [];
  readonly exports: string[] = [];
  readonly strokesAsked: number[] = [];
  readonly measured: [key: string, text: unknown][] = [];
  isEnded = false;
  onmessage: ((event: MessageEvent<WorkerReply>) => void) | null = null;
  onerror: ((event: ErrorEvent) => void) | null = null;

  postMessage(message: WorkerRequest): void {
    if (message.type === "plan") this.asked.push(message);
    else if (message.type === "export") this.exports.push(message.format);
    else if (message.type === "measure") this.measured.push([message.file.key, message.file.text]);
    else this.strokesAsked.push(message.id);
  }
  terminate(): void {
    this.isEnded = true;
  }
  reply(reply: WorkerReply): void {
    this.onmessage?.({ data: reply } as MessageEvent<WorkerReply>);
  }
}

const setUp = () => {
  const workers: WorkerByHand[] = [];
  const timers: { callback: () => void; isOn: boolean }[] = [];
  const calls: string[] = [];
  const planner = new Planner(
    () => {
      const worker = new WorkerByHand();
      workers.push(worker);
      return worker;
    },
    {
      after(_delayMs, callback) {
        const timer = { callback, isOn: true };
        timers.push(timer);
        return () => {
          timer.isOn = false;
        };
      },
    },
    {
      onImported: () => undefined,
      onPlanned: (result) => calls.push(result.drawingKey),
      onExported: (format, text) => calls.push(`${format} ${text}`),
      onExportFailed: (message) => calls.push(`not saved: ${message}`),
      onFault: (fault: PlanFault) => calls.push(`fault ${fault.message}`),
    },
  );
  const lastOf = <T>(list: readonly T[]): T => list[list.length - 1];
  return {
    planner,
    workers,
    calls,
    timers,
    worker: () => lastOf(workers),
    asked: () => lastOf(lastOf(workers).asked),
    runTimers: () => timers.filter(({ isOn }) => isOn).forEach(({ callback }) => callback()),
  };
};

describe("the planner", () => {
  it("sends a drawing's text once", () => {
    const { planner, worker } = setUp();
    planner.request(taskOf({ key: "a", text: "<svg/>" }));
    planner.request(taskOf({ key: "a", text: "<svg/>" }));
    planner.request(taskOf({ key: "b", text: "<svg></svg>" }));
    expect(worker().asked.map(({ files }) => files[0].text)).toEqual(["<svg/>", null, "<svg></svg>"]);
  });

  it("sends each text of a sheet once, also if it was measured before", async () => {
    const { planner, worker } = setUp();
    const extent = { widthMm: 9, heightMm: 9, content: BOX, onPage: BOX };
    const fileOf = (key: string) => ({ key, name: key, layerPrefix: "", text: `<${key}>`, extent });
    const pieceOf = (fileKey: string) => ({ id: fileKey, fileKey, map: HERE, isCropped: false });
    const sheet = { files: [fileOf("a"), fileOf("b")], pieces: [pieceOf("b"), pieceOf("a"), pieceOf("b")] };
    planner.request(taskOf({ key: "a", text: "<a>" }));
    worker().reply({ type: "planned", id: 1, planned: planned("a") });
    const measuring = planner.measure(fileOf("b"));
    expect(worker().measured).toEqual([["b", "<b>"]]);
    worker().reply({ type: "measured", key: "b", measured: extent });
    expect(await measuring).toEqual(extent);
    planner.request(taskOf({ key: "a", text: "", sheet }));
    const [, { files, sheet: onPaper }] = worker().asked;
    expect(files).toEqual([
      { key: "a", text: null },
      { key: "b", text: null },
    ]);
    expect(onPaper?.items.map(({ source }) => source)).toEqual([1, 0, 1]);
    // Another drawing: the worker forgets the sheet's.
    planner.request(taskOf({ key: "c", text: "<c>" }));
    planner.request(taskOf({ key: "a", text: "", sheet }));
    expect(
      worker()
        .asked.at(-1)
        ?.files.map(({ text }) => text),
    ).toEqual(["<a>", "<b>"]);
  });

  it("measures a file again in the worker that replaces one which did not begin", async () => {
    const { planner, worker, timers, workers } = setUp();
    planner.request(taskOf({ key: "slow", text: "slow" }));
    const measuring = planner.measure({ key: "b", text: "<b>" });
    planner.request(taskOf({ key: "small", text: "small" }));
    // The last timer is that of the planner's patience.
    timers.at(-1)?.callback();
    expect(workers).toHaveLength(2);
    expect(worker().measured).toEqual([["b", "<b>"]]);
    worker().reply({ type: "measured", key: "b", measured: { fault: "torn" } });
    expect(await measuring).toEqual({ fault: "torn" });
  });

  it("gives up measuring when the worker dies, and says why", async () => {
    const { planner, worker } = setUp();
    const measuring = planner.measure({ key: "huge", text: "huge" });
    worker().onerror?.({ message: "out of memory" } as ErrorEvent);
    expect(await measuring).toEqual({ fault: "out of memory" });
  });

  it("includes the board's firmware in a request", () => {
    const { planner, worker } = setUp();
    planner.request(taskOf({ key: "a", text: "a" }, "2.4.4"));
    planner.request(taskOf({ key: "a", text: "a" }));
    expect(worker().asked.map(({ firmware }) => firmware)).toEqual(["2.4.4", null]);
  });

  it("passes on only the newest plan", () => {
    const { planner, worker, calls } = setUp();
    planner.request(taskOf({ key: "a", text: "" }));
    planner.request(taskOf({ key: "b", text: "" }));
    const [first, second] = worker().asked;
    worker().reply({ type: "planned", id: first.id, planned: planned("a") });
    worker().reply({ type: "planned", id: second.id, planned: planned("b") });
    expect(calls).toEqual(["b"]);
  });

  it("ends a worker that is busy with an outdated request, and asks a new one", () => {
    const { planner, workers, runTimers, asked, worker, calls } = setUp();
    planner.request(taskOf({ key: "huge", text: "huge" }));
    planner.request(taskOf({ key: "small", text: "small" }));
    runTimers();
    expect(workers).toHaveLength(2);
    expect(workers[0].isEnded).toBe(true);
    expect(asked()).toMatchObject({ drawingKey: "small", files: [{ key: "small", text: "small" }] });
    worker().reply({ type: "planned", id: asked().id, planned: planned("small") });
    expect(calls).toEqual(["small"]);
  });

  it("lets a worker that has started on the newest request finish", () => {
    const { planner, workers, runTimers, asked, worker } = setUp();
    planner.request(taskOf({ key: "a", text: "a" }));
    planner.request(taskOf({ key: "b", text: "b" }));
    worker().reply({ type: "started", id: asked().id });
    runTimers();
    expect(workers).toHaveLength(1);
  });

  it("asks for the strokes of the plan that came last, and not while another one is made", () => {
    const { planner, worker, asked } = setUp();
    const strokes = {
      xy: new Float64Array(2),
      offsets: new Uint32Array(2),
      layer: new Uint16Array(1),
      layers: [],
    };
    const taken: unknown[] = [];
    planner.request(taskOf({ key: "a", text: "a" }));
    planner.strokes((given) => taken.push(given));
    expect(worker().strokesAsked).toEqual([]);
    const { id } = asked();
    worker().reply({ type: "planned", id, planned: { drawingKey: "a" } as Planned });
    planner.strokes((given) => taken.push(given));
    expect(worker().strokesAsked).toEqual([id]);
    worker().reply({ type: "strokes", id: id - 1, strokes });
    expect(taken).toEqual([]);
    worker().reply({ type: "strokes", id, strokes });
    expect(taken).toEqual([strokes]);
  });

  it("asks for the prepared drawing as text, and passes it on", () => {
    const { planner, worker, calls } = setUp();
    planner.request(taskOf({ key: "a", text: "a" }));
    planner.export("svg", "3.0.3");
    expect(worker().exports).toEqual(["svg"]);
    worker().reply({ type: "exported", format: "svg", text: "<svg/>" });
    expect(calls).toEqual(["svg <svg/>"]);
  });

  it("ends a worker that reads a file for too long, and reports it; not one that has read it", () => {
    const { planner, workers, timers, calls } = setUp();
    planner.request(taskOf({ key: "a", text: "<svg/>" }));
    workers[0].reply({ type: "started", id: 1 });
    workers[0].reply({ type: "imported", id: 1, drawingKey: "a" });
    expect(timers.map(({ isOn }) => isOn)).toEqual([false]);
    workers[0].reply({ type: "planned", id: 1, planned: planned("a") });
    planner.request(taskOf({ key: "b", text: "<svg/>" }));
    workers[0].reply({ type: "started", id: 2 });
    timers[1].callback();
    expect(workers[0].isEnded).toBe(true);
    expect(calls).toEqual(["a", expect.stringContaining("fault This file takes too long to read")]);
    planner.request(taskOf({ key: "c", text: "<svg/>" }));
    expect(workers[1].asked.map(({ drawingKey }) => drawingKey)).toEqual(["c"]);
  });

  it("reports that the worker died, and starts another for the next request", () => {
    const { planner, workers, worker, calls } = setUp();
    planner.request(taskOf({ key: "a", text: "a" }));
    worker().onerror?.({ message: "out of memory" } as ErrorEvent);
    expect(calls).toEqual(["fault out of memory"]);
    planner.request(taskOf({ key: "a", text: "a" }));
    expect(workers).toHaveLength(2);
    expect(worker().asked[0].files[0].text).toBe("a");
  });
});
