/** The encoded lines (PE) of HP-GL/2. */
import { describe, expect, it } from "vitest";
import { importDrawing } from "../../../../src/import/registry.js";
import { textOfBytes } from "../../../../src/import/text-of-bytes.js";
import { codes, shapesOf } from "../../../support/import/shapes.js";

describe("encoded lines of HPGL", () => {
  /** A number in base 64: digits from 63, the last from 191; the lowest bit is the sign. */
  const digits = (value: number): number[] => {
    const out: number[] = [];
    let rest = 2 * Math.abs(value) + (value < 0 ? 1 : 0);
    for (; rest >= 64; rest = Math.floor(rest / 64)) out.push(63 + (rest % 64));
    return [...out, 191 + rest];
  };
  const bytesOf = (...parts: (string | number[])[]): Uint8Array =>
    Uint8Array.from(
      parts.flatMap((part) => (typeof part === "string" ? [...part].map((c) => c.charCodeAt(0)) : part)),
    );

  it("are right from all bytes of a file, which is not text in UTF-8", async () => {
    for (const preface of [
      "",
      "\u001b.(",
      "\u001bE\u001b&l2A\u001b%0B",
      "\u001b%-12345X@PJL ENTER LANGUAGE=HPGL2\r\n",
    ]) {
      const file = bytesOf(
        `${preface}IN;SP1;PE<=`,
        [...digits(0), ...digits(0), ...digits(2000), ...digits(0), ...digits(-1000), ...digits(4000)],
        ";PU;",
      );
      const drawing = await importDrawing("a", textOfBytes(file));
      expect(shapesOf(drawing), preface).toEqual(["M0 100L50 100L25 0"]);
      expect(codes(drawing)).toEqual([]);
    }
  });

  it("have flags with any eighth bit, and may be broken by blanks and control characters", async () => {
    const flag = (char: string): number[] => [char.charCodeAt(0) + 128];
    const to = (x: number, y: number): number[] => [...digits(x), ...digits(y)];
    const plain = bytesOf(
      "IN;SP1;PE<=",
      to(0, 0),
      to(2000, 0),
      ":",
      digits(2),
      "<=",
      to(0, 400),
      to(800, 0),
      ";",
    );
    const flags = bytesOf(
      ...["IN;SP1;PE", flag("<"), flag("="), to(0, 0), to(2000, 0)],
      ...[flag(":"), digits(2), flag("<"), flag("="), to(0, 400), to(800, 0), ";"],
    );
    const [head, ...tail] = digits(2000);
    const broken = bytesOf(
      ...["IN;SP1;PE<=\r\n", to(0, 0), [head, 13, 10, 127, 32, 130, 255, ...tail], digits(0)],
      ...[":", digits(2), "<=", to(0, 400), to(800, 0), ";"],
    );
    for (const file of [plain, flags, broken]) {
      const drawing = await importDrawing("a", textOfBytes(file));
      expect(shapesOf(drawing)).toEqual(["M0 10L50 10", "M0 0L20 0"]);
      expect(drawing.groups.map(({ name }) => name)).toEqual(["Pen 1", "Pen 2"]);
    }
  });

  it("are reported instead of drawn if bytes were lost", async () => {
    const drawing = await importDrawing("a.plt", `IN;SP1;PU0,0;PD1000,0;PU;PE<=\ufffd\ufffd\ufffd\ufffd;PU;`);
    expect(codes(drawing)).toEqual(["attribute-fault"]);
    expect(drawing.paths.count).toBe(1);
  });
});
