/** `plotwright plot`, and what it leaves for a server's queue. */
import { execFileSync, spawn } from "node:child_process";
import { copyFileSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { openPtyBoard } from "../../../server/cli/board/board.js";
import { PlotRecord } from "../../../server/cli/plot/plot-record.js";
import { serverHint } from "../../../server/cli/client/server-client.js";
import { nodeClock } from "../../../server/serial/node-clock.js";
import { PlotwrightError, VirtualBoard } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { CaughtIo, cliWith, type CliRun } from "../../support/processes/command-line.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20" stroke="black"><path d="M1 2h9"/></svg>`;
vi.mock("../../../server/cli/stdin.js", () => ({ readStdin: () => Buffer.from(SVG) }));

let dir: string;
let file: string;
beforeEach(() => {
  dir = folderOfTest();
  file = join(dir, "a.svg");
  writeFileSync(file, SVG);
});
afterEach(() => {
  vi.restoreAllMocks();
});

function plot(io: CaughtIo, ...args: string[]): Promise<CliRun> {
  return cliWith(io, "plot", ...args, "--device", "virtual", "--virtual-speed", "100", "--data", dir);
}
function withoutKeyboard(): CaughtIo {
  const io = new CaughtIo();
  io.hasKeyboard = false;
  return io;
}

describe("plotwright plot", () => {
  it("reports when it begins and when it is done, and nothing with --quiet", async () => {
    expect((await plot(new CaughtIo(), file)).err).toMatch(
      /^a\.svg: drawn 9 × 0 mm, 100 %\nPlotting a\.svg\.\nDone: a\.svg, after 00:00:\d\d\.\n$/,
    );
    expect(await plot(new CaughtIo(), "-", "--quiet")).toEqual({ code: 0, out: "", err: "" });
  });

  it("prints its progress as lines, or as one JSON object a line with --json", async () => {
    writeFileSync(file, SVG.replace("M1 2h9", "M1 2h18v16h-18z".repeat(60)));
    const lines = (await plot(new CaughtIo(), file)).err.split("\n").slice(2, -2);
    expect(lines.length).toBeGreaterThan(0);
    for (const line of lines) expect(line).toMatch(/^\d+ % {2}00:0\d:\d\d so far, 00:0\d:\d\d left$/);
    const { out, err } = await plot(new CaughtIo(), file, "--json");
    const events = out
      .trim()
      .split("\n")
      .map((line) => JSON.parse(line) as { event: string });
    expect(events[0]).toEqual({ event: "started", name: "a.svg" });
    expect(new Set(events.slice(1, -1).map(({ event }) => event))).toEqual(new Set(["progress"]));
    expect(events.at(-1)).toMatchObject({ event: "done", name: "a.svg", progress: 1, remainingS: 0 });
    expect(err).toBe("a.svg: drawn 18 × 16 mm, 100 %\n");
  });

  it("waits for Enter between two plots, or for the given time", async () => {
    const io = new CaughtIo();
    const plotted = plot(io, file, "-");
    await expect.poll(() => io.errText).toMatch(/Next: stdin\. Change the paper, then press Enter/);
    expect(io.errText).not.toMatch(/Plotting stdin/);
    io.line();
    expect((await plotted).code).toBe(0);
    expect(io.errText).toMatch(/Done: stdin/);
    const quiet = ["--copies", "2", "--paper-s", "0", "--quiet"];
    expect(await plot(withoutKeyboard(), file, ...quiet)).toEqual({ code: 0, out: "", err: "" });
    const refused = await plot(withoutKeyboard(), file, "--copies", "2");
    expect(refused).toMatchObject({ code: 2, err: expect.stringMatching(/--paper-s/) as string });
    const copies = await plot(withoutKeyboard(), file, "--copies", "3", "--paper-s", "0");
    expect([copies.code, copies.err.match(/Done/g)?.length]).toEqual([0, 3]);
  });

  it("plots a drawing that is spread over several sheets one sheet after the other", async () => {
    const spread = ["--tile-columns", "2", "--tile-rows", "2", "--fit"];
    const io = new CaughtIo();
    const plotted = plot(io, file, ...spread);
    for (const tile of [2, 3, 4]) {
      await expect.poll(() => io.errText).toContain(`Next: ${file} (sheet ${tile} of 4). Change the paper`);
      io.line();
    }
    expect((await plotted).code).toBe(0);
    const done = [...io.errText.matchAll(/Done: (.*?)[.:,\n]/g)].map(([, name]) => name);
    expect(done).toHaveLength(4);
    const single = await plot(withoutKeyboard(), file, ...spread, "--tile", "3");
    expect([single.code, single.err.match(/Done/g)?.length]).toEqual([0, 1]);
    const none = await plot(withoutKeyboard(), file, ...spread, "--tile", "5");
    expect(none.err).toMatch(/no sheet 5/);
  });

  it("plots endless copies of all files in turn, until Ctrl-C between two of them or twice in a plot", async () => {
    const other = join(dir, "b.svg");
    writeFileSync(other, SVG);
    const io = new CaughtIo();
    const plotted = plot(io, file, other, "--copies", "0");
    const order = ["b.svg", "a.svg", "b.svg"];
    for (const [i, next] of order.entries()) {
      await expect.poll(() => io.errText.match(/Next: .*\./g)?.length).toBe(i + 1);
      expect(/.*Next: .*?(\w\.svg)/s.exec(io.errText)?.[1]).toBe(next);
      if (i < order.length - 1) io.line();
    }
    expect(io.errText).toMatch(/^Endless copies: to stop, press Ctrl-C twice, or once between two plots\.\n/);
    io.interrupt();
    expect((await plotted).code).toBe(5);
    expect(io.errText.match(/Done: /g)).toHaveLength(3);

    writeFileSync(file, SVG.replace("M1 2h9", "M1 2h18v16h-18z".repeat(2000)));
    const running = new CaughtIo();
    const stopped = plot(running, file, "--copies", "0", "--paper-s", "0");
    await expect.poll(() => running.errText).toContain("Plotting a.svg.");
    running.interrupt();
    await expect.poll(() => running.errText).toContain("Enter resumes");
    running.interrupt();
    expect((await stopped).code).toBe(5);
    // Without a keyboard, the first one stops it, and so does the end of the process.
    writeFileSync(file, SVG);
    for (const end of ["interrupt", "end"] as const) {
      const quiet = withoutKeyboard();
      const ended = plot(quiet, file, "--copies", "0", "--paper-s", "0");
      await expect.poll(() => quiet.errText.match(/Done: /g)?.length ?? 0).toBeGreaterThan(1);
      quiet[end]();
      expect((await ended).code).toBe(5);
    }
    expect((await plot(withoutKeyboard(), file, "--copies", "0")).err).toMatch(/--paper-s/);
    for (const [command, wrong, words] of [
      ["plot", "101", "0 for endless"],
      ["plot", "-1", "0 for endless"],
      ["add", "0", "plotwright plot --copies 0"],
    ] as const) {
      expect((await cliWith(new CaughtIo(), command, file, "--copies", wrong)).err).toContain(words);
    }
  });

  it("resumes a plot of text in the font with which it began", async () => {
    const font = join(
      process.cwd(),
      "node_modules/@fontsource/dejavu-sans/files/dejavu-sans-latin-400-normal.woff",
    );
    const own = join(dir, "own.woff");
    copyFileSync(font, own);
    writeFileSync(
      file,
      `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200">${Array.from({ length: 6 }, (_, i) => `<text x="5" y="${12 * i + 20}" font-size="9">${"ink ".repeat(12)}</text>`).join("")}</svg>`,
    );
    const planned = vi.spyOn(PlotRecord.prototype, "save");
    const io = new CaughtIo();
    const plotted = plot(io, file, "--font", own);
    await expect.poll(() => planned.mock.calls.length).toBeGreaterThan(0);
    io.end();
    expect((await plotted).code).toBe(5);
    rmSync(own);
    const { code, err } = await plot(withoutKeyboard(), "--resume");
    expect([code, err]).toEqual([0, expect.stringContaining("Done: a.svg")]);
    // Text in the built-in letters would have this note.
    expect(err).not.toContain("single-stroke");
  });

  it("refuses a plot that would wait for another pen without a keyboard, and draws nothing", async () => {
    const layers = join(dir, "layers.svg");
    const layer = (label: string): string =>
      `<g inkscape:groupmode="layer" inkscape:label="${label}"><path d="M1 2h9"/></g>`;
    const head = SVG.replace(">", ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape">');
    writeFileSync(layers, head.replace('<path d="M1 2h9"/>', `${layer("1 black")}${layer("!2 blue")}`));
    const refused = await plot(withoutKeyboard(), layers);
    expect([refused.code, refused.err]).toEqual([
      2,
      expect.stringMatching(
        /^plotwright: Before "2 blue" the plot waits for Enter.*--only.*"penStops": "never"/,
      ),
    ]);
    const record = new PlotRecord(dir, "virtual");
    expect(record.find()).toBeNull();
    expect((await plot(withoutKeyboard(), layers, "--only", "1 black")).code).toBe(0);
    const settings = join(dir, "settings.json");
    writeFileSync(settings, '{ "penStops": "never" }');
    expect((await plot(withoutKeyboard(), layers, "--config", settings)).code).toBe(0);
    record.begin(layers, { name: "b.svg", settings: DEFAULT_PLOT_SETTINGS, only: undefined });
    const interruptAt = (stroke: number): void =>
      record.save({ place: { stroke, alongMm: 3 }, xMm: 1, yMm: 1, penUp: false, elapsedS: 1 }, 0.4);
    interruptAt(0);
    expect((await plot(withoutKeyboard(), "--resume")).err).toMatch(
      /Before "2 blue" .* run it in a terminal/,
    );
    expect(record.find()).toMatchObject({ progress: 0.4 });
    interruptAt(1);
    expect((await plot(withoutKeyboard(), "--resume")).code).toBe(0);
    const io = new CaughtIo();
    const plotted = plot(io, layers);
    await expect.poll(() => io.errText).toMatch(/Put in the pen for "2 blue"\. Enter resumes/);
    io.line();
    expect((await plotted).code).toBe(0);
  });

  it("heeds a Ctrl-C between connecting and the first motion", async () => {
    writeFileSync(file, SVG.replace("M1 2h9", "M1 2h18v16h-18z".repeat(2000)));
    /** Presses Ctrl-C as soon as the board is connected. */
    class AtOnce extends CaughtIo {
      override err(text: string): void {
        super.err(text);
        if (text.includes(": drawn ")) this.interrupt();
      }
    }
    const io = new AtOnce();
    const plotted = plot(io, file);
    await expect.poll(() => io.errText).toMatch(/Plotting a\.svg\.\nPaused\. Enter resumes/);
    io.interrupt();
    expect((await plotted).code).toBe(5);
    const alone = new AtOnce();
    alone.hasKeyboard = false;
    const { code, err } = await plot(alone, file);
    expect([code, err]).toEqual([5, expect.stringMatching(/Plotting a\.svg\.\nCancelling: /)]);
  });

  it("resumes at Enter when the button on the machine has paused it", async () => {
    const line = await openPtyBoard(new VirtualBoard({ clock: nodeClock, speed: 5 }));
    writeFileSync(file, SVG.replace("M1 2h9", "M1 2h18v16h-18z"));
    const io = new CaughtIo();
    const args = ["--fit", "--device", line.path, "--virtual-speed", "5", "--data", dir];
    const plotted = cliWith(io, "plot", file, ...args);
    try {
      await expect.poll(() => line.board.statistics().drawnMm).toBeGreaterThan(1);
      line.board.pressButton();
      await expect.poll(() => io.errText).toMatch(/\nPaused\. Enter resumes, Ctrl-C cancels\.\n$/);
      io.line();
      expect((await plotted).code).toBe(0);
      expect(io.errText.match(/Paused/g)).toHaveLength(1);
    } finally {
      io.interrupt();
      io.interrupt();
      await plotted;
      await line.close();
    }
  });

  it("does not begin after an interrupted plot, unless asked to restart", async () => {
    const record = new PlotRecord(dir, "virtual");
    const interrupt = (): void => {
      record.begin(file, { name: "b.svg", settings: DEFAULT_PLOT_SETTINGS, only: undefined });
      const [place, received] = [3, 4].map((alongMm) => ({ stroke: 0, alongMm }));
      record.save({ place, received, run: 5, xMm: 1, yMm: 1, penUp: false, elapsedS: 1 }, 0.4);
    };
    interrupt();
    const refused = await plot(new CaughtIo(), file);
    expect(refused.err).toMatch(/plot of b\.svg was interrupted at 40 %.*plot --resume/);
    expect(refused.code).toBe(5);
    const received = { stroke: 0, alongMm: 4 };
    expect(record.find()).toMatchObject({
      from: { stroke: 0, alongMm: 3 },
      stopped: { received, run: 5 },
      progress: 0.4,
    });
    for (const other of [["--speed", "20"], ["--copies", "2"], ["--restart"], ["--no-fit"]]) {
      const { code, err } = await plot(withoutKeyboard(), "--resume", ...other);
      expect([code, err.trim()]).toEqual([2, expect.stringMatching(`leave out ${other[0]}\\.$`)]);
    }
    const resumed = await plot(withoutKeyboard(), "--resume", "--quiet");
    expect(resumed).toEqual({ code: 0, out: "", err: "" });
    interrupt();
    const again = await plot(withoutKeyboard(), "--resume");
    expect(again.err).toMatch(/^b\.svg: drawn 9 × 0 mm, 100 %\nResuming b\.svg\.\nDone: b\.svg/);
    expect([again.code, record.find()]).toEqual([0, null]);
    expect((await plot(new CaughtIo(), "--resume")).err).toMatch(/nothing to resume/);
    interrupt();
    expect((await plot(new CaughtIo(), file, "--restart")).code).toBe(0);
  });

  it("ended while the drawing is planned, draws nothing; an interrupted plot stays interrupted", async () => {
    const endPlanning = async (...args: string[]): Promise<CliRun> => {
      const io = new CaughtIo();
      const plotted = plot(io, ...args);
      await expect.poll(() => io.listens).toBe(true);
      io.end();
      return plotted;
    };
    expect(await endPlanning(file)).toEqual({
      code: 5,
      out: "",
      err: "plotwright: the plot was cancelled.\n",
    });
    const record = new PlotRecord(dir, "virtual");
    expect(record.find()).toBeNull();
    record.begin(file, { name: "b.svg", settings: DEFAULT_PLOT_SETTINGS, only: undefined });
    record.save({ place: { stroke: 0, alongMm: 3 }, xMm: 1, yMm: 1, penUp: false, elapsedS: 1 }, 0.4);
    const interrupted =
      "plotwright: The plot of b.svg was interrupted at 40 %. Use plotwright plot --resume to resume it.\n";
    expect(await endPlanning("--resume")).toEqual({ code: 5, out: "", err: interrupted });
    expect(record.find()).toMatchObject({ progress: 0.4 });
  });

  it("ended while a resumed plot waits for Enter, stays interrupted", async () => {
    const record = new PlotRecord(dir, "virtual");
    record.begin(file, { name: "b.svg", settings: DEFAULT_PLOT_SETTINGS, only: undefined });
    record.save({ place: { stroke: 0, alongMm: 3 }, xMm: 1, yMm: 1, penUp: false, elapsedS: 1 }, 0.4);
    const io = new CaughtIo();
    const plotted = plot(io, "--resume");
    await expect.poll(() => io.errText).toMatch(/Enter resumes/);
    io.end();
    expect((await plotted).code).toBe(5);
    expect(io.errText).toMatch(/b\.svg was interrupted at 40 %/);
    expect(record.find()).toMatchObject({ from: { stroke: 0, alongMm: 3 }, progress: 0.4 });
  });

  it("waits for Enter before it resumes a plot if there is a keyboard", async () => {
    const record = new PlotRecord(dir, "virtual");
    record.begin(file, { name: "b.svg", settings: DEFAULT_PLOT_SETTINGS, only: undefined });
    record.save({ place: { stroke: 0, alongMm: 3 }, xMm: 1, yMm: 1, penUp: false, elapsedS: 1 }, 0.4);
    const io = new CaughtIo();
    const plotted = plot(io, "--resume");
    await expect.poll(() => io.errText).toMatch(/lost its position.*Enter resumes/);
    expect(io.errText).not.toMatch(/Done/);
    io.line();
    expect((await plotted).code).toBe(0);
  });

  it("continues while the progress can't be stored, reports it once and tries again", async () => {
    const save = vi.spyOn(PlotRecord.prototype, "save").mockImplementation(() => {
      throw Object.assign(new Error("ENOSPC: no space left on device, write"), { code: "ENOSPC" });
    });
    const full = await plot(new CaughtIo(), file);
    expect(full.code).toBe(0);
    expect(full.err.match(/can't be stored: the disk is full\. The plot continues/g)).toHaveLength(1);
    expect(full.err).toMatch(/Done: a\.svg/);
    expect(save.mock.calls.length).toBeGreaterThan(1);
  });

  it("leaves the record of another process that is plotting on the virtual board", async () => {
    const record = new PlotRecord(dir, "virtual");
    record.begin(file, { name: "b.svg", settings: DEFAULT_PLOT_SETTINGS, only: undefined });
    record.save({ place: { stroke: 0, alongMm: 3 }, xMm: 1, yMm: 1, penUp: false, elapsedS: 1 }, 0.4);
    const folder = join(dir, "command-line", "virtual");
    const stored = JSON.parse(readFileSync(join(folder, "plot.json"), "utf8")) as object;
    writeFileSync(join(folder, "plot.json"), JSON.stringify({ ...stored, pid: process.ppid, began: "" }));
    const contents = (): string[] =>
      readdirSync(folder).map((name) => name + readFileSync(join(folder, name), "utf8"));
    const before = contents();
    const other = join(dir, "other.svg");
    writeFileSync(other, SVG.replace("h9", "h8"));
    expect(await plot(new CaughtIo(), other, "--quiet")).toEqual({ code: 0, out: "", err: "" });
    expect(contents()).toEqual(before);
  });

  it("checks that all files can be read before the first plot, and names the one at fault", async () => {
    const missing = join(dir, "missing.svg");
    const refused = await plot(withoutKeyboard(), file, missing, "--paper-s", "0");
    expect(refused).toEqual({
      code: 3,
      out: "",
      err: `plotwright: ${missing} can't be read: there is no such file or folder.\n`,
    });
    const image = join(dir, "image.svg");
    writeFileSync(image, SVG.replace('<path d="M1 2h9"/>', ""));
    const second = await plot(withoutKeyboard(), file, image, "--paper-s", "0");
    expect([second.code, second.err]).toEqual([
      3,
      expect.stringMatching(/Done: a\.svg.*\nplotwright: \S*image\.svg: There is nothing to draw/s),
    ]);
  });

  it("plots all copies of a drawing that comes through a pipe", async () => {
    const pipe = join(dir, "pipe");
    execFileSync("mkfifo", [pipe]);
    // A second reader would get nothing; without a writer it would wait endlessly.
    const writer = spawn("sh", ["-c", `cat ${file} > ${pipe}; sleep 0.1; : > ${pipe}`]);
    try {
      const { code, err } = await plot(withoutKeyboard(), pipe, "--copies", "2", "--paper-s", "0");
      expect([code, err.match(/Done/g)?.length]).toEqual([0, 2]);
    } finally {
      writer.kill();
    }
  });

  it("names the server that may use the plotter", async () => {
    const taken = new PlotwrightError("busy", "Another program has it.");
    const me = { role: "operate", id: null, name: null };
    const refusal = { error: { code: "not-allowed", message: "Pair this device first." } };
    for (const answer of [me, refusal]) {
      vi.stubGlobal("fetch", () => Promise.resolve(new Response(JSON.stringify(answer))));
      expect((await serverHint(taken)) as Error).toMatchObject({
        code: "busy",
        message: expect.stringMatching(/Another program has it\. .*plotwright add FILE/) as string,
      });
    }
    vi.stubGlobal("fetch", () => Promise.resolve(new Response("<html>")));
    expect(await serverHint(taken)).toBe(taken);
    vi.stubGlobal("fetch", () => Promise.reject(new TypeError("fetch failed")));
    expect(await serverHint(taken)).toBe(taken);
    vi.unstubAllGlobals();
  });
});
