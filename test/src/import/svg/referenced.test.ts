/** The attributes by which shapes refer to clips, masks and markers, in files without any style. */
import { describe, expect, it } from "vitest";
import { importSvg } from "../../../../src/index.js";

const file = (reference: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20">
    <defs>
      <clipPath id="clip-path"><rect width="5" height="20"/></clipPath>
      <mask id="mask"><rect width="5" height="20" fill="#ffffff"/></mask>
      <marker id="marker" overflow="visible"><path d="M0 0V1" stroke="#000000"/></marker>
    </defs>
    <path d="M1 1H9V9" stroke="#000000" fill="none" ${reference}/>
  </svg>`;

describe("a shape that refers by its only attribute", () => {
  it.each([
    ["clip-path", "clip-path"],
    ["mask", "mask"],
    ["marker-start", "marker"],
    ["marker-mid", "marker"],
    ["marker-end", "marker"],
  ])("%s is drawn as with a style", async (name, id) => {
    const drawing = await importSvg(file(`${name}="url(#${id})"`));
    expect(drawing).toEqual(await importSvg(file(`style="${name}: url(#${id})"`)));
    expect(drawing).not.toEqual(await importSvg(file("")));
  });
});
