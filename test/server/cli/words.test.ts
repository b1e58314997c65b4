/** Typed arguments: words that are not commands, lengths with units, unusable files. */
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, describe, expect, it, vi } from "vitest";
import { optionsTakenByNpm } from "../../../scripts/setup.mjs";
import { parseSize } from "../../../src/internal.js";
import { length } from "../../../server/cli/options.js";
import { buildProgram } from "../../../server/cli/program.js";
import { settingsFromOptions } from "../../../server/cli/settings-options.js";
import { SETTING_OPTIONS } from "../../../server/cli/setting-table.js";
import { CaughtIo, cli } from "../../support/processes/command-line.js";

const folder = mkdtempSync(join(tmpdir(), "plotwright-words-"));
// The user's own data folder may belong to a running server, or have an interrupted plot.
beforeAll(() => void vi.stubEnv("XDG_DATA_HOME", folder));
afterAll(() => {
  vi.unstubAllEnvs();
  rmSync(folder, { recursive: true, force: true });
});

describe("a word that is not a command", () => {
  it.each([
    ["pln", "x.svg", /There is no command pln\. Did you mean plan\?$/],
    ["polt", "x.svg", /There is no command polt\. Did you mean plot\?$/],
    [
      "recover",
      "",
      /There is no command recover\. To continue a drawing that was begun: plotwright plot --resume$/,
    ],
    ["frobnicate", "", /There is no command frobnicate\. The commands are serve, plan, plot, /],
    ["x.svg", "", /There is no command x\.svg\. To plot a drawing: plotwright plot x\.svg$/],
    ["version", "", /There is no command version\. To print the version: plotwright --version$/],
    ["help", "pln", /There is no command pln\. Did you mean plan\?$/],
    ["9381", "", /To choose the port: plotwright --port 9381, or npm start -- --port 9381/],
  ])("%s %s is named, with a suggestion", async (word, more, message) => {
    const { code, out, err } = await cli(...[word, more].filter((one) => one !== ""));
    expect([code, out]).toEqual([2, ""]);
    expect(err.trim()).toMatch(message);
    expect(err.trim().split("\n")).toHaveLength(1);
  });

  it.each([
    [
      ["serve", "9381"],
      /^plotwright: too many arguments for 'serve'\. Expected 0 arguments but got 1\. Options begin with --, /,
    ],
    [
      ["plan", "my", "drawing.svg"],
      /^plotwright: too many arguments for 'plan'\. Expected 1 argument but got 2\. Options begin with --, and names with blanks need quotes\. \(see plotwright plan --help\)$/m,
    ],
  ])("%j has a surplus word", async (args, message) => {
    const { code, err } = await cli(...args);
    expect(code).toBe(2);
    expect(err).toMatch(message);
  });

  it.each([
    ["--nonsense", "unknown option '--nonsense' (see plotwright serve --help)"],
    ["--prot 9381", "unknown option '--prot' (Did you mean --port?) (see plotwright serve --help)"],
    ["--port", "option '--port <number>' argument missing (see plotwright serve --help)"],
    ["plan", "missing required argument 'file' (see plotwright plan --help)"],
    ["board", "required option '--pty <path>' not specified (see plotwright board --help)"],
    [
      "plan in.svg --margin abc",
      "option '--margin <mm>' argument 'abc' is invalid. It must be a length in mm, or with a unit as in 2cm or 1in. (see plotwright plan --help)",
    ],
    ["plan in.svg --margin 1e9", "--margin: it must be 0 to 1000 mm."],
    [
      "plan in.svg --order x",
      "option '--order <how>' argument 'x' is invalid. Allowed choices are none, fast, best. (see plotwright plan --help)",
    ],
    [
      "pen 101",
      "command-argument value '101' is invalid for argument 'where'. It must be up, down, or a height of 0 to 100 percent. (see plotwright pen --help)",
    ],
    [
      "plan in.svg --place 1",
      "option '--place <x,y[,w,h]>' argument '1' is invalid. It must be 2, 3 or 4 lengths with commas between. (see plotwright plan --help)",
    ],
    [
      "serve --allow-host studio.local http://studio",
      "option '--allow-host <name...>' argument 'http://studio' is invalid. It must be a name without http:// and port, such as studio.local. (see plotwright serve --help)",
    ],
    [
      "serve --allow-origin https://editor.example/sketches",
      "option '--allow-origin <url...>' argument 'https://editor.example/sketches' is invalid. \"https://editor.example/sketches\" is not an origin. It must be the address of a site without a path, such as https://preview.p5js.org or http://localhost:8080. (see plotwright serve --help)",
    ],
    ["ringing --store", "--store: give both --ripples-x and --ripples-y."],
    ["ringing --ripples-x 2,20 --store", "--store: give both --ripples-x and --ripples-y."],
    ["ringing --ripples-x 2,20 --damping 3", "--damping: it must be 0 to 0.5."],
    ["ringing --plotter main", "--plotter is for --store: add it."],
    ["ringing --damping 0.1", "--damping: give --ripples-x and --ripples-y too, what you counted."],
    [
      "ringing --ripples-x 2",
      "option '--ripples-x <count,mm>' argument '2' is invalid. It must be a whole number of ripples, and their length in mm: 3,18.5. (see plotwright ringing --help)",
    ],
    [
      "ringing --ripples-y 50,10",
      "y: 50 ripples in 10 mm would be 750 Hz; a machine swings at 2 to 200 Hz: count again, near the bend.",
    ],
    ["ringing --check --spring-x 15 --spring-y 500", "--spring-y: it must be 2 to 200 Hz."],
    ["ringing --spring-x 15", "--spring-x and --spring-y are for --check: add it."],
    ["plan in.svg --svg ./in.svg", "--svg ./in.svg would overwrite the drawing: choose another file."],
    ["machines --data no-folder", "--data no-folder: there is no such folder."],
    ["pen up --data no-folder --device virtual", "--data no-folder: there is no such folder."],
    ["service install --user me --print", "--user: add --system; without it the service runs as you."],
    ["service instal", "unknown command 'instal' (Did you mean install?) (see plotwright service --help)"],
    [
      "queue --url 9391",
      "option '--url <url>' argument '9391' is invalid. It must be an address such as http://127.0.0.1:9080. (see plotwright queue --help)",
    ],
  ])("%s is explained in one line", async (line, message) => {
    expect(await cli(...line.split(" "))).toEqual({ code: 2, out: "", err: `plotwright: ${message}\n` });
  });

  it("leaves options and help unchanged", async () => {
    expect(await cli("--version")).toMatchObject({ code: 0, out: "0.0.0\n" });
    expect((await cli("help")).code).toBe(0);
    expect(await cli("-v")).toMatchObject({ code: 0, out: "0.0.0\n" });
  });
});

