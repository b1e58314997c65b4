/**
 * Draws the strokes in a worker. The worker sends pictures instead of drawing on the page's canvas. So the page can
 * update picture and position in one step, and strokes and paper stay together while the view moves.
 */
import type { DrawReply, DrawRequest } from "../worker/protocol.js";
import type { Frame, Picture } from "../scene/renderer.js";
import { PIECE_BYTES, type Pieces } from "../scene/pieces.js";

/** The used part of a Worker. Tests pass their own. */
export interface DrawWorkerLike {
  postMessage(message: DrawRequest, transfer: Transferable[]): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<DrawReply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

interface StrokesListener {
  /** Puts a picture on the canvas. */
  put(bitmap: ImageBitmap): void;
  /** A picture of `frame` is on the canvas. `isDone`: it is whole, and no newer frame was requested. */
  onShown(frame: Frame, isDone: boolean): void;
  /** The worker can't draw. */
  onFault(): void;
}

export class Strokes {
  /** Requested frames that are neither shown nor skipped yet. */
  private readonly frames = new Map<number, Frame>();
  private newestId = 0;

  constructor(
    private readonly worker: DrawWorkerLike,
    listener: StrokesListener,
  ) {
    worker.onmessage = ({ data: { id, isWhole, bitmap } }) => {
      const frame = this.frames.get(id);
      for (const earlier of this.frames.keys()) if (earlier < id) this.frames.delete(earlier);
      if (!frame) return bitmap.close();
      listener.put(bitmap);
      listener.onShown(frame, isWhole && id === this.newestId);
    };
    worker.onerror = () => listener.onFault();
  }

  /** The scene is drawn with the next frame. `copy` is transferred, unless it was before. */
  setScene(scene: Picture | null, copy: Picture | null): void {
    if (!scene) return this.worker.postMessage({ type: "scene", scene: null }, []);
    // If the copy was transferred before, to an earlier stage, the page's own pieces are copied.
    const canTransfer = copy !== null && isThere(copy.draw) && isThere(copy.travel);
    const { draw, travel } = canTransfer ? copy : scene;
    const { totalS, asked } = scene;
    const message: DrawRequest = { type: "scene", scene: { draw, travel, totalS, asked } };
    this.worker.postMessage(message, canTransfer ? [draw.bytes, travel.bytes] : []);
  }

  /** Only the newest is drawn. */
  show(frame: Frame): void {
    this.frames.set(++this.newestId, frame);
    this.worker.postMessage({ type: "show", id: this.newestId, frame }, []);
  }

  close(): void {
    this.worker.terminate();
  }
}

const isThere = ({ count, bytes }: Pieces): boolean => bytes.byteLength === count * PIECE_BYTES;
