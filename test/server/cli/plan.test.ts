import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { beforeEach, describe, expect, it } from "vitest";
import type { PlanReport } from "../../../server/cli/plan/plan.js";
import { VirtualBoard, type Clock } from "../../../src/index.js";
import { IS_FULL } from "../../support/runs/full-run.js";
import { cli, type CliRun } from "../../support/processes/command-line.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SAMPLES = fileURLToPath(new URL("../../../samples/", import.meta.url));
const samples = readdirSync(SAMPLES).filter((name) => name.endsWith(".svg"));
const sample = (name: string): string => join(SAMPLES, name);
const [firstSample = ""] = samples;

const CONTRACT = [
  ...["widthMm", "heightMm", "scale"],
  ...["strokes", "points", "blocks", "commands", "drawMm", "travelMm", "travelMmUnordered", "penLifts"],
  ...[
    "durationS",
    "maxSpeed",
    "maxAccel",
    "importMs",
    "prepareMs",
    "orderMs",
    "planMs",
    "compileMs",
    "warnings",
  ],
  ...["box", "size", "paper", "machine", "times", "layers", "copies"],
];
const OBJECTS = ["box", "size", "paper", "machine", "times"];

let dir: string;
beforeEach(() => {
  dir = folderOfTest();
});

const stoppedClock: Clock = { nowS: () => 0, after: () => () => undefined };

/** The board's replies to a list of commands, each finished as soon as it is sent. */
function replay(commands: string, firmware: string): VirtualBoard {
  const board = new VirtualBoard({ clock: stoppedClock, firmware, speed: Infinity, recordLine: false });
  const faults: string[] = [];
  board.onSend((bytes) => {
    const text = new TextDecoder().decode(bytes);
    if (text.includes("!")) faults.push(text);
  });
  for (const line of commands.trimEnd().split("\n")) board.receive(new TextEncoder().encode(`${line}\r`));
  expect(faults).toEqual([]);
  return board;
}

/** One JSON object with exactly the documented keys, and nothing else. */
function expectReport({ code, out, err }: CliRun): void {
  expect([code, err]).toEqual([0, ""]);
  const report = JSON.parse(out) as Record<string, unknown>;
  expect(Object.keys(report)).toEqual(CONTRACT);
  for (const [key, value] of Object.entries(report)) {
    if (key === "warnings" || key === "layers") expect(value).toBeInstanceOf(Array);
    else if (OBJECTS.includes(key)) expect(value).toBeTypeOf("object");
    else expect([key, Number.isFinite(value)]).toEqual([key, true]);
  }
  expect(report["strokes"]).toBeGreaterThan(0);
  expect(report["durationS"]).toBeGreaterThan(0.5);
}