describe("a length", () => {
  it("is mm, or has a unit", () => {
    expect(length("1e3")).toBe(1_000);
    const read = ["12", "12mm", "1.2cm", "1in", '1"', ".5in", "-3", "2 cm"].map(length);
    expect(read).toEqual([12, 12, 12, 25.4, 25.4, 12.7, -3, 20]);
    for (const wrong of ["", "x", "1ft", "1 2", "in", "1e999", "1,5"]) {
      expect(() => length(wrong)).toThrow(/a length in mm, or with a unit/);
    }
  });

  it("the size of a sheet has a unit for both sides or for each", () => {
    expect(parseSize("210x297")).toEqual({ widthMm: 210, heightMm: 297 });
    expect(parseSize("20x20cm")).toEqual({ widthMm: 200, heightMm: 200 });
    expect(parseSize("8.5x11in")).toEqual({ widthMm: 215.9, heightMm: 279.4 });
    expect(parseSize("8.5in × 279.4mm")).toEqual({ widthMm: 215.9, heightMm: 279.4 });
    for (const wrong of ["", "x", "1x", "1x2x3", "0x5", "-1x5", "1x1ft"]) expect(parseSize(wrong)).toBeNull();
  });

  it("may be given to every option that takes mm", () => {
    for (const { flags, parse } of SETTING_OPTIONS) {
      if (/<mm>/.test(flags)) expect([flags, parse?.("1in")]).toEqual([flags, 25.4]);
    }
    const paper = SETTING_OPTIONS.find(({ flags }) => flags.startsWith("--paper"))?.parse?.("8.5x11in");
    expect(settingsFromOptions({ paper }).prepare).toMatchObject({
      paper: { widthMm: 215.9, heightMm: 279.4 },
      landscape: false,
    });
  });
});

