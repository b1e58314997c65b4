/** Whether there is a graphics card behind WebGL2, and the context that its renderer draws with. */
import type { StrokesCanvas } from "./renderer.js";

/** Programs that do a graphics card's work on the processor, by what they call themselves. */
const IMITATIONS = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** There is WebGL2, and a graphics card behind it. Asked of a canvas that is then thrown away. */
export const hasCard = (canvas: StrokesCanvas): boolean => {
  const gl = webGlOf(canvas);
  if (!gl) return false;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return !IMITATIONS.test(name);
};

/** Null where the browser has no WebGL2. */
export const webGlOf = (canvas: StrokesCanvas): WebGL2RenderingContext | null =>
  // The two kinds of canvas have the same method with lists of kinds of contexts that differ.
  (canvas as HTMLCanvasElement).getContext("webgl2", {
    alpha: true,
    antialias: false,
    premultipliedAlpha: true,
    failIfMajorPerformanceCaveat: true,
  });
