/** DXF files without the ends that a reader may wait for. */
import { describe, expect, it } from "vitest";
import type { Drawing } from "../../../../src/index.js";
import { importDrawing } from "../../../../src/import/registry.js";
import { endWhenOver } from "../../../support/clocks/watchdog.js";

const HANGS_MS = 20_000;

/** Groups separated by "|", code and value by a space. */
const dxf = (groups: string): string => groups.replace(/\||(?<=(?:^|\|)\d+) /g, "\n");
const read = (groups: string): Promise<Drawing> =>
  endWhenOver(HANGS_MS, () => importDrawing("a.dxf", dxf(groups)));

describe("a POLYLINE", () => {
  const entities = (groups: string): string => `0 SECTION|2 ENTITIES|0 POLYLINE|8 0|${groups}|0 EOF`;
  const square = "0 VERTEX|10 0|20 0|0 VERTEX|10 9|20 0|0 VERTEX|10 9|20 5";

  it.each([
    ["another entity before its vertices", "0 LINE|10 1|20 2|11 3|21 4|0 ENDSEC", 1],
    ["another entity in place of its SEQEND", `${square}|0 LINE|10 1|20 2|11 3|21 4|0 ENDSEC`, 2],
    ["the section's end in place of its SEQEND", `${square}|0 ENDSEC`, 1],
  ])("with %s is drawn as far as it goes", async (_what, groups, shapes) => {
    expect((await read(entities(groups))).paths.count).toBe(shapes);
  });

  it("without an end or vertices ends where the next entity begins, also in a file of a few bytes", async () => {
    const { paths, warnings } = await read("0 SECTION|2 ENTITIES|0 POLYLINE|8 0|66 1|0 LINE|0 EOF");
    expect(paths.count).toBe(0);
    expect(warnings.map(({ code }) => code)).toEqual(["page-size", "object-unreadable", "empty-drawing"]);
  });

  it("keeps its bulges, its end and the flags of its vertices", async () => {
    const { paths, widthMm, heightMm } = await read(
      entities(
        `70 1|66 1|10 0|20 0|30 0|0 VERTEX|10 0|20 0|42 1|0 VERTEX|10 10|20 0|0 VERTEX|10 99|20 99|70 16|0 SEQEND|8 0|0 ENDSEC`,
      ),
    );
    expect(paths.count).toBe(1);
    // Half a circle below its chord; the control point of a fitted curve is not drawn.
    expect(widthMm).toBeCloseTo(10, 3);
    expect(heightMm).toBeCloseTo(5, 3);
  });
});

describe("a table", () => {
  const LINE = "0 SECTION|2 ENTITIES|0 LINE|8 0|10 0|20 0|11 9|21 9|0 ENDSEC|0 EOF";
  const tables = (groups: string): string => `0 SECTION|2 TABLES|${groups}|0 ENDSEC|${LINE}`;

  it.each([
    ["LAYER", "0 TABLE|2 LAYER|0 LAYER|2 a|62 1|0 LTYPE|2 b|0 ENDTAB"],
    ["LAYER", "0 TABLE|2 LAYER|0 LAYER|2 a|62 1"],
    ["VPORT", "0 TABLE|2 VPORT|0 VPORT|2 a|0 LAYER|2 b|0 ENDTAB"],
    ["LAYER", "0 TABLE|2 LAYER|0 TABLE|2 VPORT|0 LAYER|2 a"],
  ])("of %ss that contains another record, or has no end, ends with its section", async (_kind, groups) => {
    expect((await read(tables(groups))).paths.count).toBe(1);
  });

  it("is read with mixed line ends", async () => {
    const mixed = dxf(tables("0 TABLE|2 LAYER|0 LAYER|2 0|62 -1|0 X|2 b|0 ENDTAB")).replace(
      "LAYER\n0",
      "LAYER\r0",
    );
    const { groups } = await endWhenOver(HANGS_MS, () => importDrawing("a.dxf", mixed));
    expect(groups).toEqual([{ id: "0", name: "Layer 0", hidden: true }]);
  });

  it("of any kind that ends the file is refused, because nothing is left to draw", async () => {
    await expect(read("0 SECTION|2 TABLES|0 TABLE|2 LAYER|0 LAYER|2 a|0 EOF")).rejects.toThrow(/no ENTITIES/);
  });

  it("of any kind is read if it is complete", async () => {
    const whole =
      "0 TABLE|2 VPORT|70 1|0 VPORT|2 a|0 ENDTAB|0 TABLE|2 LTYPE|0 LTYPE|2 c|0 ENDTAB|0 TABLE|2 LAYER|70 2|0 LAYER|2 a|62 1|0 LAYER|2 b|62 2|0 ENDTAB|0 TABLE|2 STYLE|0 STYLE|2 s|0 ENDTAB";
    expect((await read(tables(whole))).paths.count).toBe(1);
  });
});

it("copies of an empty block are counted, so that they can't fill the memory", async () => {
  const insert = "0 INSERT|2 B|70 1000|71 1000";
  const file = `0 SECTION|2 BLOCKS|0 BLOCK|2 B|10 0|20 0|0 POINT|8 0|60 1|${insert}|0 ENDBLK|0 ENDSEC|0 SECTION|2 ENTITIES|${insert}|0 ENDSEC|0 EOF`;
  await expect(read(file)).rejects.toThrow(/expand to more than 1000000 objects/);
});
