/** Mistakes that programs without types make: each message names what is wrong and says what to pass. */
import { describe, expect, it } from "vitest";
import * as plotwright from "../../../src/index.js";
import { PlotwrightError } from "../../../src/index.js";
import { GRBL } from "../../support/machines/machine.js";

/** The library as JavaScript sees it. */
type AnyFunction = (...args: readonly unknown[]) => unknown;
const call = plotwright as unknown as Readonly<Record<string, AnyFunction>>;
const build = plotwright as unknown as Readonly<Record<string, new (...args: readonly unknown[]) => unknown>>;
const { DEFAULT_MOTION, DEFAULT_PEN, DEFAULT_PREPARE, PAPER_SIZES, importSvg, plan, prepare } = plotwright;

const svg =
  '<svg xmlns="http://www.w3.org/2000/svg" width="50mm" height="50mm"><path d="M1 1H90" stroke="red"/></svg>';
const drawing = await importSvg(svg);
const prepared = prepare(drawing);
const { strokes } = prepared;
const trajectory = plan(strokes);
const machine = plotwright.machineById("axidraw-v3");
const job = { motion: DEFAULT_MOTION, pen: DEFAULT_PEN };
const board = { machine, firmware: "2.8.1", pen: DEFAULT_PEN };

/** TypeError: an argument of another kind. PlotwrightError: a wrong setting. */
const MISTAKES: readonly (readonly [
  string,
  () => unknown,
  typeof TypeError | typeof PlotwrightError,
  readonly string[],
])[] = [
  [
    "bytes as text",
    () => call.importSvg(new Uint8Array(9)),
    TypeError,
    ["importSvg", "Uint8Array", "readFileSync"],
  ],
  ["a promise as text", () => call.importSvg(Promise.resolve(svg)), TypeError, ["await it"]],
  ["no name of the file", () => call.importDrawing(svg), TypeError, ["importDrawing(name, text)", "missing"]],
  ["another option", () => call.importSvg(svg, { dpi: 72 }), PlotwrightError, ['"dpi"', "pxPerInch"]],
  [
    "another text mode",
    () => call.importSvg(svg, { text: "outlines" }),
    PlotwrightError,
    ['"outlines"', "outline"],
  ],
  ["a font's bytes", () => call.importSvg(svg, { font: new Uint8Array(9) }), TypeError, ["openOutlineFont"]],
  ["a drawing that is not awaited", () => call.prepare(importSvg(svg)), TypeError, ["await it"]],
  ["text for a drawing", () => call.prepare(svg), TypeError, ["the drawing is", "importSvg"]],
  [
    "a paper's name",
    () => call.prepare(drawing, { paper: "A4" }),
    PlotwrightError,
    ['paper is "A4"', "PAPER_SIZES.A4"],
  ],
  [
    "a paper without a height",
    () => call.prepare(drawing, { paper: { widthMm: 9 } }),
    PlotwrightError,
    ["paper.heightMm is missing"],
  ],
  ["another setting", () => call.prepare(drawing, { margin: 5 }), PlotwrightError, ['"margin"', "marginMm"]],
  [
    "text as a number",
    () => call.prepare(drawing, { marginMm: "5" }),
    PlotwrightError,
    ['marginMm is "5"', "0 to 1000 mm"],
  ],
  [
    "text as a switch",
    () => call.prepare(drawing, { fit: "yes" }),
    PlotwrightError,
    ['fit is "yes"', "true or false"],
  ],
  [
    "another choice",
    () => call.prepare(drawing, { order: "nearest" }),
    PlotwrightError,
    ['order is "nearest"', "none, fast, best"],
  ],
  ["a number as hatch", () => call.prepare(drawing, { hatch: 2 }), PlotwrightError, ["hatch settings are 2"]],
  [
    "one layer as a list",
    () => call.prepare(drawing, { hiddenLayers: "Ink" }),
    PlotwrightError,
    ["hiddenLayers", "a list"],
  ],
  ["what prepare returns", () => call.plan(prepared), TypeError, ["plan:", "prepare(drawing).strokes"]],
  [
    "a speed by itself",
    () => call.plan(strokes, { speed: 5 }),
    PlotwrightError,
    ['no motion setting "speed"', "draw"],
  ],
  [
    "limits of motion that are null",
    () => call.plan(strokes, { draw: null }),
    PlotwrightError,
    ["draw settings are null", "pass an object"],
  ],
  [
    "a misspelt limit",
    () => call.plan(strokes, { draw: { speed: 5 } }),
    PlotwrightError,
    ['no draw setting "speed"'],
  ],
  [
    "a pen's height that is no number",
    () => call.plan(strokes, {}, { upPct: "70" }),
    PlotwrightError,
    ["Pen height up"],
  ],
  [
    "one line for lines",
    () =>
      call.strokesOf([
        [0, 0],
        [9, 9],
      ]),
    TypeError,
    ["strokesOf([[[0, 0], [10, 10]]])"],
  ],
  ["a machine's id", () => call.checkBounds(strokes, "axidraw-v3"), TypeError, ["machineById"]],
  ["a machine for its id", () => call.planSvg(svg, { machine }), PlotwrightError, ["customMachine"]],
  [
    "paper beside prepare",
    () => call.planSvg(svg, { paper: PAPER_SIZES.A4 }),
    PlotwrightError,
    ['"paper"', "prepare"],
  ],
  [
    "no settings of a job",
    () => call.planJob({ strokes }),
    TypeError,
    ["planJob", "settings object is missing"],
  ],
  ["no machine", () => call.planJob({ strokes }, job), TypeError, ["the machine is missing", "machineById"]],
  ["strokes for a job", () => call.planJob(strokes, job, machine), TypeError, ["{ strokes }"]],
  ["no options", () => call.compile(trajectory), TypeError, ["{ machine, firmware, pen }"]],
  [
    "no firmware",
    () => call.compile(trajectory, { ...board, firmware: undefined }),
    TypeError,
    ['no "firmware"'],
  ],
  [
    "half of a pen for a board",
    () => call.compile(trajectory, { ...board, pen: { upPct: 60 } }),
    PlotwrightError,
    ["Pen height down is missing"],
  ],
  ["strokes for motion", () => call.compile(strokes, board), TypeError, ["what plan returns"]],
  [
    "a machine without an EBB",
    () => call.compile(trajectory, { ...board, machine: GRBL }),
    PlotwrightError,
    ["EiBotBoard", '"grbl"', "planJob"],
  ],
  ["no size of the paper", () => call.toSvg(strokes), TypeError, ["toSvg", "{ widthMm, heightMm }"]],
  ["no clock of a board", () => new build.VirtualBoard({}), TypeError, ['no "clock"', "browserClock"]],
  ["no transport", () => new build.BoardSession(), TypeError, ["the transport is missing"]],
];

