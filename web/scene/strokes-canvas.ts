/** A painter with its canvas, on either thread: by the graphics card or without one, and when the card is taken away. */
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
  // Told as an error of its thread: a page whose worker can't draw then draws by itself.
  const tryIt = (): void => void begin().catch((error: unknown) => reportError(error));
  canvas.addEventListener("webglcontextrestored", tryIt);
  tryIt();
  return painter;
};

/** Only the one that is needed is fetched. */
const rendererOn = async (canvas: StrokesCanvas): Promise<SceneRenderer | null> => {
  if (hasCard(spareCanvas())) {
    const { createGlRenderer } = await import("./gl-renderer.js");
    const renderer = createGlRenderer(canvas);
    // The card may refuse one context more: this canvas has none then, and can still be drawn on without it.
    if (renderer) return renderer;
  }
  const { createSoftRenderer } = await import("./soft-renderer.js");
  return createSoftRenderer(canvas);
};

const spareCanvas = (): StrokesCanvas =>
  typeof OffscreenCanvas === "undefined" ? document.createElement("canvas") : new OffscreenCanvas(1, 1);
