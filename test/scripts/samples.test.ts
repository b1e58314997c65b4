/** The drawings that come with plotwright: the first thing a newcomer sees, and the input of many tests. */
import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { describe, expect, it } from "vitest";
import { DEFAULT_PREPARE, importSvg, prepare } from "../../src/index.js";

const FOLDER = path.join(import.meta.dirname, "..", "..", "samples");
const files = readdirSync(FOLDER).filter((file) => file.endsWith(".svg"));

const drawingOf = (file: string) => importSvg(readFileSync(path.join(FOLDER, file), "utf8"));

describe("the samples", () => {
  it("begin with the meadow, which the page opens by itself", () => {
    expect([...files].sort()[0]).toBe("flower-meadow.svg");
    expect(files.length).toBeGreaterThanOrEqual(5);
  });

  it.each(files)("%s is A4 landscape, has a title, and is drawn completely", async (file) => {
    expect(readFileSync(path.join(FOLDER, file), "utf8")).toMatch(/<title>[A-Z].+<\/title>/);
    const drawing = await drawingOf(file);
    expect(drawing.widthMm).toBeCloseTo(297, 6);
    expect(drawing.heightMm).toBeCloseTo(210, 6);
    expect(drawing.warnings).toEqual([]);
    const { coords } = drawing.paths;
    for (let i = 0; i < coords.length; i += 2) {
      expect(coords[i]).toBeGreaterThan(10);
      expect(coords[i]).toBeLessThan(287);
      expect(coords[i + 1]).toBeGreaterThan(10);
      expect(coords[i + 1]).toBeLessThan(200);
    }
  });

  it.each(files)("%s loses nothing when it is fitted to the paper", async (file) => {
    expect(prepare(await drawingOf(file), DEFAULT_PREPARE).warnings).toEqual([]);
  });

  it("cover the main uses of pens: layers by pen, one long curve, thousands of short strokes", async () => {
    expect((await drawingOf("three-colour-hills.svg")).groups.map((group) => group.name)).toEqual([
      "1 Sun",
      "2 Hills",
      "3 Pines and birds",
    ]);
    expect(new Set((await drawingOf("three-colour-hills.svg")).colors).size).toBe(3);
    expect((await drawingOf("harmonograph.svg")).paths.count).toBe(1);
    expect((await drawingOf("moonrise.svg")).paths.count).toBeGreaterThan(5_000);
  });
});
