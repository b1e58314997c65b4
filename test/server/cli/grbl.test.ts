/** `plan` and `plot` for a machine with a Grbl: its profile is a file. */
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { beforeEach, expect, it } from "vitest";
import { GRBL } from "../../support/machines/machine.js";
import { PlotRecord } from "../../../server/cli/plot/plot-record.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { networkGrbl } from "../../support/plots/network-grbl.js";
import { CaughtIo, cli, cliWith } from "../../support/processes/command-line.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SAMPLE = join(import.meta.dirname, "../../../samples/whirling-triangles.svg");

let dir: string;
let profile: string;
beforeEach(() => {
  dir = folderOfTest();
  profile = join(dir, "my-grbl.json");
  writeFileSync(profile, JSON.stringify(GRBL));
});

it("plan writes G-code for a Grbl, with the pen up at both ends", async () => {
  const { code, out } = await cli("plan", SAMPLE, "--machine-file", profile, "--commands", "-");
  expect(code).toBe(0);
  const lines = out.trim().split("\n");
  expect(lines.slice(0, 4)).toEqual([
    expect.stringMatching(/^\(For My Grbl: about \d+ min\. /),
    "G21G90G94",
    "G1Z5F3000",
    "G4P0.1",
  ]);
  expect(lines.slice(-2)).toEqual([expect.stringMatching(/^G1X0Y0/), "G4P0"]);
  const moves = lines.filter((line) => !line.startsWith("("));
  expect(moves.filter((line) => !/^G1[XZ][-\d.]+(Y[-\d.]+)?(F[\d.]+)?$|^G4P[\d.]+$/.test(line))).toEqual([
    "G21G90G94",
  ]);
  expect(lines.filter((line) => line.startsWith("G1Z0")).length).toBe(
    lines.filter((line) => line.startsWith("G1Z5")).length - 1,
  );
});

it("plan names the layers in comments that no Grbl takes for a command", async () => {
  const drawing = join(dir, "layers.svg");
  writeFileSync(
    drawing,
    `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="50mm" height="50mm" viewBox="0 0 50 50" fill="none" stroke="#aa0000">
      <g inkscape:groupmode="layer" inkscape:label="1 Äste! (oben)?"><path d="M5 5h9"/><path d="M5 9h9"/></g>
      <g inkscape:groupmode="layer" inkscape:label="2 ${"long ".repeat(30)}"><path d="M5 25h9"/></g></svg>`,
  );
  const { code, out } = await cli("plan", drawing, "--machine-file", profile, "--commands", "-");
  expect(code).toBe(0);
  const lines = out.trim().split("\n");
  const comments = lines.filter((line) => line.startsWith("(")).slice(1);
  expect(comments).toEqual([
    "(Layer 1 _ste_ _oben__, #aa0000: pen down at 30 %, up at 60 %)",
    expect.stringMatching(/^\(Layer 2 (long ?)+, #aa0000: pen down at 30 %, up at 60 %\)$/),
  ]);
  expect(comments.filter((line) => /[?!~]|[^ -\u007e]/.test(line) || line.length > 69)).toEqual([]);
  // Each is before the travel to its layer.
  const of = (text: RegExp): number => lines.findIndex((line) => text.test(line));
  expect(of(/Layer 2/)).toBeGreaterThan(lines.lastIndexOf("G1Z0F3000", of(/Layer 2/)));
  expect(lines.slice(of(/Layer 2/) + 1).filter((line) => line === "G1Z0F3000")).toHaveLength(1);
});

it("plot draws on a virtual Grbl", async () => {
  const options = ["--machine-file", profile, "--device", "virtual", "--virtual-speed", "300", "--data", dir];
  const { code, err } = await cli("plot", SAMPLE, ...options);
  expect({ code, err }).toEqual({
    code: 0,
    err: expect.stringMatching(
      /^whirling-triangles\.svg: drawn [^\n]*, 100 %\nPlotting whirling-triangles\.svg\.\n(?:\d+ % [^\n]*\n)*Done: whirling-triangles\.svg, after/,
    ) as string,
  });
});

it.each([
  ["a Grbl 0.9", { face: "0.9" }],
  ["a FluidNC", { face: "FluidNC" }],
  ["a DrawCore", { face: "DrawCore" }],
  ["a grblHAL", { face: "grblHAL" }],
  ["a Grbl that reports in inches", { settings: { 13: 1 } }],
  ["a Grbl that reports work positions", { settings: { 10: 0 } }],
  ["a Grbl that reports work positions and buffers", { settings: { 10: 2 } }],
  ["a Grbl that reports machine positions and buffers", { settings: { 10: 3 } }],
] as const)("plot draws on the network with %s", async (_, options) => {
  const grbl = await networkGrbl(options, 50);
  const drawing = join(dir, "line.svg");
  writeFileSync(
    drawing,
    '<svg xmlns="http://www.w3.org/2000/svg" width="80mm" height="50mm" viewBox="0 0 80 50" fill="none" stroke="#000"><path d="M10 10H60V40"/></svg>',
  );
  try {
    const own = ["--machine-file", profile, "--device", grbl.device, "--virtual-speed", "50", "--data", dir];
    expect(await cli("plot", drawing, ...own)).toMatchObject({ code: 0 });
    const drawn = grbl.board.drawn().filter(({ penDown, xy }) => penDown && xy.length > 2);
    expect(drawn.map(({ xy }) => [...xy])).toEqual([[10, 10, 60, 10, 60, 40]]);
    expect(grbl.board.state()).toMatchObject({ penUp: true, lostCount: 0 });
  } finally {
    await grbl.close();
  }
});

it("plot resumes with a Z axis of unknown height only when a person has brought it back, and says to where", async () => {
  const drawing = join(dir, "line.svg");
  writeFileSync(
    drawing,
    '<svg xmlns="http://www.w3.org/2000/svg" width="80mm" height="50mm" viewBox="0 0 80 50" fill="none" stroke="#000"><path d="M10 10H60V40"/></svg>',
  );
  const grbl = await networkGrbl({}, 50);
  const record = new PlotRecord(dir, grbl.device);
  const settings = { ...DEFAULT_PLOT_SETTINGS, machine: GRBL.id, customMachine: GRBL };
  record.begin(drawing, { name: "line.svg", settings, only: undefined });
  record.save({ place: { stroke: 0, alongMm: 20 }, xMm: 30, yMm: 10, penUp: false, elapsedS: 1 }, 0.3);
  const plot = (io: CaughtIo) => cliWith(io, "plot", "--resume", "--device", grbl.device, "--data", dir);
  try {
    const alone = new CaughtIo();
    alone.hasKeyboard = false;
    expect(await plot(alone)).toMatchObject({
      code: 2,
      err: expect.stringMatching(/does not know the height of its pen.* turn its Z axis by hand/) as string,
    });
    expect(grbl.board.drawn().filter(({ xy }) => xy.length > 2)).toEqual([]);
    const io = new CaughtIo();
    const plotted = plot(io);
    await expect
      .poll(() => io.errText)
      .toMatch(/lost its position.* how high its pen is: .*turn its Z axis by hand.* Enter resumes/);
    io.line();
    expect((await plotted).code).toBe(0);
  } finally {
    await grbl.close();
  }
});
