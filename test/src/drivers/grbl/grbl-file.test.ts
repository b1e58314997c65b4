/** G-code for other senders: what is said before each layer, and where it waits for another pen. */
import { describe, expect, it } from "vitest";
import { MACHINES, planJob, type StrokeSet } from "../../../../src/index.js";
import type { PenSetup } from "../../../../src/internal.js";
import { GRBL } from "../../../support/machines/machine.js";

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
const PENS: Partial<PenSetup> = {
  pens: [
    { id: "blue", name: "Fineliner 0.3", color: "#1122ff", ...CENTRED },
    { id: "gold", name: "Gelly Roll", color: null, ...CENTRED },
  ],
  layerPens: { sky: "blue", sea: "blue", sun: "gold" },
};

const linesWith = (pens: Partial<PenSetup>): string[] =>
  planJob({ strokes: STROKES }, { motion: { travel: { speedMmPerS: 150 } }, ...pens }, GRBL).lines();

/** Comments and waits, each with the line after it. */
const saidIn = (lines: readonly string[]): string[] =>
  lines.flatMap((line, i) => (i > 0 && /^(;|M0|G1X0Y0)/.test(line) ? [line] : []));

describe("the G-code of a drawing with several pens", () => {
  it("waits at home for each pen, and names it and its layers", () => {
    expect(saidIn(linesWith(PENS))).toEqual([
      "; Put in the pen Fineliner 0.3, #1122ff",
      "G1X0Y0F9000",
      "M0",
      "; Layer sky, pen Fineliner 0.3, #1122ff: pen down at 30 %, up at 60 %",
      "; Layer sea, pen Fineliner 0.3, #1122ff: pen down at 30 %, up at 60 %",
      "; Put in the pen Gelly Roll, #ffcc00",
      "G1X0Y0F9000",
      "M0",
      "; Layer sun, pen Gelly Roll, #ffcc00: pen down at 30 %, up at 60 %",
      "G1X0Y0F9000",
    ]);
  });

  it("waits with the pen up, and goes on where the next layer begins", () => {
    const lines = linesWith(PENS);
    const wait = lines.lastIndexOf("M0");
    expect(lines.slice(wait - 4, wait + 3)).toEqual([
      "G1Z5F3000",
      "G4P0.1",
      "; Put in the pen Gelly Roll, #ffcc00",
      "G1X0Y0F9000",
      "M0",
      "; Layer sun, pen Gelly Roll, #ffcc00: pen down at 30 %, up at 60 %",
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
      "; Put in the pen for this layer, #ffcc00",
      "G1X0Y0F9000",
      "M0",
      "G1X20Y20F9000",
      "; Layer sun, #ffcc00: pen down at 30 %, up at 60 %",
      "G1Z0F3000",
      "G4P0.1",
    ]);
    expect(lines.slice(2, 4)).toEqual(["; Layer sky, #0000ff: pen down at 30 %, up at 60 %", "G1Z0F3000"]);
  });

  it("waits before each layer, or nowhere, as the settings say", () => {
    const waits = (pens: Partial<PenSetup>) => linesWith(pens).filter((line) => line === "M0").length;
    expect(waits({ ...PENS, penStops: "layers" })).toBe(3);
    expect(waits({ ...PENS, penStops: "never" })).toBe(0);
    expect(saidIn(linesWith({ penStops: "layers" })).slice(1, 3)).toEqual([
      "; Put in the pen for this layer, #0000aa",
      "G1X0Y0F9000",
    ]);
  });
});

describe("the G-code of a drawing with one pen", () => {
  const GRBLS = MACHINES.filter(({ controller }) => controller?.kind === "grbl");

  it.each(GRBLS)("says for which plotter it is, and where it begins: $id", (machine) => {
    const [head] = planJob({ strokes: STROKES }, {}, machine).lines();
    expect(head).toBe(`; For ${machine.name}: about 1 min. Begins at home.`);
  });

  it("has no waits", () => {
    expect(saidIn(linesWith({}))).toEqual([
      "; Layer sky, #0000ff: pen down at 30 %, up at 60 %",
      "; Layer sea, #0000aa: pen down at 30 %, up at 60 %",
      "; Layer sun, #ffcc00: pen down at 30 %, up at 60 %",
      "G1X0Y0F9000",
    ]);
  });
});
