import { describe, expect, it } from "vitest";
import type { Drawing } from "../../../../src/drawing/drawing.js";
import { importDrawing } from "../../../../src/import/registry.js";
import { prepare } from "../../../../src/prepare/prepare.js";
import { codes, pointsOf, shapesOf } from "../../../support/import/shapes.js";

const ETX = "\u0003";
const hpgl = (text: string): Promise<Drawing> => importDrawing("a.plt", text);
const shapes = async (text: string): Promise<string[]> => shapesOf(await hpgl(text));
const LINE = "SP1;PU0,0;PD1000,0;PU;";
/** Its sides, in mm. */
const sidesOf = (drawing: Drawing, shape = 0): number[] => {
  const points = pointsOf(drawing, shape);
  return points.slice(1).map(([x, y], i) => Math.hypot(x - points[i][0], y - points[i][1]));
};

describe("texts in HPGL", () => {
  it.each([
    ["a comment", `IN;CO "PD4000,4000";${LINE}`],
    ["a comment with quotes in it", `IN;CO "say ""PD4000,4000"" now"${LINE}`],
    ["a comment without an end", `IN;CO "PD4000,4000"${LINE}`],
    ["a comment without quotes", `IN;CO PD4000,4000 PU;${LINE}`],
    ["a comment whose quote is not closed", `IN;CO "PD4000,4000 PU;${LINE}`],
    ["a comment of several lines", `IN;CO "PD4000,4000;\nPD0,0;PU;"${LINE}`],
    ["the name of a plot and a message", `IN;BP5,1,1,"PD4000,4000";${LINE}MG"PD8000,0";`],
    ["several names of a plot", `BP1,"PD9,9;PU",2,"PD7,7"IN;${LINE}`],
    ["a stored label", `IN;BLPD4000,4000PU0,0;${ETX}${LINE}`],
    ["a stored label with its own terminator", `IN;DT#;BLPD4000,4000PU0,0;#${LINE}`],
    ["a text for the display", `IN;WDPD4000,4000;PU0,0;${ETX}${LINE}`],
    ["a text that is written", `IN;WR"PD4000,4000";${LINE}`],
    ["strings of an unknown command of the plotter", `IN;EN3,"PD4000,4000;";${LINE}`],
    ["a symbol that looks like a command", `IN;SMP;SM;${LINE}`],
    ["settings of the port", `\u001b.I81;;17:\u001b.N;19:\u001b.(IN;${LINE}\u001b.)`],
    [
      "a job for a printer",
      `\u001b%-12345X@PJL SET PD4000\r\n@PJL ENTER LANGUAGE=HPGL2\r\n\u001b%0BIN;${LINE}`,
    ],
    ["the printer's own language", `\u001bE\u001b&l2APD4000,4000\u001b%-1BIN;${LINE}\u001b%0APD90,90\u001bE`],
    ["the printer's own language in between", `IN;${LINE}\u001b%0A\u001b*p0XPD90,90\u001b%1BPU`],
  ])("are not run as commands: %s", async (_name, text) => {
    const drawing = await hpgl(text);
    expect(shapesOf(drawing)).toEqual(["M0 0L25 0"]);
    expect(codes(drawing)).toEqual([]);
  });

  it.each(["\u0004", "#", " ", "P"])("end at the terminator %j of DT, whatever is in them", async (end) => {
    const label = async (terminator: string, text: string): Promise<string> =>
      (await shapes(`${LINE}${terminator}LB${text}`)).join();
    const [usual] = [await label("", `a;b${ETX}${LINE}`)];
    expect(await label(`DT${end};`, `a;b${end}${LINE}`)).toBe(usual);
    expect(await label(`DT${end},1;`, `a;b${end}${LINE}`)).toBe(usual);
    // IN sets the usual one again.
    expect(await label(`DT${end};IN;`, `a;b${ETX}${LINE}`)).toBe(await label("IN;", `a;b${ETX}${LINE}`));
  });

  it("show their terminator if DT asks for it", async () => {
    expect(await shapes(`${LINE}DT#,0;LBa#`)).toEqual(await shapes(`${LINE}LBa#${ETX}`));
  });

  it("without an end are no longer than their line, and this is said", async () => {
    const drawing = await hpgl(`IN;${LINE}PU0,400;LBhi;\nPU0,800;PD1000,800;PU;`);
    expect(shapesOf(drawing)).toHaveLength(3);
    expect(shapesOf(drawing)[2]).toBe("M0 0L25 0");
    expect(drawing.warnings.map(({ message }) => message)).toEqual([
      expect.stringContaining("LB: its text has no end"),
    ]);
    // Many of them are read in linear time.
    const many = "LBhi;PU0,0;PD9,0;".repeat(20_000);
    expect((await hpgl(`IN;${many}`)).warnings[0]).toMatchObject({ code: "attribute-fault", count: 20_000 });
  });

  it("include a stored label, drawn once for each PB", async () => {
    const [frame, ...labels] = await shapes(
      `IN;SP1;PU0,0;EA4000,4000;PU400,800;BLH${ETX}PB;PU400,800;LBH${ETX}`,
    );
    expect(frame).toMatch(/^M0 100/);
    expect(labels).toHaveLength(2);
    expect(labels[0]).toBe(labels[1]);
  });
});

