/** Strokes computed in a browser. Its sin and cos may differ from Node's in the last bits, and so may the strokes. */
import path from "node:path";
import { buildSync } from "esbuild";
import type { Page } from "playwright-core";
import { ROOT } from "../../../scripts/setup.mjs";
import type { StrokeSet } from "../../../src/index.js";
import type { PlotSettings } from "../../../src/schema/index.js";

/** `strokesOf` (svg-strokes.ts) in the page. */
export async function strokesInBrowser(page: Page, text: string, settings: PlotSettings): Promise<StrokeSet> {
  const { outputFiles } = buildSync({
    entryPoints: [path.join(ROOT, "test/support/browser/svg-strokes.ts")],
    bundle: true,
    format: "iife",
    globalName: "library",
    write: false,
  });
  const call = `library.strokesOf(${JSON.stringify(text)}, ${JSON.stringify(settings)})`;
  const json = await page.evaluate<string>(
    `(async () => {
      ${outputFiles[0].text}
      const { xy, offsets, layer, ...others } = await ${call};
      return JSON.stringify({ xy: [...xy], offsets: [...offsets], layer: [...layer], ...others });
    })()`,
  );
  const { xy, offsets, layer, ...others } = JSON.parse(json) as {
    readonly xy: readonly number[];
    readonly offsets: readonly number[];
    readonly layer: readonly number[];
    readonly layers: StrokeSet["layers"];
  };
  return {
    ...others,
    xy: Float64Array.from(xy),
    offsets: Uint32Array.from(offsets),
    layer: Uint16Array.from(layer),
  };
}
