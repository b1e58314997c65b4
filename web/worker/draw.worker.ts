/** Draws the strokes outside the page's thread: a slow graphics card, or none, must not block the page. */
import { paintOn } from "../scene/strokes-canvas.js";
import type { Frame } from "../scene/renderer.js";
import type { DrawReply, DrawRequest } from "./draw-protocol.js";

interface WorkerScope {
  onmessage: ((event: MessageEvent<DrawRequest>) => void) | null;
  postMessage(reply: DrawReply, transfer: Transferable[]): void;
}
const scope = self as unknown as WorkerScope;

const canvas = new OffscreenCanvas(1, 1);
const ids = new WeakMap<Frame, number>();
const painter = paintOn(canvas, (frame, isWhole) => {
  const bitmap = canvas.transferToImageBitmap();
  scope.postMessage({ id: ids.get(frame) ?? 0, isWhole, bitmap }, [bitmap]);
});

scope.onmessage = ({ data }) => {
  if (data.type === "scene") return painter.setScene(data.scene);
  ids.set(data.frame, data.id);
  painter.show(data.frame);
};
