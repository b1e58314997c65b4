/** G-code for other senders: what is said before each layer, and where it waits for another pen. */
import { describe, expect, it } from "vitest";
import {
  DEFAULT_PREPARE,
  MACHINES,
  importSvg,
  planJob,
  prepare,
  strokesOf,
  type StrokeSet,
} from "../../../../src/index.js";
import { NO_PENS, penStopsOf, type PenSetup, type StrokeLayer } from "../../../../src/internal.js";
import { FACES } from "../../../../src/drivers/grbl/virtual/faces.js";
import { VirtualGrbl } from "../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { GRBL } from "../../../support/machines/machine.js";
import { machineWith } from "../../../support/plots/grbl-plotter.js";

const STROKES: StrokeSet = {
  xy: Float64Array.of(10, 10, 20, 10, 10, 20, 20, 20, 10, 30, 20, 30),
  offsets: Uint32Array.of(0, 2, 4, 6),
  layer: Uint16Array.of(0, 1, 2),
  layers: [
    { id: "sky", name: "sky", color: "#0000ff" },
    { id: "sea", name: "sea", color: "#0000aa" },
    { id: "sun", name: "sun", color: "#ffcc00" },
  ],
};
const CENTRED = { widthMm: 0.3, offsetXMm: 0, offsetYMm: 0 };
const PENS = {
  pens: [
    { id: "blue", name: "Fineliner 0.3", color: "#1122ff", ...CENTRED },
    { id: "gold", name: "Gelly Roll", color: null, ...CENTRED },
  ],
  layerPens: { sky: "blue", sea: "blue", sun: "gold" },
} satisfies Partial<PenSetup>;

const linesWith = (pens: Partial<PenSetup>): string[] =>
  planJob({ strokes: STROKES }, { motion: { travel: { speedMmPerS: 150 } }, ...pens }, GRBL).lines();

