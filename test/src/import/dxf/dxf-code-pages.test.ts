/** Names and texts of DXF files up to R2004, whose letters are in a code page. */
import { describe, expect, it } from "vitest";
import { importDrawing } from "../../../../src/import/registry.js";
import { textOfBytes } from "../../../../src/import/text-of-bytes.js";

const LINE = "0\nLINE\n8\n@\n10\n0\n20\n0\n11\n9\n21\n9\n";
const ascii = (text: string): number[] => Array.from(text, (letter) => letter.charCodeAt(0));

/** A DXF with one line on each layer, whose name is given in bytes. */
const file = (codePage: string, layers: readonly (readonly number[])[], version = "AC1015"): Uint8Array =>
  Uint8Array.from([
    ...ascii(`0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\n${version}\n`),
    ...(codePage === "" ? [] : ascii(`9\n$DWGCODEPAGE\n3\n${codePage}\n`)),
    ...ascii("0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"),
    ...layers.flatMap((name) => [...ascii(LINE.split("@")[0]), ...name, ...ascii(LINE.split("@")[1])]),
    ...ascii("0\nENDSEC\n0\nEOF\n"),
  ]);
const layersOf = async (bytes: Uint8Array): Promise<string[]> =>
  (await importDrawing("a.dxf", textOfBytes(bytes))).groups.map(({ name }) => name);

describe("the letters of a DXF", () => {
  it.each([
    ["ANSI_1252", [0x54, 0xfc, 0x72], "Tür"],
    ["ansi_1252", [0x54, 0xf6, 0x72], "Tör"],
    ["", [0x54, 0xfc, 0x72], "Tür"],
    ["ANSI_1250", [0xa3, 0xf3, 0x64, 0x9f], "Łódź"],
    ["ANSI_1251", [0xd1, 0xf2, 0xe5, 0xed, 0xe0], "Стена"],
    ["ANSI_1253", [0xd4, 0xef, 0xdf], "Τοί"],
    ["ANSI_1254", [0xdd, 0xfe], "İş"],
    ["ANSI_1255", [0xf7, 0xe9, 0xf8], "\u05e7\u05d9\u05e8"],
    ["ANSI_1256", [0xcc, 0xcf], "\u062c\u062f"],
    ["ANSI_1257", [0xd0, 0xe2], "Šā"],
    ["ANSI_1258", [0xd0, 0xfd], "Đư"],
    ["ANSI_874", [0xa1, 0xd3], "\u0e01\u0e33"],
    ["ANSI_932", [0x95, 0xc7, 0x83, 0x5c], "壁ソ"],
    ["ANSI_936", [0xc7, 0xbd], "墙"],
    ["GB2312", [0xcd, 0xbc, 0xb2, 0xe3], "图层"],
    ["ANSI_949", [0xba, 0xae], "벽"],
    ["ANSI_950", [0xc0, 0xf0], "牆"],
    ["DOS437", [0x54, 0x81, 0x72, 0xe1], "Türß"],
    ["DOS850", [0x54, 0x81, 0x72, 0x9b], "Türø"],
    ["dos852", [0x9d, 0xa2, 0x64, 0xab], "Łódź"],
    ["DOS855", [0xdd], "П"],
    ["DOS860", [0x84], "ã"],
    ["DOS865", [0x9b], "ø"],
    ["DOS866", [0x91, 0xe2], "Ст"],
    ["DOS869", [0xa4], "Α"],
    ["DOS932", [0x95, 0xc7], "壁"],
    ["ISO8859-2", [0xa3], "Ł"],
    ["MACINTOSH", [0x9f], "ü"],
  ])("are read in code page %s", async (codePage, bytes, name) => {
    expect(await layersOf(file(codePage, [bytes]))).toEqual([name]);
  });

  it("do not merge layers that differ in one of them", async () => {
    expect(
      await layersOf(
        file("ANSI_1252", [
          [0x54, 0xfc, 0x72],
          [0x54, 0xf6, 0x72],
        ]),
      ),
    ).toEqual(["Tür", "Tör"]);
  });

  it.each(["ANSI_1252", "ANSI_1251", "ANSI_936", "DOS850", ""])(
    "are UTF-8 where they can be, whatever the header says: %s",
    async (codePage) => {
      const name = codePage === "ANSI_936" ? "墙体" : "Türwand";
      expect(await layersOf(file(codePage, [[...new TextEncoder().encode(name)]]))).toEqual([name]);
    },
  );

  it("are UTF-8 since R2007, even if some are damaged", async () => {
    const name = [...new TextEncoder().encode("ü"), 0xff];
    expect(await layersOf(file("ANSI_1252", [name], "AC1021"))).toEqual(["ü\ufffd"]);
  });

  it("may be written by their number", async () => {
    expect(await layersOf(file("ANSI_1252", [ascii("T\\U+00fcr"), [0x54, 0xfc, 0x72]]))).toEqual(["Tür"]);
  });

  it("of an SVG that quotes a DXF are left alone", () => {
    const svg = "<svg><!-- 0\nSECTION\n $DWGCODEPAGE\n3\nANSI_1251 --><text>ü</text></svg>";
    expect(textOfBytes(new TextEncoder().encode(svg))).toBe(svg);
  });
});