describe("npm start without --", () => {
  it("does not lose an option of serve: npm passes it in the environment only", async () => {
    const context = { io: new CaughtIo(), version: "0.0.0", setExitCode: () => undefined };
    const program = await buildProgram(["serve"], context);
    const serve = program.commands.find((command) => command.name() === "serve");
    // npm has its own --cert and --key.
    const names = serve?.options.map(({ long }) => long?.replace(/^--(no-)?/, "") ?? "") ?? [];
    for (const name of names.filter((one) => one !== "cert" && one !== "key")) {
      const env = { [`npm_config_${name.replaceAll("-", "_")}`]: "true", npm_config_key: "x" };
      expect(optionsTakenByNpm(env)).toEqual([`--${name}`]);
    }
    expect(optionsTakenByNpm({ npm_config_registry: "x", PORT: "1" })).toEqual([]);
  });
});

describe("a file that cannot be used", () => {
  // Only Linux has a folder in which nothing can be made.
  const inProc = [
    [
      ["plot", "in", "--data", "/proc/x"],
      /The data folder \/proc\/x can't be created: no folder can be made there/,
    ],
    [["board", "--pty", "/proc/x"], /\/proc\/x can't be made: there is no such file or folder/],
  ] as const;
  it.each([
    ...(process.platform === "linux" ? inProc : []),
    [["plot", "in", "--data", "in"], /The data folder .* can't be created: a part of this path is a file/],
    [["plan", "in", "--svg", "no-folder/x.svg"], /x\.svg can't be written: there is no such file or folder/],
    [["plan", "in", "--commands", "in/x.txt"], /x\.txt can't be written: a part of this path is a file/],
    [["plan", "."], /can't be read: it is a folder/],
    [["logs", "--data", "no-folder"], /--data no-folder: there is no such folder/],
    [["logs", "--data", "in"], /--data .*: there is no such folder/],
    [["serve", "--port", "0", "--host", "192.0.2.1"], /this computer does not have that address/],
  ] as const)("stops %j with a message, without the system's codes", async (args, message) => {
    const drawing = join(folder, "in");
    writeFileSync(drawing, '<svg xmlns="http://www.w3.org/2000/svg"><path d="M1 2h9" stroke="red"/></svg>');
    const board = args[0] === "plot" ? ["--device", "virtual", "--virtual-speed", "100"] : [];
    const paths = args.map((arg) => (arg === "." ? folder : arg.replace(/^in(?=$|\/)/, drawing)));
    const { code, err } = await cli(...paths, ...board);
    expect([code, err]).toEqual([expect.any(Number), expect.stringMatching(message)]);
    expect(code).toBeGreaterThan(0);
    expect(err).not.toMatch(/ENO|EACC|EIS/);
  });
  const file = (name: string, text: string): string => {
    const path = join(folder, name);
    writeFileSync(path, text);
    return path;
  };
  const LINE =
    '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm"><path d="M1 1H9" stroke="red"/></svg>';
  const drawing = file("line.svg", LINE);

  it("is reported as empty once, with the reasons", async () => {
    const empty = file(
      "empty.svg",
      '<svg xmlns="http://www.w3.org/2000/svg"><image width="5" height="5"/></svg>',
    );
    const { code, err } = await cli("plan", empty);
    expect(code).toBe(3);
    expect(err.match(/nothing to draw|no lines to draw/gi)).toHaveLength(1);
    expect(err).toMatch(/^plotwright: \S*empty\.svg: 1 picture is not drawn/);
    expect(err).not.toContain("other notes");
    const outside = file("outside.svg", LINE.replace("M1 1H9", "M5000 5000h9"));
    const { err: why } = await cli("plan", outside, "--no-fit", "--outside", "cut");
    expect(why).toMatch(/outside\.svg: 1 shape is entirely outside .* Nothing is left to draw on this paper/);
    expect(why).not.toContain("There is nothing to draw");
    expect(await cli("plan", drawing, "--fit", "--paper", "5000x5000")).toMatchObject({
      code: 3,
      err: expect.stringMatching(/line\.svg: The drawing reaches from/) as string,
    });
    // The second one is checked before the first one is plotted.
    expect(await cli("plot", drawing, folder, "--paper-s", "0", "--device", "virtual")).toMatchObject({
      ...{ code: 3, out: "" },
      err: expect.stringMatching(/^plotwright: \S+ can't be read: it is a folder\.$/m) as string,
    });
    expect((await cli("plan", file("nothing", " "))).err).toMatch(
      /nothing cannot be read as a drawing: it is empty\./,
    );
  });

  it.each([
    ["--config", "{", /: it is not JSON \(/],
    ["--config", '{"motion":7}', /motion: it must be an object\.$/],
    ["--machine-file", '{"id":"x"}', /: name: it is missing\.$/],
    ["--machine-file", '{"id":"x","name":"x","widthMm":9000}', /: widthMm: it must be at most 5000\.$/],
  ])("%s %s is explained", async (option, text, message) => {
    const { code, err } = await cli("plan", drawing, option, file("given.json", text));
    expect(code).toBe(2);
    expect(err.trim()).toMatch(message);
  });

  it("is named when it is not there, or cannot be written", async () => {
    expect((await cli("plan", drawing, "--config", join(folder, "none.json"))).err).toMatch(
      /no such file or folder\.$/m,
    );
    expect((await cli("plan", drawing, "--svg", join(folder, "none", "a.svg"))).err).toMatch(
      /a\.svg can't be written: there is no such file or folder\.$/m,
    );
    expect((await cli("plan", drawing, "--preview", folder)).err).toMatch(
      /can't be written: it is a folder\.$/m,
    );
  });
});

const FONT = fileURLToPath(
  new URL(
    "../../../node_modules/@fontsource/dejavu-sans/files/dejavu-sans-latin-400-normal.woff",
    import.meta.url,
  ),
);

describe("a note", () => {
  const notesOf = async (svg: string, ...args: string[]): Promise<string> => {
    const file = join(folder, "noted.svg");
    const page = 'xmlns="http://www.w3.org/2000/svg" width="80mm" height="80mm" viewBox="0 0 80 80"';
    writeFileSync(file, `<svg ${page}>${svg}</svg>`);
    return (await cli("plan", file, ...args)).out;
  };
  const TEXT = `<text x="5" y="30" font-size="12">ink</text>`;
  const CLIPPED = `<clipPath id="c">${TEXT}</clipPath><path d="M5 30H70" stroke="black" clip-path="url(#c)"/>`;

  it.each([
    ["text", TEXT],
    ["a clip of text", `${CLIPPED}<path d="M1 1H9" stroke="black"/>`],
  ])("of %s names --font, and following it draws with that font", async (_, svg) => {
    const notes = await notesOf(svg);
    expect(notes).toMatch(/onvert (?:the )?text to paths/);
    expect(notes).toContain("--font");
    const lengthIn = async (...args: string[]): Promise<number> =>
      (JSON.parse(await notesOf(svg, "--json", "--no-fit", ...args)) as { drawMm: number }).drawMm;
    expect(await notesOf(svg, "--font", FONT)).not.toContain("--font");
    expect(await lengthIn("--font", FONT)).not.toBeCloseTo(await lengthIn(), 1);
  });

  it("of a font file says what is wrong with it", async () => {
    const file = join(folder, "noted.svg");
    await notesOf(TEXT);
    for (const [font, words] of [
      [join(folder, "none.ttf"), "none.ttf: it can't be read: there is no such file or folder."],
      [file, "noted.svg: This file cannot be read as a font"],
    ] as const) {
      const { code, err } = await cli("plan", file, "--font", font);
      expect([code, err]).toEqual([2, expect.stringContaining(words)]);
      expect(err).toContain("plotwright: --font ");
    }
  });

  it("names the option that fills closed lines, and following it fills them", async () => {
    const closed = `<path d="M5 5H40V40Z" fill="none" stroke="black"/>`;
    const notes = await notesOf(closed, "--hatch", "1");
    const named = /--[a-z-]+/.exec(notes)?.[0] ?? "";
    expect(notes).toMatch(/nothing to fill/);
    expect(SETTING_OPTIONS.map(({ flags }) => flags)).toContain(named);
    expect(await notesOf(closed, "--hatch", "1", named)).not.toMatch(/nothing to fill/);
  });
});
