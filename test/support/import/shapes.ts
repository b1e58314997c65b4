/** A drawing as text that a reader can check: one line per shape, verbs and mm. */
import { PAIRS_OF_VERB, type Drawing } from "../../../src/drawing/drawing.js";
import { flattenCubic } from "../../../src/geometry/cubic.js";
import { PointBuffer } from "../../../src/geometry/growable.js";
import type { ImportOptions } from "../../../src/import/import-options.js";
import { importSvg } from "../../../src/import/svg/import-svg.js";

const LETTERS = ["M", "L", "C", "Z"];

const tidy = (mm: number): string => String(Math.round(mm * 1e4) / 1e4 + 0);

/** A 100 mm page on which a user unit is 1 mm. */
export const page = (body: string, attributes = ""): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="100mm" height="100mm" viewBox="0 0 100 100" fill="none" stroke="#000" ${attributes}>${body}</svg>`;

export function shapesOf({ paths }: Drawing): string[] {
  return Array.from({ length: paths.count }, (_, i) => {
    let at = paths.coordOffsets[i];
    let text = "";
    for (let v = paths.verbOffsets[i]; v < paths.verbOffsets[i + 1]; v++) {
      const verb = paths.verbs[v];
      const end = at + 2 * PAIRS_OF_VERB[verb];
      text += LETTERS[verb] + Array.from(paths.coords.subarray(at, end), tidy).join(" ");
      at = end;
    }
    return text;
  });
}

export const draw = (body: string, options?: ImportOptions): Promise<Drawing> =>
  importSvg(page(body), options);

/** The shapes of a body on the 100 mm page. */
export const shapes = async (body: string): Promise<string[]> => shapesOf(await draw(body));

export const codes = (drawing: Drawing): string[] => drawing.warnings.map((warning) => warning.code);

/** x, y pairs of shape `index`, its curves flattened to 1 µm. */
export function pointsOf({ paths }: Drawing, index = 0): [number, number][] {
  const out = new PointBuffer();
  const c = paths.coords;
  let at = paths.coordOffsets[index];
  for (let v = paths.verbOffsets[index]; v < paths.verbOffsets[index + 1]; v++) {
    const verb = paths.verbs[v];
    if (verb === 2) {
      flattenCubic(
        out,
        c[at - 2],
        c[at - 1],
        c[at],
        c[at + 1],
        c[at + 2],
        c[at + 3],
        c[at + 4],
        c[at + 5],
        1e-5,
      );
    } else if (verb !== 3) out.push(c[at], c[at + 1]);
    at += 2 * PAIRS_OF_VERB[verb];
  }
  return Array.from({ length: out.pointCount }, (_, i) => [out.data[2 * i], out.data[2 * i + 1]]);
}

/** The clips of the first shape, from the outermost in, as the numbers of their outlines. */
export async function clipsOf(body: string): Promise<number[][]> {
  const { paths, clips } = await draw(body);
  const chain: number[][] = [];
  for (let at = paths.clip[0]; at >= 0; at = clips[at].parent) {
    chain.unshift(Array.from(clips[at].coords, (mm) => Math.round(mm * 1e4) / 1e4));
  }
  return chain;
}
