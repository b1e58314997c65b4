/**
 * Draws the strokes in a worker, or on the page's thread if workers can't draw.
 *
 * The worker sends pictures instead of drawing on the page's canvas. So the page can update picture and position in one
 * step, and strokes and paper stay together while the view moves.
 */
import type { DrawReply, DrawRequest } from "../worker/draw-protocol.js";
import type { Painter } from "../scene/painter.js";
import type { Frame, Picture } from "../scene/renderer.js";
import { PIECE_BYTES, type Pieces } from "../scene/pieces.js";

export interface Strokes {
  /** The scene is drawn with the next frame. `copy` is transferred, unless it was before. */
  setScene(scene: Picture | null, copy: Picture | null): void;
  /** Only the newest is drawn. */
  show(frame: Frame): void;
  close(): void;
}

/** A picture of `frame` is on the canvas. `isDone`: it is whole, and no newer frame was requested. */
type OnShown = (frame: Frame, isDone: boolean) => void;

/** The used part of a Worker. Tests pass their own. */
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
  return new StrokesInWorker(worker, put, onShown, onPage);
};

export class StrokesInWorker implements Strokes {
  readonly #worker: DrawWorkerLike;
  readonly #onPage: () => Strokes;
  /** Requested frames that are neither shown nor skipped yet. */
  readonly #frames = new Map<number, Frame>();
  #newestId = 0;
  #scene: Picture | null = null;
  #hasShown = false;
  /** Draws on the page, after the worker has failed. */
  #instead: Strokes | null = null;

  /** `put` shows a picture. `onPage` is called if the worker fails before it has used the canvas. */
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
      for (const earlier of this.#frames.keys()) if (earlier < id) this.#frames.delete(earlier);
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
    // If the copy was transferred before, to an earlier stage, the page's own pieces are copied.
    const canTransfer = copy !== null && isThere(copy.draw) && isThere(copy.travel);
    const { draw, travel } = canTransfer ? copy : scene;
    const { totalS, asked } = scene;
    const message: DrawRequest = { type: "scene", scene: { draw, travel, totalS, asked } };
    this.#worker.postMessage(message, canTransfer ? [draw.bytes, travel.bytes] : []);
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

/** Draws on the page's thread. Loads the code only here, because few browsers need it. */
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