describe("a wrong argument", () => {
  it.each(MISTAKES)("is named in the message: %s", async (_name, mistake, kind, words) => {
    let error: unknown = null;
    try {
      await mistake();
    } catch (thrown) {
      error = thrown;
    }
    expect(error).toBeInstanceOf(kind);
    for (const word of words) expect((error as Error).message).toContain(word);
    expect((error as Error).message).not.toContain("undefined");
  });
});

describe("compile with a profile that lacks a field", () => {
  const without = (values: object, field: string): unknown =>
    Object.fromEntries(Object.entries(values).filter(([key]) => key !== field));
  const fields = ["widthMm", "heightMm", "stepsPerMm", "motors", "controller"];
  const ofBoard = ["kind", "microstepMode", "servoPosAt0Pct", "servoPosAt100Pct", "servoPin"];

  it.each([
    ...fields.map((field) => [field, without(machine, field)] as const),
    ...ofBoard.map(
      (field) => [field, { ...machine, controller: without(machine.controller, field) }] as const,
    ),
  ])("names %s", (field, incomplete) => {
    const compiled = (): unknown => call.compile(trajectory, { ...board, machine: incomplete });
    expect(compiled).toThrow(PlotwrightError);
    expect(compiled).toThrow(field);
    expect(compiled).not.toThrow("undefined");
  });
});

describe("prepare", () => {
  it("takes only the settings that differ from the defaults", () => {
    const some = prepare(drawing, {
      paper: PAPER_SIZES.A5,
      hatch: { ...DEFAULT_PREPARE.hatch, spacingMm: 2 },
    });
    const all = prepare(drawing, {
      ...DEFAULT_PREPARE,
      paper: PAPER_SIZES.A5,
      hatch: { spacingMm: 2, angleDeg: 45, cross: false },
    });
    expect(some).toEqual(all);
  });
});