describe("coordinates of HPGL", () => {
  it("are turned by RO, in the middle of a file", async () => {
    const corner = (deg: number): string => `IN;SP1;PU0,0;PD4000,0;PU;RO${deg};PU0,0;PD4000,2000;PU;`;
    expect(await shapes(corner(90))).toEqual(["M50 100L150 100", "M50 100L0 0"]);
    expect(await shapes(corner(180))).toEqual(["M100 0L200 0", "M100 0L0 50"]);
    expect(await shapes(corner(270))).toEqual(["M0 0L100 0", "M0 0L50 100"]);
    expect((await shapes(`${corner(90)}RO;PU0,0;PD4000,0;`))[2]).toBe("M50 100L150 100");
    expect((await shapes(`${corner(90)}IN;SP1;PU0,0;PD4000,0;`))[2]).toBe("M50 100L150 100");
    expect(codes(await hpgl(corner(90)))).toEqual([]);
    expect(codes(await hpgl(corner(45)))).toEqual(["attribute-fault"]);
  });

  it("turn scaling, arcs and labels too", async () => {
    expect(await shapes("IN;RO90;IP0,0,4000,2000;SC0,10,0,10;SP1;PU0,0;PD10,0,10,10;")).toEqual([
      "M50 100L50 0L0 0",
    ]);
    const arc = pointsOf(await hpgl("IN;RO90;SP1;PU0,0;PD4000,0;AA4000,4000,90;"));
    // From 0, 0 up by 100, then about a point 100 to the left.
    expect(arc.at(-1)!.map((mm) => Math.round(mm * 1e4) / 1e4)).toEqual([0, 0]);
    const turned = await hpgl(`IN;RO90;SP1;PU0,0;EA4000,4000;SI0.4,0.8;PU400,800;LBH${ETX}`);
    const xs = pointsOf(turned, 1).map(([x]) => Math.round(x * 1e4) / 1e4);
    expect([Math.min(...xs), Math.max(...xs)]).toEqual([72, 80]);
  });

  it("are rescaled by IP after SC: two circles of different size", async () => {
    const drawing = await hpgl(
      "IN;IP0,0,2000,2000;SC0,10,0,10;SP1;PU5,5;CI3;IP2500,500,3500,1500;PU5,5;CI3;PU;",
    );
    // The left circle begins at the left edge, 10 mm from the plotter's 0.
    for (const [x, y] of pointsOf(drawing, 0)) expect(Math.hypot(x - 15, y - 15)).toBeCloseTo(15, 4);
    for (const [x, y] of pointsOf(drawing, 1)) expect(Math.hypot(x - 65, y - 15)).toBeCloseTo(7.5, 4);
  });

  it("let P2 follow P1, and return to the usual P1 and P2 by IP alone", async () => {
    const scaled = (corners: string): Promise<string[]> =>
      shapes(`IN;${corners}SC0,10,0,10;SP1;PU0,0;PD10,10;`);
    expect(await scaled("IP0,0,4000,2000;IP1000,500;")).toEqual(["M0 50L100 0"]);
    expect(await scaled("IP0,0,4000,4000;IP;")).toEqual(["M0 250L250 0"]);
    expect(await scaled("IR0,0,50,100;")).toEqual(["M0 250L125 0"]);
  });

  it("say when the scale is a guess, because the file does not place P1 and P2", async () => {
    const warned = async (settings: string): Promise<string[]> =>
      codes(await hpgl(`IN;${settings}SP1;PU0,0;PD10,10;`));
    expect(await warned("SC0,10,0,10;")).toEqual(["page-size"]);
    expect(await warned("IR0,0,50,50;SC0,10,0,10;")).toEqual(["page-size"]);
    expect(await warned("SC0,10,0,10;IP0,0,4000,4000;")).toEqual([]);
    expect(await warned("IP0,0,4000,4000;SC0,10,0,10;IP;")).toEqual(["page-size"]);
    expect(await warned("IP0,0,4000,4000;SC0,10,0,10;")).toEqual([]);
    expect(await warned("SC0,0.1,0,0.1,2;")).toEqual([]);
    expect(await warned("IP;")).toEqual([]);
  });

  const SQUARE = "SP1;PU0,0;PD100,0,100,100,0,100,0,0;PU;";
  it.each([
    ["to the middle", "IP0,0,8000,4000;SC0,100,0,100,1;", 50, 0, 100],
    ["to the left", "IP0,0,8000,4000;SC0,100,0,100,1,0,0;", 0, 0, 100],
    ["to the right", "IP0,0,8000,4000;SC0,100,0,100,1,100,50;", 100, 0, 100],
    ["upwards", "IP0,0,4000,8000;SC0,100,0,100,1,50,25;", 0, 25, 100],
    ["to the middle of the new corners", "SC0,100,0,100,1;IP0,0,4000,8000;", 0, 50, 100],
  ])("are isotropic by SC type 1, moved %s", async (_way, scaling, left, bottom, side) => {
    // The frame is between P1 and P2: 200 × 100 or 100 × 200 mm.
    const drawing = await hpgl(`IN;${scaling}${SQUARE}SC;PU0,0;PD0,0;PU;`);
    const points = pointsOf(drawing, 0);
    const [origin] = pointsOf(drawing, 1);
    const xs = points.map(([x]) => x - origin[0]);
    const ys = points.map(([, y]) => origin[1] - y);
    for (const [values, from] of [
      [xs, left],
      [ys, bottom],
    ] as const) {
      expect(Math.min(...values)).toBeCloseTo(from, 9);
      expect(Math.max(...values)).toBeCloseTo(from + side, 9);
    }
  });

  it("have factors by SC type 2, from P1", async () => {
    expect(await shapes("IN;IP400,800,9,9;SC1,40,2,20,2;SP1;PU1,2;PD11,12;SC;PU0,0;PD0,0")).toEqual([
      "M10 5L20 0",
      "M0 25L0 25",
    ]);
  });

  it("are mirrored by SC and IP", async () => {
    expect(await shapes("IN;IP0,0,4000,4000;SC10,0,0,10;SP1;PU0,0;PD10,10;")).toEqual(["M100 100L0 0"]);
    expect(await shapes("IN;IP4000,0,0,4000;SC0,10,0,10;SP1;PU0,0;PD10,10;")).toEqual(["M100 100L0 0"]);
    const arc = pointsOf(await hpgl("IN;IP4000,0,0,4000;SC0,10,0,10;SP1;PU10,0;PD;AA0,0,90;"));
    expect(arc.at(-1)!.map((mm) => Math.round(mm))).toEqual([100, 0]);
  });

  it("draw ellipses where the scales differ", async () => {
    const drawing = await hpgl("IN;IP0,0,8000,4000;SC0,100,0,100;SP1;PU50,50;CI50;");
    expect([drawing.widthMm, drawing.heightMm].map((mm) => Math.round(mm * 1e4) / 1e4)).toEqual([200, 100]);
  });

  it("report a scale that is none, and draw in plotter units", async () => {
    const drawing = await hpgl("IN;IP0,0,4000,4000;SC5,5,0,10;SP1;PU0,0;PD4000,0;");
    expect(codes(drawing)).toEqual(["attribute-fault"]);
    expect(shapesOf(drawing)).toEqual(["M0 0L100 0"]);
  });

  it("may have exponents, as programs write them", async () => {
    expect(await shapes("IN;SP1;PU0,0;PD1e3,0,1.5E+3,2e-5;PU")).toEqual(["M0 0L25 0L37.5 0"]);
  });

  it("may be a million in one command", { timeout: 60_000 }, async () => {
    const { paths } = await hpgl(`IN;SP1;PU0,0;PD${"1200,3400,".repeat(1_000_000)}0,0;PU`);
    expect([paths.count, paths.coords.length]).toEqual([1, 2 * 1_000_002]);
  });

  it("report numbers that are missing", async () => {
    expect((await hpgl(`IN;${LINE}AA1,2;CI;PU1;`)).warnings.map(({ code, count }) => [code, count])).toEqual([
      ["attribute-fault", 3],
    ]);
  });
});

