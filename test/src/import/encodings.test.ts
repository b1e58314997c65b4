/** Files in other encodings than UTF-8 read as the same text. */
import { describe, expect, it } from "vitest";
import { encodingOf, textOfBytes } from "../../../src/import/text-of-bytes.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><text>Grüße</text></svg>';
const bytesOf = (text: string, littleEndian: boolean): Uint8Array => {
  const bytes = Buffer.from(text, "utf16le");
  return littleEndian ? bytes : bytes.swap16();
};

describe("the encoding of a file", () => {
  it.each([
    ["UTF-8", new TextEncoder().encode(SVG)],
    ["UTF-8 with a mark", new TextEncoder().encode(`\ufeff${SVG}`)],
    ["UTF-16, little endian", bytesOf(`\ufeff${SVG}`, true)],
    ["UTF-16, big endian", bytesOf(`\ufeff${SVG}`, false)],
    ["UTF-16 without a mark", bytesOf(SVG, true)],
    ["UTF-16, big endian, without a mark", bytesOf(SVG, false)],
  ])("%s", (_name, bytes) => {
    expect(textOfBytes(bytes)).toBe(SVG);
  });

  it("follows the XML declaration", () => {
    const text = `<?xml version='1.0' encoding="ISO-8859-1"?>${SVG}`;
    const bytes = Uint8Array.from(Buffer.from(text, "latin1"));
    expect(encodingOf(bytes)).toBe("iso-8859-1");
    expect(textOfBytes(bytes)).toBe(text);
  });

  it("is UTF-8 if the declaration names an unknown one", () => {
    const text = `<?xml version="1.0" encoding="klingon"?>${SVG}`;
    expect(textOfBytes(new TextEncoder().encode(text))).toBe(text);
  });
});