/** Comments and waits, each with the line after it. */
const saidIn = (lines: readonly string[]): string[] =>
  lines.flatMap((line, i) => (i > 0 && /^(\(|M0|G1X0Y0)/.test(line) ? [line] : []));

describe("the G-code of a drawing with several pens", () => {
  it("waits at home for each pen, and names it and its layers", () => {
    expect(saidIn(linesWith(PENS))).toEqual([
      "(Put in the pen Fineliner 0.3, #1122ff)",
      "G1X0Y0F9000",
      "M0",
      "(Layer sky, pen Fineliner 0.3, #1122ff: pen down at 30 %, up at 60 %)",
      "(Layer sea, pen Fineliner 0.3, #1122ff: pen down at 30 %, up at 60 %)",
      "(Put in the pen Gelly Roll, #ffcc00)",
      "G1X0Y0F9000",
      "M0",
      "(Layer sun, pen Gelly Roll, #ffcc00: pen down at 30 %, up at 60 %)",
      "G1X0Y0F9000",
    ]);
  });

  it("waits with the pen up, and goes on where the next layer begins", () => {
    const lines = linesWith(PENS);
    const wait = lines.lastIndexOf("M0");
    expect(lines.slice(wait - 4, wait + 3)).toEqual([
      "G1Z5F3000",
      "G4P0.1",
      "(Put in the pen Gelly Roll, #ffcc00)",
      "G1X0Y0F9000",
      "M0",
      "(Layer sun, pen Gelly Roll, #ffcc00: pen down at 30 %, up at 60 %)",
      "G1X10Y30F9000",
    ]);
  });

  it("waits with the pen up also if a layer begins where the one before it ends, and comes back", () => {
    const lineUp = { ...STROKES, xy: Float64Array.of(0, 0, 20, 10, 20, 10, 20, 20, 20, 20, 20, 30) };
    const job = planJob(
      { strokes: lineUp },
      { motion: { travel: { speedMmPerS: 150 } }, penStops: "layers" },
      GRBL,
    );
    const lines = job.lines();
    const wait = lines.lastIndexOf("M0");
    expect(lines.slice(wait - 4, wait + 5)).toEqual([
      "G1Z5F3000",
      "G4P0.1",
      "(Put in the pen for this layer, #ffcc00)",
      "G1X0Y0F9000",
      "M0",
      "G1X20Y20F9000",
      "(Layer sun, #ffcc00: pen down at 30 %, up at 60 %)",
      "G1Z0F3000",
      "G4P0.1",
    ]);
    expect(lines.slice(2, 4)).toEqual(["(Layer sky, #0000ff: pen down at 30 %, up at 60 %)", "G1Z0F3000"]);
  });

  it("waits before each layer, or nowhere, as the settings say", () => {
    const waits = (pens: Partial<PenSetup>) => linesWith(pens).filter((line) => line === "M0").length;
    expect(waits({ ...PENS, penStops: "layers" })).toBe(3);
    expect(waits({ ...PENS, penStops: "never" })).toBe(0);
    expect(saidIn(linesWith({ penStops: "layers" })).slice(1, 3)).toEqual([
      "(Put in the pen for this layer, #0000aa)",
      "G1X0Y0F9000",
    ]);
  });
});

describe("the G-code of a drawing with one pen", () => {
  const GRBLS = MACHINES.filter(({ controller }) => controller?.kind === "grbl");

  it.each(GRBLS)("says for which plotter it is, and where it begins: $id", (machine) => {
    const [head] = planJob({ strokes: STROKES }, {}, machine).lines();
    expect(head).toBe(`(For ${machine.name}: about 1 min. Begins at home.)`);
  });

  it("has no waits", () => {
    expect(saidIn(linesWith({}))).toEqual([
      "(Layer sky, #0000ff: pen down at 30 %, up at 60 %)",
      "(Layer sea, #0000aa: pen down at 30 %, up at 60 %)",
      "(Layer sun, #ffcc00: pen down at 30 %, up at 60 %)",
      "G1X0Y0F9000",
    ]);
  });
});

/** Where the pen first touches the paper after each wait, mm from home. */
function drawnAfterWaits(lines: readonly string[]): number[][] {
  const found: number[][] = [];
  let at: number[] = [0, 0];
  let waits = false;
  for (const line of lines) {
    const to = /^G[1-3]X([-\d.]+)Y([-\d.]+)/.exec(line);
    if (to) at = [Number(to[1]), Number(to[2])];
    if (line === "M0") waits = true;
    if (!waits || !/^G1Z(-|[0-2](\D|$))/.test(line)) continue;
    found.push(at);
    waits = false;
  }
  return found;
}

const layersOf = (names: string): StrokeLayer[] =>
  [...names].map((name) => ({ id: name, name, color: null }));

/** One stroke of 10 mm for each letter, which names its layer. A dot: "." after it. */
function drawingOf(letters: string, layers: readonly StrokeLayer[]): StrokeSet {
  const each = letters.match(/\w\.?/g) ?? [];
  const lines = each.map((letter, i) => {
    const y = 10 + 5 * i;
    return letter.endsWith(".")
      ? ([[10, y]] as const)
      : ([
          [10, y],
          [20, y],
        ] as const);
  });
  const layer = Uint16Array.from(each, (letter) => layers.findIndex(({ id }) => id === letter[0]));
  return { ...strokesOf(lines), layer, layers };
}

describe("the waits of the G-code are before the strokes at which a plot stops", () => {
  const ab: Partial<PenSetup> = { pens: PENS.pens, layerPens: { a: "blue", b: "gold" } };
  const layers = layersOf("abc");
  it.each([
    ["layers that alternate", "abab", ab, layers, 4],
    ["layers of the same pen", "aabbcc", { ...ab, layerPens: { a: "blue", b: "blue" } }, layers, 0],
    ["a layer without a pen between two of one pen", "aba", { ...ab, layerPens: { a: "blue" } }, layers, 0],
    [
      "a layer that is not drawn",
      "aacc",
      { ...ab, layerPens: { a: "blue", b: "gold", c: "blue" } },
      layers,
      0,
    ],
    ["a wait before the first layer by its name", "ab", {}, [{ ...layers[0], name: "!a" }, layers[1]], 1],
    ["a wait before the second layer by its name", "ab", {}, [layers[0], { ...layers[1], name: "!2 b" }], 1],
    ["each time a layer begins but the first", "abab", { penStops: "layers" }, layers, 3],
    ["every layer", "aabcc", { penStops: "layers" }, layers, 2],
    ["a layer that begins with a dot", "aab.b", ab, layers, 2],
    ["a layer of one dot", "aab.a", ab, layers, 3],
    ["a layer whose wait is switched off", "ab", { ...ab, layerStops: { b: false } }, layers, 1],
  ] satisfies [string, string, Partial<PenSetup>, readonly StrokeLayer[], number][])(
    "%s",
    (_, letters, pens, ofDrawing, count) => {
      const strokes = drawingOf(letters, ofDrawing);
      const starts = penStopsOf(strokes, { ...NO_PENS, ...pens }).map(({ strokeIndex }) => [
        ...strokes.xy.slice(2 * strokes.offsets[strokeIndex]).subarray(0, 2),
      ]);
      expect(starts).toHaveLength(count);
      for (const liftFirst of [true, false]) {
        expect(drawnAfterWaits(planJob({ strokes }, pens, GRBL, { liftFirst }).lines())).toEqual(starts);
      }
    },
  );

  it("also of a layer that is split to take up ink", async () => {
    const drawing = await importSvg(
      `<svg xmlns="http://www.w3.org/2000/svg" width="99mm" height="99mm" viewBox="0 0 99 99" stroke="red">
         <path d="M10 10H60"/><path d="M10 20H60"/><path d="M10 30H60"/></svg>`,
    );
    const { strokes } = prepare(drawing, { ...DEFAULT_PREPARE, fit: false, order: "none", reinkMm: 60 });
    const stops = penStopsOf(strokes, NO_PENS);
    expect(stops).toHaveLength(2);
    const lines = planJob({ strokes }, { pen: { layers: { red: { upPct: 90 } } } }, GRBL).lines();
    expect(drawnAfterWaits(lines)).toEqual(
      stops.map(({ strokeIndex }) => [...strokes.xy.slice(2 * strokes.offsets[strokeIndex]).subarray(0, 2)]),
    );
  });
});

it("goes back to the end of an arc after a wait", () => {
  const arc = Array.from({ length: 13 }, (_, i) => {
    const angle = (i / 24) * Math.PI;
    return [50 + 5 * Math.sin(angle), 50 - 5 * Math.cos(angle)] as const;
  });
  const [x, y] = arc[12];
  const strokes = {
    ...strokesOf([arc, [[x, y] as const, [70, 60]]]),
    layer: Uint16Array.of(0, 1),
    layers: layersOf("ab"),
  };
  const lines = planJob({ strokes }, { penStops: "layers" }, GRBL).lines();
  const moves = lines.slice(0, lines.indexOf("(Put in the pen for this layer)"));
  const lastMove = moves.filter((line) => /X.*Y/.test(line)).at(-1);
  expect(lastMove).toMatch(/^G3X55Y50I/);
  expect(lines[lines.indexOf("M0") + 1]).toBe("G1X55Y50F9000");
});

it("has the height and the speed of each layer's pen", () => {
  const lines = planJob(
    { strokes: STROKES },
    {
      ...PENS,
      pen: { layers: { sun: { downPct: 20, upPct: 70 } } },
      motion: { layers: { sun: { speedMmPerS: 12 } } },
    },
    GRBL,
  ).lines();
  const sun = lines.indexOf("(Layer sun, pen Gelly Roll, #ffcc00: pen down at 20 %, up at 70 %)");
  expect(lines.slice(sun + 1, sun + 7)).toEqual([
    "G1X10Y30F9000",
    "G4P0",
    "G1Z-1.667F3000",
    "G4P0.1",
    "G1X20Y30F720",
    "G4P0",
  ]);
});

it("has only lines that each Grbl takes, whatever layers and pens are called", () => {
  const name = "!7 Sch\u00f6n (rot); fast! \u2028?~\n\x18$X " + "very long ".repeat(20);
  const strokes = { ...STROKES, layers: STROKES.layers.map((layer) => ({ ...layer, name })) };
  const pens = PENS.pens.map((pen) => ({ ...pen, name }));
  const lines = planJob({ strokes }, { ...PENS, pens }, { ...GRBL, name }).lines();
  expect(lines.filter((line) => line.startsWith("(")).length).toBe(7);
  // Grbl 0.9 takes no comment after a semicolon, and some of its builds no line of 70 characters.
  expect(lines.filter((line) => !/^[\x20-\x7e]{1,69}$/.test(line) || /[?!~;]/.test(line))).toEqual([]);
  expect(lines.filter((line) => /[()]/.test(line) && !/^\([^()]+\)$/.test(line))).toEqual([]);
  expect(lines[0]).toMatch(/: about 1 min\. Begins at home\.\)$/);
  expect(lines).toContainEqual(expect.stringMatching(/^\(Layer 7.*: pen down at 30 %, up at 60 %\)$/));
});