describe("polygons of HPGL", () => {
  const SIDES = "PD2000,0,2000,2000,0,2000;";

  it("are closed when their edges are drawn", async () => {
    expect(await shapes(`IN;SP1;PU0,0;PM0;${SIDES}PM2;EP;PU;`)).toEqual(["M0 50L50 50L50 0L0 0Z"]);
    expect(await shapes(`IN;SP1;PU0,0;PM;${SIDES}PU;PM2;EP;`)).toEqual(["M0 50L50 50L50 0L0 0Z"]);
  });

  it("have several rings", async () => {
    const drawing = await hpgl(`IN;SP1;PU0,0;PM0;${SIDES}PM1;PU500,500;PD900,500,500,900;PM2;EP;`);
    expect(shapesOf(drawing)).toEqual(["M0 50L50 50L50 0L0 0ZM12.5 37.5L22.5 37.5L12.5 27.5Z"]);
    const circle = await hpgl("IN;SP1;PU1000,1000;PM0;CI1000;PM2;EP;");
    expect([circle.widthMm, circle.heightMm].map((mm) => Math.round(mm * 1e4) / 1e4)).toEqual([50, 50]);
    expect(circle.paths.count).toBe(1);
  });

  it("have edges only where the pen was down", async () => {
    expect(await shapes("IN;SP1;PU0,0;PM0;PD2000,0;PU2000,2000;PD0,2000;PU0,0;PM2;EP;")).toEqual([
      "M0 50L50 50M50 0L0 0",
    ]);
    expect(await shapes("IN;SP1;PU0,0;PM0;PU2000,0,2000,2000;PM2;EP;PD500,0;")).toEqual(["M0 0L12.5 0"]);
  });

  it("are filled areas without edges when they are only filled, wherever the pen was up", async () => {
    for (const sides of [SIDES, "PU2000,0,2000,2000,0,2000;"]) {
      const drawing = await hpgl(`IN;SP2;PU0,0;PM0;${sides}PM2;FP;`);
      expect(shapesOf(drawing)).toEqual(["M0 50L50 50L50 0L0 0Z"]);
      expect([drawing.paths.stroke[0], drawing.paths.fill[0]]).toEqual([-1, 0]);
      expect(drawing.colors).toEqual(["#ff0000"]);
      expect(codes(drawing)).toEqual([]);
    }
  });

  it("leave the pen where they began", async () => {
    expect(await shapes(`IN;SP1;PU400,0;PM0;${SIDES}PM2;PR;PD400,0;`)).toEqual(["M0 0L10 0"]);
  });

  it("are edged and filled again after rectangles and wedges", async () => {
    const drawing = await hpgl("IN;SP1;PU0,0;RA400,800;EP;");
    expect(shapesOf(drawing)).toEqual(["M0 20L10 20L10 0L0 0Z", "M0 20L10 20L10 0L0 0Z"]);
    expect([...drawing.paths.fill]).toEqual([0, -1]);
    expect([...drawing.paths.stroke]).toEqual([-1, 0]);
  });

  it("are reported if they are never ended", async () => {
    expect(codes(await hpgl(`IN;${LINE}PM0;${SIDES}`))).toEqual(["not-supported"]);
    expect(codes(await hpgl(`IN;${LINE}PM0;${SIDES}IN;`))).toEqual(["not-supported"]);
  });

  it("are hatched by FT3 and FT4 with the given distance and angle", async () => {
    const filled = (type: string): Promise<Drawing> =>
      hpgl(`IN;SP1;PU0,0;${type}RA2000,800;PU0,0;EA2000,800;`);
    const lines = async (type: string): Promise<string[]> => shapesOf(await filled(type))[0].split(/(?=M)/);
    // Lines at y = 0, 10 and the top, which belongs to neither.
    expect(await lines("FT3,400;")).toEqual(["M0 20L50 20", "M0 10L50 10"]);
    expect(await lines("FT3,800,90;")).toHaveLength(3);
    expect(await lines("AC200,200;FT4,400;")).toHaveLength(2 + 5);
    expect(codes(await filled("FT4,400;"))).toEqual([]);
    expect((await filled("FT1;")).paths.fill[0]).toBe(0);
    expect(codes(await filled("FT11,1;"))).toEqual(["effect-ignored"]);
  });

  it("fill wedges and draw their edges", async () => {
    const wedge = (command: string) => hpgl(`IN;SP1;PU0,0;${command};`);
    for (const command of ["EW4000,0,90", "WG4000,0,90", "EW-4000,180,90"]) {
      const points = pointsOf(await wedge(command), 0);
      expect(points[0]).toEqual([0, 100]);
      expect(points[1].map((mm) => Math.round(mm * 1e6) / 1e6)).toEqual([100, 100]);
      for (const [x, y] of points.slice(1)) expect(Math.hypot(x, y - 100)).toBeCloseTo(100, 4);
    }
    expect((await wedge("WG4000,0,90")).paths.fill[0]).toBe(0);
    expect((await wedge("EW4000,0,360")).widthMm).toBeCloseTo(200, 4);
    expect(sidesOf(await wedge("EW4000,0,90,45"))).toHaveLength(3);
  });
});

