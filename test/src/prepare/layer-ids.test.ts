import { expect, it } from "vitest";
import { DEFAULT_PREPARE, importSvg, prepare } from "../../../src/index.js";
import { NO_PENS, penStopsOf, prepareSettingsOf, strokeCount } from "../../../src/internal.js";

it.each(["constructor", "toString", "__proto__"])("a layer called %s is drawn like any other", async (id) => {
  const drawing = await importSvg(
    `<svg xmlns="http://www.w3.org/2000/svg" width="99mm" height="99mm" viewBox="0 0 99 99" stroke="red">
       <g id="a"><path d="M10 10H20"/></g><g id="${id}"><path d="M10 20H20"/></g></svg>`,
  );
  expect(drawing.groups[1]?.id).toBe(id);
  const pens = [{ id: "pen", name: "Pen", color: null, widthMm: 1, offsetXMm: 1, offsetYMm: 1 }];
  const settings = { ...NO_PENS, pens, layerPens: { a: "pen" } };
  const { strokes } = prepare(drawing, prepareSettingsOf({ ...settings, prepare: DEFAULT_PREPARE }));
  expect(strokeCount(strokes)).toBe(2);
  expect([...strokes.xy].every(Number.isFinite)).toBe(true);
  expect(penStopsOf(strokes, settings)).toEqual([]);
});
