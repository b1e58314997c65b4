/** Creates a painter on a canvas, in a worker or on the page. Handles the loss of the WebGL context. */
import { hasCard } from "./graphics-card.js";
import { Painter } from "./painter.js";
import type { Frame, SceneRenderer, StrokesCanvas } from "./renderer.js";

/** `onPicture` is called when a picture is on the canvas. */
export const paintOn = (
  canvas: StrokesCanvas,
  onPicture: (frame: Frame, isWhole: boolean) => void,
): Painter => {
  const clock = {
    nowMs: () => performance.now(),
    wait: (ms: number) => new Promise<void>((resolve) => setTimeout(resolve, ms)),
  };
  const painter = new Painter(clock, onPicture);
  const begin = async (): Promise<void> => painter.setRenderer(await rendererOn(canvas));
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    painter.setRenderer(null);
  });
  // Reported as an error of this thread: if the worker can't draw, the page then draws itself.
  const start = (): void => void begin().catch((error: unknown) => reportError(error));
  canvas.addEventListener("webglcontextrestored", start);
  start();
  return painter;
};

/** Loads only the renderer that is used. */
const rendererOn = async (canvas: StrokesCanvas): Promise<SceneRenderer | null> => {
  if (hasCard(spareCanvas())) {
    const { createGlRenderer } = await import("./gl-renderer.js");
    const renderer = createGlRenderer(canvas);
    // The card may refuse another context. The canvas then has no context, so the soft renderer can use it.
    if (renderer) return renderer;
  }
  const { createSoftRenderer } = await import("./soft-renderer.js");
  return createSoftRenderer(canvas);
};

const spareCanvas = (): StrokesCanvas =>
  typeof OffscreenCanvas === "undefined" ? document.createElement("canvas") : new OffscreenCanvas(1, 1);
