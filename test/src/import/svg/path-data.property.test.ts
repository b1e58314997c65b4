/**
 * Our path reader compared with svgpath, which shares no code with it, and with itself under changes without
 * meaning.
 */
import { describe, expect, it } from "vitest";
import fc from "fast-check";
import svgpath from "svgpath";
import { PAIRS_OF_VERB, VERB_CUBIC, VERB_LINE, VERB_MOVE } from "../../../../src/drawing/drawing.js";
import { drawPathData } from "../../../../src/import/path-data.js";
import { ShapeBuffer } from "../../../../src/import/shape-buffer.js";
import { cases } from "../../../support/runs/full-run.js";

const number = fc.double({ min: -500, max: 500, noNaN: true }).map((v) => Math.round(v * 1000) / 1000);
const flag = fc.constantFrom(0, 1);
const radius = fc.integer({ min: 1, max: 400 });
const numbers = (count: number) => fc.array(number, { minLength: count, maxLength: count });

/** A command with its arguments; letters of both cases. */
const segment = fc.oneof(
  ...[
    ["M", 2],
    ["L", 2],
    ["H", 1],
    ["V", 1],
    ["C", 6],
    ["S", 4],
    ["Q", 4],
    ["T", 2],
  ].map(([letter, count]) =>
    fc.tuple(fc.constantFrom(letter as string, (letter as string).toLowerCase()), numbers(count as number)),
  ),
  fc.tuple(fc.constantFrom("Z", "z"), fc.constant<number[]>([])),
  fc.tuple(
    fc.constantFrom("A", "a"),
    fc.tuple(radius, radius, number, flag, flag, number, number).map((args) => [...args]),
  ),
);
type Segment = [string, number[]];
const path = fc
  .tuple(numbers(2), fc.array(segment, { minLength: 1, maxLength: 12 }))
  .map(([start, rest]): Segment[] => [["M", start], ...(rest as Segment[])]);

const spaced = (segments: readonly Segment[]): string =>
  segments.map(([letter, args]) => `${letter} ${args.join(" , ")}`).join(" ");

/** As short as the grammar allows. */
const tight = (segments: readonly Segment[]): string =>
  segments
    .map(([letter, args]) =>
      args.reduce((text, value, i) => {
        const digits = String(value).replace(/^(-?)0\./, "$1.");
        const isAfterFlag = letter.toLowerCase() === "a" && (i === 4 || i === 5);
        return text + (i === 0 || isAfterFlag || digits.startsWith("-") ? "" : " ") + digits;
      }, letter),
    )
    .join("");

function read(d: string): ShapeBuffer {
  const shape = new ShapeBuffer();
  expect(drawPathData(shape, d, 1e-6), d).toBe(-1);
  shape.finish();
  return shape;
}

/** Where each drawn segment ends, arcs as one. */
function ends(shape: ShapeBuffer): [number, number][] {
  const inner = new Set(shape.innerVerbs);
  const result: [number, number][] = [];
  for (let i = 0, at = 0; i < shape.verbs.length; i++) {
    const verb = shape.verbs.data[i];
    at += 2 * PAIRS_OF_VERB[verb];
    if ((verb === VERB_LINE || verb === VERB_CUBIC) && !inner.has(i)) {
      result.push([shape.coords.data[at - 2], shape.coords.data[at - 1]]);
    }
  }
  return result;
}

describe("path data", () => {
  it("ends every segment where an independent reader does", () => {
    fc.assert(
      fc.property(path, (segments) => {
        const d = spaced(segments);
        const expected: [number, number][] = [];
        let previous: [number, number] = [0, 0];
        let start: [number, number] = [0, 0];
        let isFresh = false;
        svgpath(d)
          .abs()
          .unshort()
          .iterate(([letter, ...args]) => {
            const values = args as number[];
            const end: [number, number] =
              letter === "H"
                ? [values[0], previous[1]]
                : letter === "V"
                  ? [previous[0], values[0]]
                  : (values.slice(-2) as [number, number]);
            if (letter === "Z") {
              // A closed lone move is a dot.
              if (isFresh) expected.push(start);
              previous = start;
              isFresh = false;
            } else {
              if (letter === "M") start = end;
              const isEmptyArc = letter === "A" && end[0] === previous[0] && end[1] === previous[1];
              if (letter !== "M" && !isEmptyArc) expected.push(end);
              isFresh = letter === "M" || (isFresh && isEmptyArc);
              previous = end;
            }
          });
        const ours = ends(read(d));
        expect(ours.length, d).toBe(expected.length);
        ours.forEach(([x, y], i) => {
          expect(Math.hypot(x - expected[i][0], y - expected[i][1]), d).toBeLessThan(1e-6);
        });
      }),
      { numRuns: cases(500) },
    );
  });

  it("reads the shortest spelling like the longest", () => {
    fc.assert(
      fc.property(path, (segments) => {
        const wide = read(spaced(segments));
        const narrow = read(tight(segments));
        expect([...narrow.verbs.toArray()]).toEqual([...wide.verbs.toArray()]);
        expect([...narrow.coords.toArray()]).toEqual([...wide.coords.toArray()]);
      }),
      { numRuns: cases(300) },
    );
  });

  it("reads every number as JavaScript does", () => {
    fc.assert(
      fc.property(
        fc.double({ noNaN: true, noDefaultInfinity: true }),
        fc.integer({ min: 0, max: 20 }),
        (v, digits) => {
          for (const text of [String(v), v.toExponential(), Math.abs(v) < 1e15 ? v.toFixed(digits) : "0"]) {
            expect(read(`M0 0H${text}`).coords.data[2], text).toBe(Number(text) === 0 ? 0 : Number(text));
          }
        },
      ),
      { numRuns: cases(2_000) },
    );
  });

  it("begins every subpath with a move and never leaves a move alone", () => {
    fc.assert(
      fc.property(path, (segments) => {
        const { verbs } = read(spaced(segments));
        for (let i = 0; i < verbs.length; i++) {
          if (i === 0) expect(verbs.data[i]).toBe(VERB_MOVE);
          if (verbs.data[i] === VERB_MOVE)
            expect(verbs.data[i + 1] === VERB_LINE || verbs.data[i + 1] === VERB_CUBIC).toBe(
              i + 1 < verbs.length,
            );
        }
      }),
    );
  });
});
