/** Small DXF files, and letters of a known shape for them. */
import type { Drawing } from "../../../src/index.js";
import { importDrawing } from "../../../src/import/registry.js";
import type { ImportOptions } from "../../../src/import/import-options.js";
import type { TextFont } from "../../../src/import/text/text-font.js";

/** 100 × 100 mm, the first shape of every drawing: on the page y points down from 100. */
const FRAME = "0 LWPOLYLINE\n8 0\n90 4\n70 1\n10 0\n20 0\n10 100\n20 0\n10 100\n20 100\n10 0\n20 100";

/** Every letter is a box as high as capitals, 0.7 em, and 0.5 em wide; the next follows after 0.7 em. */
export const boxes: TextFont = {
  kind: "outline",
  layout: (line) => ({
    glyphs: [...line].map((char) => ({
      path: char === " " ? "" : "M0 0L0.5 0L0.5 -0.7L0 -0.7Z",
      x: 0,
      y: 0,
      advance: 0.7,
    })),
    missing: [],
  }),
};

/** Groups as "code value" lines, so that values may have spaces. */
export async function drawDxf(entities: string, options: ImportOptions = {}, blocks = ""): Promise<Drawing> {
  const lines = [
    "0 SECTION\n2 HEADER\n9 $INSUNITS\n70 4\n0 ENDSEC",
    ...(blocks === "" ? [] : [`0 SECTION\n2 BLOCKS\n${blocks}\n0 ENDSEC`]),
    `0 SECTION\n2 ENTITIES\n${FRAME}\n${entities}\n0 ENDSEC\n0 EOF`,
  ];
  return await importDrawing("a.dxf", lines.join("\n").replace(/^(\d+) /gm, "$1\n"), options);
}

interface DxfParts {
  readonly header?: string;
  readonly tables?: string;
  readonly blocks?: string;
}

/** A file of these parts. Groups separated by "|", code and value by a blank; in mm. */
export const drawParts = (
  entities: string,
  { header = "", tables = "", blocks = "" }: DxfParts = {},
): Promise<Drawing> =>
  importDrawing(
    "a.dxf",
    [
      `0 SECTION|2 HEADER|9 $INSUNITS|70 4${header}|0 ENDSEC`,
      `0 SECTION|2 TABLES${tables}|0 ENDSEC|0 SECTION|2 BLOCKS${blocks}|0 ENDSEC`,
      `0 SECTION|2 ENTITIES${entities}|0 ENDSEC|0 EOF`,
    ]
      .join("|")
      .replace(/\||(?<=(?:^|\|)\d+) /g, "\n"),
  );
/** A horizontal line of 50 mm. */
export const lineOn = (layer: string, y: number, more = ""): string =>
  `|0 LINE|8 ${layer}${more}|10 0|20 ${y}|11 50|21 ${y}`;
