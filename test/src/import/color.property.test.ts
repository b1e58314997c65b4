/** The colours that are read without culori, compared with it. */
import { convertRgbToOklab, parseHex } from "culori/fn";
import fc from "fast-check";
import { expect, it } from "vitest";
import { isNearWhite, parseHexColor } from "../../../src/import/color.js";
import { parseCssColor } from "../../../src/import/css-color.js";
import { importSvg } from "../../../src/import/svg/import-svg.js";
import { page } from "../../support/import/shapes.js";

const digits = (min: number, max: number): fc.Arbitrary<string> =>
  fc
    .array(fc.constantFrom(..."0123456789abcdefABCDEF"), { minLength: min, maxLength: max })
    .map((list) => list.join(""));

it("hexadecimal colours mean the same as in CSS, and other texts are none", () => {
  fc.assert(
    fc.property(digits(0, 10), fc.constantFrom("", " ", "\n"), (text, blank) => {
      const written = `${blank}#${text}${blank}`;
      expect(parseHexColor(written)).toEqual(parseCssColor(written));
    }),
  );
  for (const text of ["red", "none", "", "123456", "#12345g", "##123"])
    expect(parseHexColor(text)).toBeNull();
});

it("a colour is nearly white if it is near white in Oklab", () => {
  const light = fc.integer({ min: 0xd0, max: 0xff });
  fc.assert(
    fc.property(light, light, light, (...channels) => {
      const hex = `#${channels.map((channel) => channel.toString(16)).join("")}`;
      const { l, a, b } = convertRgbToOklab(parseHex(hex)!);
      const distance = Math.hypot(1 - l, a, b);
      // Published in two versions, whose digits differ from the eighth on.
      fc.pre(Math.abs(distance - 0.05) > 1e-6);
      expect(isNearWhite(hex)).toBe(distance < 0.05);
    }),
  );
});

/** Each in a file of its own, so that its form alone decides which code reads it. */
it.each([
  ["red", ["#ff0000"]],
  ["#F00", ["#ff0000"]],
  ["rgb(255 0 0)", ["#ff0000"]],
  ["url(#none) hsl(120 100% 50%)", ["#00ff00"]],
  ["url(#g)", ["#0000ff"]],
  ["transparent", []],
  ["#ff000000", []],
])("a stroke of %j has its colour wherever it is written", async (paint, colors) => {
  const gradient = `<linearGradient id="g"><stop stop-color="#00f"/></linearGradient>`;
  for (const line of [
    `<path d="M0 0L9 9" stroke="${paint}"/>`,
    `<path d="M0 0L9 9" style="stroke: ${paint}"/>`,
    `<style>path { stroke: ${paint} }</style><path d="M0 0L9 9"/>`,
    `<g color="${paint.startsWith("url") ? "black" : paint}"><path d="M0 0L9 9" stroke="${
      paint.startsWith("url") ? paint : "currentColor"
    }"/></g>`,
  ]) {
    expect((await importSvg(page(gradient + line))).colors).toEqual(colors);
  }
});

it.each([
  ["blue", "#0000ff"],
  ["#00f", "#0000ff"],
])("a gradient with the stop colour %s is replaced by it", async (color, hex) => {
  const gradient = `<linearGradient id="g"><stop stop-color="${color}"/></linearGradient>`;
  const { colors } = await importSvg(page(`${gradient}<path d="M0 0L9 9" stroke="url(#g)"/>`));
  expect(colors).toEqual([hex]);
});
