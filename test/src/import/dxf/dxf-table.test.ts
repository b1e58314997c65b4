/** The table of DXF entities: complete, the same as in the documentation, and true for each entity. */
import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { DXF_ENTITIES } from "../../../../src/import/dxf/dxf-entities.js";
import { drawParts as draw, lineOn as line } from "../../../support/import/dxf.js";
import { codes, shapesOf } from "../../../support/import/shapes.js";

const BLOCK = "|0 BLOCK|2 B|10 0|20 0|0 LINE|8 0|10 0|20 0|11 7|21 3|0 ENDBLK";
const POINTS = "|10 0|20 0|10 10|20 5|10 20|20 0";
const corners = (codes: readonly number[]): string =>
  codes.map((code, i) => `|${code} ${[0, 9, 9, 0][i]}|${code + 10} ${[0, 0, 9, 9][i]}`).join("");
const SPLINE = `|70 0|71 2|72 6|73 3|40 0|40 0|40 0|40 1|40 1|40 1${POINTS}`;

/** By entity that is drawn: its groups. SEQEND and VERTEX are parts of others. */
const EXAMPLES: Readonly<Record<string, string>> = {
  "3DFACE": corners([10, 11, 12, 13]),
  ACAD_TABLE: "|2 B|10 1|20 1",
  ARC: "|10 9|20 9|40 5|50 0|51 90",
  ARC_DIMENSION: "|2 B|70 5",
  ATTDEF: "|10 0|20 0|40 5|1 default|2 TAG|70 0",
  ATTRIB: "|10 0|20 0|40 5|1 value|2 TAG|70 0",
  CIRCLE: "|10 9|20 9|40 5",
  DIMENSION: "|70 1|10 0|20 8|13 0|23 0|14 20|24 0",
  ELLIPSE: "|10 9|20 9|11 5|21 0|40 0.5|41 0|42 6.283185307179586",
  HATCH: `|2 SOLID|70 1|71 0|91 1|92 2|72 0|73 1|93 4${corners([10, 10, 10, 10])}|97 0|75 0|76 1|98 0`,
  HELIX: `|100 AcDbSpline${SPLINE}|100 AcDbHelix|10 0|20 0`,
  INSERT: "|2 B|10 1|20 1",
  LARGE_RADIAL_DIMENSION: "|2 B|70 4",
  LEADER: "|71 1|72 0|10 0|20 0|10 10|20 5",
  LINE: "|10 0|20 9|11 9|21 0",
  LWPOLYLINE: `|90 3|70 1${POINTS}`,
  MESH: "|91 0|92 3|10 0|20 0|30 0|10 9|20 0|30 0|10 0|20 9|30 0|93 4|90 3|90 0|90 1|90 2|94 0",
  MLEADER: "|300 CONTEXT_DATA{|302 LEADER{|10 9|20 9|304 LEADER_LINE{|10 0|20 0|305 }|303 }|301 }",
  MLINE:
    "|71 1|72 2|73 1|10 0|20 0|11 0|21 0|12 1|22 0|13 0|23 1|74 1|41 1|75 0|11 9|21 0|12 1|22 0|13 0|23 1|74 1|41 1|75 0",
  MTEXT: "|10 0|20 0|40 5|71 7|1 A",
  MULTILEADER: "|300 CONTEXT_DATA{|302 LEADER{|10 9|20 9|304 LEADER_LINE{|10 0|20 0|305 }|303 }|301 }",
  POINT: "|10 5|20 5",
  POLYLINE: "|66 1|70 0|0 VERTEX|8 0|10 0|20 0|0 VERTEX|8 0|10 9|20 9|0 SEQEND",
  RAY: "|10 0|20 0|11 1|21 1",
  SOLID: corners([10, 11, 13, 12]),
  SPLINE,
  TEXT: "|10 0|20 0|40 5|1 A",
  TRACE: corners([10, 11, 13, 12]),
  XLINE: "|10 0|20 0|11 1|21 1",
};
const PARTS_OF_OTHERS = ["SEQEND", "VERTEX"];

describe("the table of entities", () => {
  it.each([...DXF_ENTITIES].filter(([, { how }]) => how === "reported").map(([name]) => name))(
    "%s is reported and not drawn",
    async (name) => {
      const drawing = await draw(`${line("0", 0)}|0 ${name}|8 0|10 0|20 0|11 9|21 9|69 2`);
      expect(shapesOf(drawing)).toEqual(["M0 0L50 0"]);
      expect(codes(drawing)).toEqual([name === "IMAGE" ? "image-not-drawn" : "not-supported"]);
    },
  );

  it("is the one of the documentation", () => {
    const text = readFileSync(new URL("../../../../docs/import.md", import.meta.url), "utf8");
    const [, section] = text.split("\n## DXF\n");
    const rows = section.split("\n## ")[0].matchAll(/^\| (`[^|]*`) *\| (drawn|alike|reported) *\|/gm);
    const documented = [...rows].flatMap(([, names, how]) =>
      Array.from(names.matchAll(/`([^`]+)`/g), ([, name]) => [name, how]),
    );
    const inCode = [...DXF_ENTITIES].map(([name, { how }]) => [name, how]);
    expect(new Map(documented as [string, string][])).toEqual(new Map(inCode as [string, string][]));
    expect(documented.length).toBe(inCode.length);
  });

  it("has all entities of the DXF reference", () => {
    const reference =
      "3DFACE 3DSOLID ACAD_PROXY_ENTITY ARC ATTDEF ATTRIB BODY CIRCLE DIMENSION ELLIPSE HATCH HELIX IMAGE INSERT LEADER LIGHT LINE LWPOLYLINE MESH MLINE MULTILEADER MTEXT OLEFRAME OLE2FRAME POINT POLYLINE RAY REGION SECTION SEQEND SHAPE SOLID SPLINE SUN SURFACE ACAD_TABLE TEXT TOLERANCE TRACE PDFUNDERLAY DWFUNDERLAY DGNUNDERLAY VERTEX VIEWPORT WIPEOUT XLINE EXTRUDEDSURFACE LOFTEDSURFACE PLANESURFACE REVOLVEDSURFACE SWEPTSURFACE";
    expect(reference.split(" ").filter((name) => !DXF_ENTITIES.has(name))).toEqual([]);
  });

  it("an entity that is in no table is reported by its name", async () => {
    const [{ code, message }] = (await draw(`${line("0", 0)}|0 ACME_WALL|8 0`)).warnings;
    expect([code, message]).toEqual(["not-supported", expect.stringContaining("ACME_WALL")]);
  });

  it.each(
    [...DXF_ENTITIES]
      .filter(([name, { how }]) => how !== "reported" && !PARTS_OF_OTHERS.includes(name))
      .map(([name]) => name),
  )("%s is drawn", async (name) => {
    const frame = `${line("0", 0)}${line("0", 40)}`;
    const drawing = await draw(`${frame}|0 ${name}|8 0${EXAMPLES[name] ?? ""}`, { blocks: BLOCK });
    expect(shapesOf(drawing).length).toBeGreaterThan(2);
    expect(codes(drawing).filter((code) => code !== "text-substituted")).toEqual([]);
  });
});
