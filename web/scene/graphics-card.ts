/** Whether WebGL2 uses a graphics card, and creating its context. */
import type { StrokesCanvas } from "./renderer.js";

/** Names of software renderers. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** Whether there is WebGL2 with a graphics card. Uses up the canvas. */
export const hasCard = (canvas: StrokesCanvas): boolean => {
  const gl = webGlOf(canvas);
  if (!gl) return false;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return !SOFTWARE.test(name);
};

/** Null if the browser has no WebGL2. */
export const webGlOf = (canvas: StrokesCanvas): WebGL2RenderingContext | null =>
  // Both kinds of canvas have this method, but TypeScript declares it with different lists of contexts.
  (canvas as HTMLCanvasElement).getContext("webgl2", {
    alpha: true,
    antialias: false,
    premultipliedAlpha: true,
    failIfMajorPerformanceCaveat: true,
  });
