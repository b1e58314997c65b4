/**
 * The page's end of the strokes: drawn by a worker wherever a worker can draw, on the page's thread elsewhere.
 *
 * The worker sends pictures, not a canvas of its own: a picture and the place that it belongs to are put on the page
 * in one step, so that strokes and paper never come apart while the view is moved.
 */
import type { DrawReply, DrawRequest } from "../worker/draw-protocol.js";
import type { Painter } from "../scene/painter.js";
import type { Frame, Picture } from "../scene/renderer.js";
import { PIECE_BYTES, type Pieces } from "../scene/pieces.js";

export interface Strokes {
  /** `copy` is given away, if it has not been yet. Drawn with the next frame. */
  setScene(scene: Picture | null, copy: Picture | null): void;
  /** Only the newest is drawn. */
  show(frame: Frame): void;
  close(): void;
}

/** A picture of `frame` is on the canvas. `isDone`: all of it, and nothing newer has been asked for. */
export type OnShown = (frame: Frame, isDone: boolean) => void;

/** What this needs of a Worker; tests give their own. */
export interface DrawWorkerLike {
  postMessage(message: DrawRequest, transfer: Transferable[]): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<DrawReply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

export const openStrokes = (canvas: HTMLCanvasElement, onShown: OnShown): Strokes => {
  const onPage = (): Strokes => new StrokesOnPage(canvas, onShown);
  if (typeof OffscreenCanvas === "undefined" || typeof ImageBitmapRenderingContext === "undefined") {
    return onPage();
  }
  const worker = new Worker(new URL("../worker/draw.worker.ts", import.meta.url), { type: "module" });
  const put = (bitmap: ImageBitmap): void =>
    canvas.getContext("bitmaprenderer")?.transferFromImageBitmap(bitmap);
  return new StrokesAway(worker, put, onShown, onPage);
};

export class StrokesAway implements Strokes {
  readonly #worker: DrawWorkerLike;
  readonly #onPage: () => Strokes;
  /** Asked for, and neither shown nor passed over yet. */
  readonly #frames = new Map<number, Frame>();
  #newestId = 0;
  #scene: Picture | null = null;
  #hasShown = false;
  /** Draws where the worker turned out not to. */
  #instead: Strokes | null = null;

  /** `put` shows a picture; `onPage` is called when the worker can't be started, with the canvas still untouched. */
  constructor(
    worker: DrawWorkerLike,
    put: (bitmap: ImageBitmap) => void,
    onShown: OnShown,
    onPage: () => Strokes,
  ) {
    this.#worker = worker;
    this.#onPage = onPage;
    worker.onmessage = ({ data: { id, isWhole, bitmap } }) => {
      const frame = this.#frames.get(id);
      for (const asked of this.#frames.keys()) if (asked < id) this.#frames.delete(asked);
      if (!frame) return bitmap.close();
      this.#hasShown = true;
      put(bitmap);
      onShown(frame, isWhole && id === this.#newestId);
    };
    worker.onerror = () => {
      if (!this.#hasShown && !this.#instead) this.#giveUp();
    };
  }

  setScene(scene: Picture | null, copy: Picture | null): void {
    this.#scene = scene;
    if (this.#instead) return this.#instead.setScene(scene, copy);
    if (!scene) return this.#worker.postMessage({ type: "scene", scene: null }, []);
    // Given away before, to a stage that is no more: then the page's own is copied.
    const isOurs = copy !== null && isThere(copy.draw) && isThere(copy.travel);
    const { draw, travel } = isOurs ? copy : scene;
    const { totalS, asked } = scene;
    const message: DrawRequest = { type: "scene", scene: { draw, travel, totalS, asked } };
    this.#worker.postMessage(message, isOurs ? [draw.bytes, travel.bytes] : []);
  }

  show(frame: Frame): void {
    this.#frames.set(++this.#newestId, frame);
    if (this.#instead) this.#instead.show(frame);
    else this.#worker.postMessage({ type: "show", id: this.#newestId, frame }, []);
  }

  close(): void {
    this.#worker.terminate();
    this.#instead?.close();
  }

  #giveUp(): void {
    this.#worker.terminate();
    this.#instead = this.#onPage();
    this.#instead.setScene(this.#scene, null);
    const newest = this.#frames.get(this.#newestId);
    if (newest) this.#instead.show(newest);
  }
}

const isThere = ({ count, bytes }: Pieces): boolean => bytes.byteLength === count * PIECE_BYTES;

/** Fetches what draws when it is needed, which is hardly anywhere. */
class StrokesOnPage implements Strokes {
  #painter: Painter | null = null;
  #scene: Picture | null = null;
  #newest: Frame | null = null;
  #isClosed = false;

  constructor(canvas: HTMLCanvasElement, onShown: OnShown) {
    void import("../scene/strokes-canvas.js").then(({ paintOn }) => {
      if (this.#isClosed) return;
      this.#painter = paintOn(canvas, (frame, isWhole) => onShown(frame, isWhole && frame === this.#newest));
      this.#painter.setScene(this.#scene);
      if (this.#newest) this.#painter.show(this.#newest);
    });
  }

  setScene(scene: Picture | null): void {
    this.#scene = scene;
    this.#painter?.setScene(scene);
  }

  show(frame: Frame): void {
    this.#newest = frame;
    this.#painter?.show(frame);
  }

  close(): void {
    this.#isClosed = true;
    this.#painter?.close();
  }
}
