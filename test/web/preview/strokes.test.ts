import { describe, expect, it } from "vitest";
import type { Frame, Picture } from "../../../web/scene/renderer.js";
import { PIECE_BYTES } from "../../../web/scene/pieces.js";
import type { Scene } from "../../../web/scene/scene.js";
import { Strokes, type DrawWorkerLike } from "../../../web/preview/strokes.js";
import type { DrawReply, DrawRequest } from "../../../web/worker/protocol.js";
import { makeFrame } from "../../support/jobs/jobs-on-page.js";

class WorkerByHand implements DrawWorkerLike {
  readonly asked: DrawRequest[] = [];
  isEnded = false;
  onmessage: ((event: MessageEvent<DrawReply>) => void) | null = null;
  onerror: ((event: ErrorEvent) => void) | null = null;

  /** Moves transferred objects, as a browser does. */
  postMessage(message: DrawRequest, transfer: Transferable[]): void {
    this.asked.push(structuredClone(message, { transfer: transfer as ArrayBuffer[] }));
  }
  terminate(): void {
    this.isEnded = true;
  }
  reply(id: number, isWhole: boolean): Bitmap {
    const bitmap = new Bitmap();
    const data: DrawReply = { id, isWhole, bitmap };
    this.onmessage?.({ data } as MessageEvent<DrawReply>);
    return bitmap;
  }
}

class Bitmap implements ImageBitmap {
  readonly width = 1;
  readonly height = 1;
  isClosed = false;
  close(): void {
    this.isClosed = true;
  }
}

const picture = (): Picture => ({
  draw: { count: 2, bytes: new ArrayBuffer(2 * PIECE_BYTES) },
  travel: { count: 0, bytes: new ArrayBuffer(0) },
  totalS: 3,
});
const scene = (): Scene => ({ ...picture(), topDrawMmPerS: 1, grid: {} }) as Scene;

const setUp = () => {
  const worker = new WorkerByHand();
  const put: ImageBitmap[] = [];
  const shown: [Frame, boolean][] = [];
  const faults: string[] = [];
  const strokes = new Strokes(worker, {
    put: (bitmap) => put.push(bitmap),
    onShown: (of, isDone) => shown.push([of, isDone]),
    onFault: () => faults.push("fault"),
  });
  return { worker, put, shown, faults, strokes };
};

describe("strokes drawn by a worker", () => {
  it("get the copy of the scene, not the page's own", () => {
    const { worker, strokes } = setUp();
    const own = scene();
    const copy = picture();
    strokes.setScene(own, copy);
    expect(worker.asked).toEqual([{ type: "scene", scene: picture() }]);
    expect(copy.draw.bytes.byteLength).toBe(0);
    expect(own.draw.bytes.byteLength).toBe(2 * PIECE_BYTES);
  });

  it("copy the page's own if the copy was transferred before", () => {
    const copy = picture();
    setUp().strokes.setScene(scene(), copy);
    const { worker, strokes } = setUp();
    const own = scene();
    strokes.setScene(own, copy);
    expect(worker.asked).toEqual([{ type: "scene", scene: picture() }]);
    expect(own.draw.bytes.byteLength).toBe(2 * PIECE_BYTES);
  });

  it("are shown with the frame that they were drawn for, and are done when that is the newest and complete", () => {
    const { worker, put, shown, strokes } = setUp();
    const frames = [makeFrame(1), makeFrame(2), makeFrame(3)];
    for (const one of frames) strokes.show(one);
    worker.reply(2, true);
    worker.reply(3, false);
    const last = worker.reply(3, true);
    expect(shown).toEqual([
      [frames[1], false],
      [frames[2], false],
      [frames[2], true],
    ]);
    expect(put).toHaveLength(3);
    expect(put[2]).toBe(last);
  });

  it("never return to an older frame", () => {
    const { worker, put, strokes } = setUp();
    strokes.show(makeFrame(1));
    strokes.show(makeFrame(2));
    worker.reply(2, true);
    const late = worker.reply(1, true);
    expect(put).toHaveLength(1);
    expect(late.isClosed).toBe(true);
  });

  it("are reported as missing if the worker fails", () => {
    const { worker, faults, strokes } = setUp();
    strokes.show(makeFrame(1));
    expect(faults).toEqual([]);
    worker.onerror?.({} as ErrorEvent);
    expect(faults).toEqual(["fault"]);
  });
});
