/** HPGL of random lines: texts never draw, and scaling and rotation do not depend on the order of commands. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { importDrawing } from "../../../../src/import/registry.js";
import { textOfBytes } from "../../../../src/import/text-of-bytes.js";
import { countFor } from "../../../support/runs/full-run.js";

const RUNS = { numRuns: countFor("PLOTWRIGHT_HPGL_CASES", 1_000, 100) };
const hpgl = (text: string) => importDrawing("a.plt", text);
const coordsOf = async (text: string): Promise<number[]> => [...(await hpgl(text)).paths.coords];

const coordinate = fc.integer({ min: -9_999, max: 9_999 });
const COMMANDS: readonly fc.Arbitrary<string>[] = [
  fc.tuple(coordinate, coordinate).map(([x, y]) => `PU${x},${y};`),
  fc
    .array(coordinate, { minLength: 2, maxLength: 8 })
    .map((numbers) => `PD${numbers.slice(numbers.length % 2)};`),
  fc.tuple(coordinate, coordinate, fc.integer({ min: -360, max: 360 })).map((numbers) => `AA${numbers};`),
  fc.integer({ min: 1, max: 5_000 }).map((radius) => `CI${radius};`),
  fc.tuple(coordinate, coordinate).map(([x, y]) => `EA${x},${y};`),
  fc.array(coordinate, { minLength: 6, maxLength: 6 }).map((numbers) => `BZ${numbers};`),
  fc.array(coordinate, { minLength: 4, maxLength: 4 }).map((numbers) => `AT${numbers};`),
];
const drawn = fc
  .array(fc.oneof(...COMMANDS), { minLength: 1, maxLength: 12 })
  .map((commands) => `PU0,0;PD500,700;${commands.join("")}PU;`);

/** Likely to be taken for commands. */
const words = fc
  .array(
    fc.oneof(
      fc.constantFrom("PD", "PU", "LB", "SP2", "IN", "PM0", ";", ",", " ", "\n", "9", "é"),
      fc.string(),
    ),
  )
  .map((parts) => parts.join(""));
const without = (...chars: string[]): fc.Arbitrary<string> =>
  words.map((text) => [...text].filter((char) => !chars.includes(char)).join(""));

/** A number of an encoded line in base 64: digits from 63, the last from 191; the lowest bit is the sign. */
const digits = (value: number): number[] => {
  const out: number[] = [];
  let rest = 2 * Math.abs(value) + (value < 0 ? 1 : 0);
  for (; rest >= 64; rest = Math.floor(rest / 64)) out.push(63 + (rest % 64));
  return [...out, 191 + rest];
};
/** Small ones and zeros can be valid UTF-8 by chance. */
const step = fc.oneof(coordinate, fc.integer({ min: -31, max: 31 }), fc.constant(0));
const asciiBytes = (text: string): number[] => [...text].map((char) => char.charCodeAt(0));

describe("HPGL of random lines", () => {
  it("draws encoded lines from the bytes of a file as the same lines in numbers", async () => {
    await fc.assert(
      fc.asyncProperty(fc.array(fc.tuple(step, step), { minLength: 1, maxLength: 6 }), async (points) => {
        const bytes = [
          ...asciiBytes("IN;SP1;PU0,0;PE"),
          ...points.flat().flatMap(digits),
          ...asciiBytes(";PU;"),
        ];
        const encoded = await importDrawing("a.plt", textOfBytes(Uint8Array.from(bytes)));
        expect([...encoded.paths.coords]).toEqual(await coordsOf(`IN;SP1;PU0,0;PR;PD${points.join()};PU;`));
      }),
      RUNS,
    );
  });

  it("draws no text of a comment, message, name or stored label", async () => {
    const texts = [
      without('"').map((text) => `CO "${text}"`),
      without('"').map((text) => `MG"${text}";`),
      without('"').map((text) => `BP1,"${text}",2,0;`),
      without('"').map((text) => `QQ5,"${text}";`),
      without("\u0003").map((text) => `BL${text}\u0003`),
      without("\u0003").map((text) => `WD${text}\u0003`),
      without("#").map((text) => `DT#;BL${text}#DT;`),
    ];
    await fc.assert(
      fc.asyncProperty(drawn, fc.oneof(...texts), drawn, async (before, text, after) => {
        expect(await coordsOf(`IN;SP1;${before}${text}${after}`)).toEqual(
          await coordsOf(`IN;SP1;${before}${after}`),
        );
      }),
      RUNS,
    );
  });

  it("is the same with IP before SC and after it", async () => {
    const corners = fc
      .tuple(coordinate, coordinate, coordinate, coordinate)
      .filter(([a, b, c, d]) => a !== c && b !== d);
    const scales = fc
      .tuple(coordinate, coordinate, coordinate, coordinate, fc.constantFrom(0, 1, 2))
      .filter(([a, b, c, d, type]) => (type === 2 ? b !== 0 && d !== 0 : a !== b && c !== d));
    await fc.assert(
      fc.asyncProperty(corners, scales, drawn, async (ip, sc, lines) => {
        const after = await hpgl(`IN;SP1;SC${sc};IP${ip};${lines}`);
        expect([...after.paths.coords]).toEqual(await coordsOf(`IN;SP1;IP${ip};SC${sc};${lines}`));
      }),
      RUNS,
    );
  });

  it("is turned as a whole by RO, without a change of shape", async () => {
    await fc.assert(
      fc.asyncProperty(drawn, fc.constantFrom(90, 180, 270, -90, 450), async (lines, deg) => {
        const [plain, turned] = [await hpgl(`IN;SP1;${lines}`), await hpgl(`IN;RO${deg};SP1;${lines}`)];
        const size = [plain.widthMm, plain.heightMm];
        const [width, height] = deg % 180 === 0 ? size : size.reverse();
        expect(turned.widthMm).toBeCloseTo(width, 3);
        expect(turned.heightMm).toBeCloseTo(height, 3);
        expect(turned.paths.count).toBe(plain.paths.count);
        expect(turned.warnings).toHaveLength(plain.warnings.length);
      }),
      RUNS,
    );
  });
});