describe("plotwright plan", () => {
  it("prints one JSON object with exactly the documented keys, and nothing else", async () => {
    expectReport(await cli("plan", sample(firstSample), "--json"));
  });

  const LAYERS = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="60mm" height="40mm" viewBox="0 0 60 40" stroke="black" fill="none"><g inkscape:groupmode="layer" id="l1" inkscape:label="Sky"><path d="M10 10h40"/><path d="M10 20h40"/></g><g inkscape:groupmode="layer" id="l2" inkscape:label="Sea"><path d="M10 30h20"/></g></svg>`;

  it("tells layers, pens, and time by layer and by what the machine does", async () => {
    const file = join(dir, "layers.svg");
    writeFileSync(file, LAYERS);
    const flags = [
      "--pen",
      "Sky=Blue",
      "Sea=Green",
      "--machine",
      "axidraw-v3-a3",
      "--paper",
      "A5",
      "--copies",
      "3",
    ];
    const report = JSON.parse((await cli("plan", file, "--json", ...flags)).out) as PlanReport;
    expect(report).toMatchObject({
      box: { xMm: 10, yMm: 10, widthMm: 40, heightMm: 20 },
      size: { widthMm: 40, heightMm: 20, scaleX: 1, scaleY: 1, turnedDeg: 0 },
      paper: { widthMm: 210, heightMm: 148 },
      machine: { id: "axidraw-v3-a3", name: "AxiDraw V3/A3", widthMm: 430, heightMm: 297 },
      layers: [
        { id: "l1", name: "Sky", pen: "Blue", strokes: 2, drawMm: 80 },
        { id: "l2", name: "Sea", pen: "Green", strokes: 1, drawMm: 20 },
      ],
      copies: 3,
    });
    const { times, layers, durationS } = report;
    expect(times.drawS + times.travelS + times.penS).toBeCloseTo(durationS, 1);
    for (const { drawS, travelS, penS, durationS: whole } of layers) {
      expect(drawS + travelS + penS).toBeCloseTo(whole, 2);
      expect(Math.min(drawS, travelS, penS)).toBeGreaterThan(0);
    }
    const { out } = await cli("plan", file, ...flags);
    expect(out).toMatch(
      /^drawn 40 × 20 mm, 100 %, on paper of 210 × 148 mm\nfor the AxiDraw V3\/A3 \(axidraw-v3-a3\)\n/,
    );
    expect(out).toMatch(
      /\ntakes 00:00:\d\d: 00:00:\d\d drawing, 00:00:\d\d travel, 00:00:\d\d pen; up to \d+ mm\/s\n/,
    );
    expect(out).toMatch(
      /\nlayer Sky, pen Blue: 00:00:\d\d, 2 strokes, 0\.08 m\nlayer Sea, pen Green: 00:00:\d\d, 1 stroke, 0\.02 m\n3 copies: 00:00:\d\d, without the changes of paper\n/,
    );
    expect((await cli("plan", file, "--copies", "0")).out).toContain("\nendless copies, until you stop it\n");
  });

  it("names the model and --machine if the drawing is beyond the machine", async () => {
    const file = join(dir, "wide.svg");
    writeFileSync(
      file,
      `<svg xmlns="http://www.w3.org/2000/svg" width="400mm" height="200mm" viewBox="0 0 400 200" stroke="black"><path d="M5 5h390"/></svg>`,
    );
    const { code, err } = await cli("plan", file, "--paper", "A3");
    expect([code, err]).toEqual([
      3,
      expect.stringMatching(/but AxiDraw V3 can only go from \(0, 0\) to \(300, 218\) mm: .*--machine/),
    ]);
    expect((await cli("plan", file, "--paper", "A3", "--machine", "axidraw-v3-a3")).code).toBe(0);
  });

  it("writes commands that take the board as long as planned, and bring it back home", async () => {
    const generations = ["2.5.3", "2.8.1", "3.0.3"];
    const dash = join(dir, "dash.svg");
    writeFileSync(
      dash,
      `<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="20mm"><path d="M5 5h9" stroke="#000"/></svg>`,
    );
    for (const [index, name] of [dash, ...samples.map(sample)].entries()) {
      for (const firmware of IS_FULL ? generations : [generations[index % 3]]) {
        const ebb = join(dir, "commands.txt");
        const run = await cli("plan", name, "--json", "--commands", ebb, "--firmware", firmware);
        expectReport(run);
        const { durationS } = JSON.parse(run.out) as { durationS: number };
        const board = replay(readFileSync(ebb, "utf8"), firmware);
        const ratio = board.statistics().busyS / durationS;
        expect([name, firmware, Math.abs(ratio - 1) < 0.002 || ratio]).toEqual([name, firmware, true]);
        const { xMm, yMm, penUp, motorsOn } = board.state();
        expect([Math.hypot(xMm, yMm) < 0.02, penUp, motorsOn]).toEqual([true, true, false]);
      }
    }
  });

  it("says which px per inch make the page a paper, and reads the file with them", async () => {
    const file = join(dir, "a4.svg");
    writeFileSync(
      file,
      `<svg xmlns="http://www.w3.org/2000/svg" width="2480" height="3508"><path d="M300 300H1500" stroke="#000"/></svg>`,
    );
    const guessed = await cli("plan", file);
    expect(guessed.out).toContain("--px-per-inch 300 gives A4");
    const { code, out } = await cli("plan", file, "--px-per-inch", "300");
    expect([code, out.split("\n")[0]]).toEqual([
      0,
      "drawn 0 × 101.6 mm, 100 %, turned by 90°, on paper of 297 × 210 mm",
    ]);
    expect(out).not.toContain("note:");
    const wrong = await cli("plan", file, "--px-per-inch", "0");
    expect([wrong.code, wrong.err]).toEqual([2, expect.stringContaining("--px-per-inch")]);
  });

  it("prints the commands to stdout with -, from motors-on to motors-off", async () => {
    const { code, out } = await cli("plan", sample(firstSample), "--commands", "-");
    expect(code).toBe(0);
    const lines = out.trimEnd().split("\n");
    expect(lines.filter((line) => !/^[A-Z0-9]+(,-?\d+)*$/.test(line))).toEqual([]);
    expect(lines.findIndex((line) => line.startsWith("EM,1"))).toBeLessThan(
      lines.findIndex((line) => /^(LM|LT|T3|XM|SM|TD|L3),/.test(line)),
    );
    expect(lines.at(-1)).toBe("EM,0,0");
  });

  it("refuses --json together with --commands -, because both write to stdout", async () => {
    expect(await cli("plan", sample(firstSample), "--json", "--commands", "-")).toMatchObject({
      code: 2,
      out: "",
    });
  });

  it("writes a preview of the paper with travel and speed on it", async () => {
    const out = join(dir, "preview.svg");
    expect((await cli("plan", sample(firstSample), "--preview", out, "--paper", "A5")).code).toBe(0);
    const svg = readFileSync(out, "utf8");
    expect(svg).toContain('width="210mm"');
    expect(svg).not.toMatch(/NaN|Infinity|undefined/);
    expect(new Set(svg.match(/#[0-9a-f]{6}/g)).size).toBeGreaterThan(4);
  });

  it("writes the prepared drawing as SVG and as polylines, which can be plotted again to the same length", async () => {
    const svg = join(dir, "out.svg");
    const strokes = join(dir, "out.json");
    const { code, out } = await cli(
      "plan",
      sample(firstSample),
      "--json",
      "--svg",
      svg,
      "--strokes",
      strokes,
    );
    expect(code).toBe(0);
    const { drawMm } = JSON.parse(out) as { drawMm: number };
    for (const file of [svg, strokes]) {
      const again = await cli("plan", file, "--json", "--no-fit", "--join", "0");
      expect(Math.abs((JSON.parse(again.out) as { drawMm: number }).drawMm - drawMm)).toBeLessThan(
        0.002 * drawMm,
      );
    }
  });

  it("applies the codes in layer names, but draws what is requested by name", async () => {
    const file = join(dir, "coded.svg");
    const layer = (name: string, y: number): string =>
      `<g inkscape:groupmode="layer" inkscape:label="${name}"><path d="M10 ${y}H110" stroke="#000"/></g>`;
    writeFileSync(
      file,
      `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="150mm" height="100mm" viewBox="0 0 150 100">${layer("%off", 20)}${layer("+s5 slow", 40)}</svg>`,
    );
    const report = async (
      ...args: string[]
    ): Promise<{ drawMm: number; durationS: number; strokes: number }> =>
      JSON.parse((await cli("plan", file, "--json", "--no-fit", ...args)).out) as never;
    const slow = await report();
    // 100 mm at 5/110 of 8.6979 inches a second.
    expect([slow.strokes, slow.durationS > 9]).toEqual([1, true]);
    const off = await report("--only", "%off");
    expect([off.strokes, off.durationS < 6]).toEqual([1, true]);
  });

  it("draws only the named layers, and lists them if a name is unknown", async () => {
    const file = join(dir, "layers.svg");
    writeFileSync(
      file,
      `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
         width="100mm" height="100mm" viewBox="0 0 100 100" fill="none" stroke="black">
         <g inkscape:groupmode="layer" inkscape:label="Red pen" id="l1"><path d="M10 10h80"/></g>
         <g inkscape:groupmode="layer" inkscape:label="Blue pen" id="l2"><path d="M10 20h80M10 30h80"/></g>
       </svg>`,
    );
    const strokes = async (...only: string[]): Promise<unknown> => {
      const { out } = await cli(
        "plan",
        file,
        "--json",
        "--join",
        "0",
        ...(only.length > 0 ? ["--only", ...only] : []),
      );
      return (JSON.parse(out) as { strokes: number }).strokes;
    };
    expect(await strokes()).toBe(3);
    expect(await strokes("red PEN")).toBe(1);
    expect(await strokes("l2")).toBe(2);
    expect(await strokes("l1", "Blue pen")).toBe(3);
    const wrong = await cli("plan", file, "--json", "--only", "Green pen");
    expect(wrong).toMatchObject({ code: 2, out: "" });
    expect(wrong.err).toMatch(/no layer "Green pen".*"Red pen", "Blue pen"/);
  });
});

describe("--only", () => {
  const layer = (name: string, y: number, inside = ""): string =>
    `<g inkscape:groupmode="layer" inkscape:label="${name}"><path d="M10 ${y}h80"/>${inside}</g>`;
  /** The names of the layers that are drawn. */
  const drawn = async (content: string, ...only: string[]): Promise<string[]> => {
    const file = join(dir, "numbers.svg");
    writeFileSync(
      file,
      `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
         width="100mm" height="100mm" viewBox="0 0 100 100" fill="none" stroke="black">${content}</svg>`,
    );
    const { out, err } = await cli("plan", file, "--strokes", "-", "--join", "0", "--only", ...only);
    if (out === "") return [err];
    const { layers } = JSON.parse(out) as { layers: { name: string; strokesMm: unknown[] }[] };
    return layers.filter(({ strokesMm }) => strokesMm.length > 0).map(({ name }) => name);
  };
  const NUMBERED =
    layer("1 black", 10) +
    layer("!1+s50 grey", 20) +
    layer("10 red", 30) +
    layer("%1 help", 40) +
    layer("01", 50);

  it("takes all layers whose name begins with a number, as AxiDraw's software does", async () => {
    expect(await drawn(NUMBERED, "1")).toEqual(["1 black", "!1+s50 grey", "01"]);
    expect(await drawn(NUMBERED, "10")).toEqual(["10 red"]);
    expect(await drawn(NUMBERED, "10", "%1 help")).toEqual(["10 red", "%1 help"]);
    expect(await drawn(NUMBERED, "2")).toEqual([expect.stringMatching(/no layer "2"/)]);
  });

  it("takes sublayers by name or number, with all that is in them", async () => {
    const inner = layer("2 leaves", 30, layer("%help", 35) + layer("veins", 40));
    const nested = layer("Plant", 10, layer("stem", 20) + inner) + layer("Pot", 50);
    expect(await drawn(nested, "stem")).toEqual(["stem"]);
    expect(await drawn(nested, "2")).toEqual(["2 leaves", "veins"]);
    expect(await drawn(nested, "Pot", "VEINS")).toEqual(["veins", "Pot"]);
    expect(await drawn(nested, "Plant")).toEqual(["Plant"]);
  });
});

describe("the size on the paper", () => {
  /** A line of `mm` across a page of 100 × 50 mm, or of another size. */
  const line = (mm: number, page = 'width="100mm" height="50mm" viewBox="0 0 100 50"'): string => {
    const path = join(dir, `line-${mm}.svg`);
    writeFileSync(
      path,
      `<svg xmlns="http://www.w3.org/2000/svg" ${page} stroke="#000"><path d="M0 10h${mm}v20"/></svg>`,
    );
    return path;
  };
  const PORTRAIT = 'width="21cm" height="29.7cm" viewBox="0 0 210 297"';
  /** As vpype writes it. */
  const VPYPE = 'width="10.0cm" height="5.0cm" viewBox="0.0 0.0 377.952755905 188.976377953"';
  /** The first line, without the size of the paper at its end. */
  const drawnWords = async (...args: string[]): Promise<string> => {
    const { code, out, err } = await cli("plan", ...args);
    expect([code, err]).toEqual([0, ""]);
    const [, words] = /^(.*), on paper of [\d.]+ × [\d.]+ mm\n/.exec(out) ?? [];
    return words ?? out;
  };

  it.each<[string, number, string | undefined, string[], string]>([
    ["true if the page fits", 100, undefined, [], "drawn 100 × 20 mm, 100 %"],
    ["true, and past the margins", 100, undefined, ["--no-fit"], "drawn 100 × 20 mm, 100 %"],
    ["fitted if asked for", 100, undefined, ["--fit"], "drawn 267 × 53.4 mm, 267 %"],
    ["fitted if the page does not fit", 100, undefined, ["--paper", "A6"], "drawn 100 × 20 mm, 100 %"],
    ["fitted to a smaller paper", 100, undefined, ["--paper", "90x90mm"], "drawn 60 × 12 mm, 60 %"],
    ["kept after vpype", 300, VPYPE, [], "drawn 79.4 × 5.3 mm, 100 %"],
    ["stretched", 100, undefined, ["--place", "10,10,50,20"], "drawn 50 × 20 mm, 50 × 100 %"],
    ["true, and turned", 190, PORTRAIT, [], "drawn 20 × 190 mm, 100 %, turned by 90°"],
    [
      "true, and turned with --no-fit too",
      190,
      PORTRAIT,
      ["--no-fit"],
      "drawn 20 × 190 mm, 100 %, turned by 90°",
    ],
    ["not turned against the user", 190, PORTRAIT, ["--rotate", "0"], "drawn 267 × 28.1 mm, 141 %"],
    ["fitted without a size in the file", 100, 'viewBox="0 0 100 50"', [], "drawn 267 × 53.4 mm, 1009 %"],
    [
      "cut at the margins if asked for",
      100,
      undefined,
      ["--clip", "--margin", "5"],
      "drawn 95 × 20 mm, 100 %",
    ],
  ])("is %s", async (_what, mm, page, args, words) => {
    expect(await drawnWords(line(mm, page), ...args)).toBe(words);
  });

  it("is in the report, and on stderr if stdout has other data", async () => {
    const { out } = await cli("plan", line(100), "--json", "--fit");
    expect(JSON.parse(out)).toMatchObject({ widthMm: 267, heightMm: 53.4, scale: 2.67 });
    const { out: commands, err } = await cli("plan", line(100), "--fit", "--commands", "-");
    expect([commands.includes("drawn"), err]).toEqual([false, "drawn 267 × 53.4 mm, 267 %\n"]);
  });

  it("is not drawn outside the paper without a choice, in any way of placing, and each choice named helps", async () => {
    const hatched = join(dir, "hatched.svg");
    writeFileSync(
      hatched,
      '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 100 50"><path d="M0 0H330V40H0z"/></svg>',
    );
    const wide = line(330);
    for (const args of [
      [wide],
      [wide, "--no-fit"],
      [wide, "--rotate", "180"],
      [line(100), "--place", "250,10"],
      [line(100), "--place", "10,195"],
      [line(100), "--place", "10,10,600"],
      [line(100), "--place=-20,10"],
      [hatched, "--hatch", "3", "--no-outline-fills"],
    ]) {
      const run = await cli("plan", ...args, "--json");
      expect([args, run.code, run.out]).toEqual([args, 3, ""]);
      expect(run.err).toMatch(/leaves the paper of 297 × 210 mm: .* mm over its .* edge.*--outside/);
      const choices = Array.from(run.err.matchAll(/\b(cut|move|fit|allow) \(/g), ([, mode]) => mode);
      expect(choices.length).toBeGreaterThan(0);
      for (const mode of choices) {
        const chosen = await cli("plan", ...args, "--outside", mode, "--json");
        expect([args, mode, chosen.code]).toEqual([args, mode, 0]);
      }
    }
    const { err } = await cli("plan", line(330));
    expect(err).toContain("1 stroke reaches up to 33 mm over its right edge.");
  });

  it("is what was chosen for a drawing that leaves the paper", async () => {
    const drawnWith = (mode: string, file: string, ...args: string[]) =>
      drawnWords(file, "--outside", mode, "--paper", "A5", ...args);
    const page = 'width="200mm" height="100mm" viewBox="0 0 200 100"';
    expect(await drawnWith("cut", line(330, page))).toBe("drawn 210.5 × 0 mm, 100 %");
    expect(await drawnWith("fit", line(330, page))).toBe("drawn 180 × 10.9 mm, 55 %");
    expect(await drawnWith("allow", line(250, page))).toBe("drawn 250 × 20 mm, 100 %");
    expect(await drawnWith("move", line(100), "--place", "150,140")).toBe("drawn 100 × 20 mm, 100 %");
    const large = await cli("plan", line(330, page), "--outside", "move", "--paper", "A5");
    expect([large.code, large.err]).toEqual([3, expect.not.stringContaining("move (")]);
  });
});