describe("curves of HPGL", () => {
  it("are Béziers by BZ and BR, several in one command", async () => {
    expect(await shapes("IN;SP1;PU0,0;PD;BZ1000,2000,3000,2000,4000,0;PU;")).toEqual([
      "M0 37.5C25 -12.5 75 -12.5 100 37.5",
    ]);
    expect(await shapes("IN;SP1;PU400,0;PD;BR400,0,400,400,0,400,400,0,400,400,0,400;PU;")).toEqual([
      "M0 20C10 20 10 10 0 10C10 10 10 0 0 0",
    ]);
    expect(await shapes("IN;SP1;PU0,0;BZ1000,2000,3000,2000,4000,0;PD4400,0;")).toEqual(["M0 0L10 0"]);
  });

  it("are arcs through three points by AT and RT", async () => {
    for (const arc of ["AT4000,4000,0,8000", "RT4000,4000,0,8000"]) {
      const drawing = await hpgl(`IN;SP1;PU0,0;PD;${arc};PU;`);
      for (const [x, y] of pointsOf(drawing)) expect(Math.hypot(x, y - 100)).toBeCloseTo(100, 4);
      expect(drawing.widthMm).toBeCloseTo(100, 4);
    }
    const clockwise = await hpgl("IN;SP1;PU0,8000;PD;AT4000,4000,0,0;PU;");
    expect(clockwise.widthMm).toBeCloseTo(100, 4);
    const circle = await hpgl("IN;SP1;PU0,0;PD;AT4000,0,0,0;PU;");
    expect([circle.widthMm, circle.heightMm].map((mm) => Math.round(mm * 1e4) / 1e4)).toEqual([100, 100]);
    expect(await shapes("IN;SP1;PU0,0;PD;AT400,0,800,0;PU;")).toEqual(["M0 0L20 0"]);
  });

  it("are polygons with long chords, and smooth with short ones", async () => {
    const triangle = sidesOf(await hpgl("IN;SP1;PU1000,1000;CI500,120;PU;"));
    expect(triangle).toHaveLength(3);
    for (const side of triangle) expect(side).toBeCloseTo(12.5 * Math.sqrt(3), 9);
    expect(sidesOf(await hpgl("IN;SP1;PU4000,0;PD;AA0,0,90,30;"))).toHaveLength(3);
    expect(sidesOf(await hpgl("IN;SP1;PU4000,0;PD;AR-4000,0,90,45;"))).toHaveLength(2);
    // 100 divides 360 into four equal chords.
    expect(sidesOf(await hpgl("IN;SP1;PU0,0;CI500,100;"))).toHaveLength(4);
    for (const smooth of ["CI500;", "CI500,5;", "CI500,10;", "CT1;CI500,1;"])
      expect(sidesOf(await hpgl(`IN;SP1;PU0,0;${smooth}`)).length).toBeGreaterThan(30);
    // A hexagon is 500 (1 - cos 30°) inside its circle.
    expect(sidesOf(await hpgl("IN;SP1;PU0,0;CT1;CI500,66.99;"))).toHaveLength(6);
  });

  it("leave no dot where something begins that is not drawn", async () => {
    expect(await shapes(`IN;${LINE}PU0,400;PD;QX1000,2000;PU;`)).toHaveLength(1);
    // The pen lowered for nothing else is a dot.
    expect(await shapes("IN;SP1;PU0,0;PD;PU400,0;PD;PU;")).toEqual(["M0 0L0 0", "M10 0L10 0"]);
    expect(await shapes("IN;SP1;PU0,0;PD;PA400,0;PU;")).toEqual(["M0 0L10 0"]);
  });
});

