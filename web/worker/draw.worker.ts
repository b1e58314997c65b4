/**
 * Draws the strokes outside the page's thread: a slow graphics card, or none, must not block the page. Handles the loss
 * of the graphics card.
 */
import { Painter } from "../scene/painter.js";
import type { Frame, SceneRenderer } from "../scene/renderer.js";
import type { DrawReply, DrawRequest } from "./protocol.js";

interface WorkerScope {
  onmessage: ((event: MessageEvent<DrawRequest>) => void) | null;
  postMessage(reply: DrawReply, transfer: Transferable[]): void;
}
const scope = self as unknown as WorkerScope;

/** Names of renderers that emulate a graphics card. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** Whether WebGL2 uses a graphics card. Tried on a spare canvas, because a canvas keeps its first kind of context. */
const hasCard = (): boolean => {
  const gl = new OffscreenCanvas(1, 1).getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  if (!gl) return false;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return !SOFTWARE.test(name);
};

/** Loads only the renderer that is used. */
const rendererOn = async (canvas: OffscreenCanvas): Promise<SceneRenderer> => {
  if (hasCard()) {
    const { createGlRenderer } = await import("../scene/gl-renderer.js");
    const renderer = createGlRenderer(canvas);
    if (renderer) return renderer;
  }
  const { createSoftRenderer } = await import("../scene/soft-renderer.js");
  return createSoftRenderer(canvas);
};

const clock = {
  nowMs: () => performance.now(),
  wait: (ms: number) => new Promise<void>((resolve) => setTimeout(resolve, ms)),
};
const canvas = new OffscreenCanvas(1, 1);
const ids = new WeakMap<Frame, number>();
const painter = new Painter(clock, (frame, isWhole) => {
  const bitmap = canvas.transferToImageBitmap();
  scope.postMessage({ id: ids.get(frame) ?? 0, isWhole, bitmap }, [bitmap]);
});

// Only a reported error reaches the page.
const start = (): void =>
  void rendererOn(canvas).then((renderer) => painter.setRenderer(renderer), reportError);
canvas.addEventListener("webglcontextlost", (event) => {
  event.preventDefault();
  painter.setRenderer(null);
});
canvas.addEventListener("webglcontextrestored", start);
start();

scope.onmessage = ({ data }) => {
  if (data.type === "scene") return painter.setScene(data.scene);
  ids.set(data.frame, data.id);
  painter.show(data.frame);
};