/** Sends the lines as the simplest sender does: each after the answer to the one before it. Returns the answers and the lines at which its user pressed resume. */
async function sendTo(board: VirtualGrbl, world: ManualClock, lines: readonly string[]) {
  const line = board.transport();
  const answers: string[] = [];
  const resumed: string[] = [];
  line.onData((bytes) => {
    const text = new TextDecoder().decode(bytes);
    answers.push(...text.split("\r\n").filter((one) => /^(ok|error)/.test(one)));
  });
  for (const [i, text] of lines.entries()) {
    await line.write(new TextEncoder().encode(`${text}\n`));
    for (let tries = 0; answers.length <= i && tries < 600; tries++) {
      if (board.state().state === "Hold:0") {
        resumed.push(text);
        await line.write(new TextEncoder().encode("~"));
      }
      await world.advance(0.1);
    }
  }
  return { answers, resumed };
}

it.each(FACES)("is taken by a %s from any sender, and draws all of it", async (face) => {
  const machine = machineWith({ face });
  const world = new ManualClock();
  const board = new VirtualGrbl({ clock: world, speed: 1, machine }, { face });
  const lines = planJob({ strokes: STROKES }, PENS, machine, { liftFirst: true }).lines();
  const { answers, resumed } = await sendTo(board, world, lines);
  expect(answers).toEqual(lines.map(() => "ok"));
  expect(resumed).toEqual(["M0", "M0"]);
  const drawn = board.drawn().flatMap(({ penDown, xy }) => (penDown && xy.length > 2 ? [[...xy]] : []));
  expect(drawn).toEqual([
    [10, 10, 20, 10],
    [10, 20, 20, 20],
    [10, 30, 20, 30],
  ]);
  expect(board.state()).toMatchObject({ state: "Idle", penUp: true, xMm: 0, yMm: 0 });
  // What other programs write is refused by version 0.9.
  const { answers: toOther } = await sendTo(board, world, ["; a comment"]);
  expect(toOther).toEqual([face === "0.9" ? "error: Invalid gcode ID:1" : "ok"]);
  board.close();
});