describe("symbols and own characters in HPGL", () => {
  it("are drawn at each point, their middle on it, with the pen up or down", async () => {
    const drawing = await hpgl("IN;SP1;SM*;PU1000,1000;PA2000,1000;SM;PU;PU0,0;PD100,0;");
    expect(drawing.paths.count).toBe(3);
    const middles = [0, 1].map((shape) => {
      const points = pointsOf(drawing, shape);
      const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
      return [Math.min(...xs) + Math.max(...xs), Math.min(...ys) + Math.max(...ys)].map((sum) => sum / 2);
    });
    const [origin] = pointsOf(drawing, 2);
    expect(
      middles.map(([x, y]) => [x - origin[0], origin[1] - y].map((mm) => Math.round(mm * 1e6) / 1e6)),
    ).toEqual([
      [25, 25],
      [50, 25],
    ]);
    const line = await shapes("IN;SP1;PU0,0;SM+;PD4000,0,4000,4000;SM;PD0,4000;");
    // One line, whatever stands on its corners.
    expect(line[0]).toMatch(/^M[\d.]+ [\d.]+L[^M]*L[^M]*L[^M]*$/);
    expect(line).toHaveLength(2);
    expect(codes(await importDrawing("a.plt", `IN;${LINE}SM+;PU5,5;`, { text: "none" }))).toEqual([
      "text-not-drawn",
    ]);
  });

  it("are drawn step by step by UC, a quarter of a letter wide and an eighth high", async () => {
    const drawing = await hpgl(
      "IN;SP1;PU0,0;EA4000,4000;SI0.4,0.8;PU400,400;UC0,0,99,4,0,0,8,-99,-2,0,99,0,-4;UC99,1,0;",
    );
    expect(shapesOf(drawing).slice(1)).toEqual(["M10 90L14 90L14 82M12 82L12 86", "M16 90L17 90"]);
  });

  it("are ticks across the axes, of the given length", async () => {
    const ticks = async (commands: string): Promise<string[]> =>
      (await shapes(`IN;IP0,0,4000,2000;SP1;PU0,0;EA4000,2000;PU400,400;${commands}`)).slice(1);
    expect(await ticks("TL2,4;XT;YT;")).toEqual(["M10 42L10 39", "M6 40L12 40"]);
    expect(await ticks("XT;")).toEqual(["M10 40.25L10 39.75"]);
    expect(await ticks("TL10;XT;")).toEqual(["M10 40L10 35"]);
  });
});

describe("line types and windows of HPGL", () => {
  const dashes = async (text: string): Promise<number[][]> =>
    await Promise.all(
      Array.from((await hpgl(text)).paths.dash, async (dash) => [
        ...((await hpgl(text)).dashes[dash]?.lengths ?? []),
      ]),
    );

  it("are dashes of the length that LT gives, in mm or as a share of the distance between P1 and P2", async () => {
    expect(await dashes("IN;SP1;LT2,10,1;PU0,0;PD4000,0;LT;PD0,400;")).toEqual([[5, 5], []]);
    expect(await dashes("IN;SP1;LT6,10,1;PU0,0;PD4000,0;")).toEqual([[5, 1, 1, 1, 1, 1]]);
    expect(
      (await dashes("IN;IP0,0,3000,4000;SP1;LT3,8;PU0,0;PD4000,0;"))[0].map(
        (mm) => Math.round(mm * 1e6) / 1e6,
      ),
    ).toEqual([7, 3]);
    expect(await dashes("IN;UL2,1,1,2;SP1;LT2,8,1;PU0,0;PD4000,0;")).toEqual([[1, 1, 2, 1, 1, 2]]);
    expect(await dashes("IN;LT2,10,1;LT;LT99;SP1;PU0,0;PD4000,0;")).toEqual([[5, 5]]);
    expect(await dashes(`IN;LT2,10,1;SP1;PU0,0;LBH${ETX}`)).toEqual([[]]);
    expect(codes(await hpgl("IN;LT2,10,1;SP1;PU0,0;PD4000,0;"))).toEqual([]);
    expect(codes(await hpgl("IN;LT12;SP1;PU0,0;PD4000,0;"))).toEqual(["attribute-fault"]);
  });

  it("draw dots at the points only with LT0", async () => {
    expect(await shapes("IN;SP1;LT0;PU0,0;PD400,0,400,400;")).toEqual(["M0 10L0 10M0 0L0 0"]);
  });

  it("do not break a solid line that continues", async () => {
    expect(await shapes("IN;SP1;PU0,0;PD400,0;LT;PD800,0;IW;PD1200,0;")).toEqual(["M0 0L10 0L20 0L30 0"]);
  });

  it("cut off what is outside the window, and take the page from the rest", async () => {
    const drawing = await hpgl(
      "IN;SP1;IW0,0,2000,2000;PU1000,1000;PD8000,1000;PU9000,9000;PD9900,9000;IW;PU0,0;PD0,400;",
    );
    expect(drawing.paths.count).toBe(2);
    expect([drawing.widthMm, drawing.heightMm]).toEqual([50, 25]);
    const { strokes } = prepare(drawing, {});
    const lengths = Array.from({ length: strokes.offsets.length - 1 }, (_, i) => {
      const [x0, y0, x1, y1] = strokes.xy.subarray(2 * strokes.offsets[i], 2 * strokes.offsets[i + 1]);
      return Math.hypot(x1 - x0, y1 - y0);
    });
    expect(lengths.sort((a, b) => a - b).map((mm) => Math.round(mm * 1e3) / 1e3)).toEqual([10, 25]);
    expect(codes(drawing)).toEqual([]);
  });

  it("have the window in user units", async () => {
    const drawing = await hpgl("IN;IP0,0,4000,4000;SC0,10,0,10;IW0,0,5,5;SP1;PU1,1;PD9,1;");
    expect(drawing.widthMm).toBeCloseTo(40, 9);
    expect(
      (await hpgl("IN;SP1;IW0,0,9,9;PU1000,1000;PD8000,1000;")).warnings.map(({ code }) => code),
    ).toEqual(["empty-drawing"]);
  });

  it("have the colours that PC gives the pens", async () => {
    expect((await hpgl("IN;SP1;PC1,255,128,0;PU0,0;PD400,0;PC1;PD800,0;")).colors).toEqual([
      "#ff8000",
      "#000000",
    ]);
    expect((await hpgl("IN;CR0,100,0,100,0,100;PC3,100,0,50;SP3;PU0,0;PD400,0;")).colors).toEqual([
      "#ff0080",
    ]);
  });
});
