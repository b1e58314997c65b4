/** Which stored plots count as interrupted, and the faults of the files they are stored in. */
import { spawn } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { PlotRecord } from "../../../server/cli/plot/plot-record.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { folderOfTest } from "../../support/processes/folders.js";

const PLOT = { name: "a.svg", settings: DEFAULT_PLOT_SETTINGS, only: undefined };
const PORT = "/dev/ttyACM0";
let dir: string;
let file: string;
let record: PlotRecord;
beforeEach(() => {
  dir = folderOfTest();
  file = join(dir, "a.svg");
  writeFileSync(file, "<svg/>");
  record = new PlotRecord(dir, PORT);
  record.begin(file, PLOT);
  record.save({ place: { stroke: 0, alongMm: 3 }, xMm: 1, yMm: 1, penUp: false, elapsedS: 1 }, 0.4);
});
afterEach(() => {
  vi.restoreAllMocks();
});

const stored = (name: string): string => join(dir, "command-line", encodeURIComponent(PORT), name);

/** Changes who began the plot. `process.ppid` is a process that is running. */
function beginAs(owner: { pid: number; began: string }): void {
  const plot = JSON.parse(readFileSync(stored("plot.json"), "utf8")) as object;
  writeFileSync(stored("plot.json"), JSON.stringify({ ...plot, ...owner }));
}

describe("a stored plot", () => {
  it("keeps its font file, and a plot without one has none", () => {
    const font = join(dir, "own.ttf");
    writeFileSync(font, "letters");
    expect(record.fontPath).toBeUndefined();
    record.begin(file, PLOT, font);
    rmSync(font);
    expect(readFileSync(record.fontPath ?? "", "utf8")).toBe("letters");
    record.begin(file, PLOT);
    expect(record.fontPath).toBeUndefined();
  });

  it("is not interrupted while the process that began it is running", () => {
    expect(record.find()).toMatchObject({ name: "a.svg", progress: 0.4 });
    beginAs({ pid: process.ppid, began: "" });
    expect(record.find()).toBeNull();
  });

  it("is said to run still if it is to be resumed while another process plots it", () => {
    beginAs({ pid: process.ppid, began: "" });
    const elsewhere = (one: PlotRecord): unknown => {
      try {
        return one.mustFind();
      } catch (error) {
        return error;
      }
    };
    const words = `The plot on ${PORT} still runs in process ${process.ppid}, so there is nothing to resume yet.`;
    expect(elsewhere(record)).toMatchObject({
      code: "conflict",
      message: expect.stringContaining(words) as string,
    });
    rmSync(stored("journal.json"));
    expect(elsewhere(record)).toMatchObject({ code: "conflict" });
    record.end();
    expect(elsewhere(record)).toMatchObject({ code: "not-found" });
  });

  it("is not interrupted while a process of another user plots it", () => {
    vi.spyOn(process, "kill").mockImplementation(() => {
      throw Object.assign(new Error("kill EPERM"), { code: "EPERM" });
    });
    beginAs({ pid: process.ppid, began: "" });
    expect(record.find()).toBeNull();
  });

  it("is interrupted if the computer restarted since, even if another process has its process id", () => {
    beginAs({ pid: process.ppid, began: "100@an-earlier-boot" });
    expect(record.find()).toMatchObject({ name: "a.svg", progress: 0.4 });
  });

  it.runIf(process.platform === "linux")(
    "is interrupted if its process was killed, also before its parent has noticed",
    async () => {
      // The shell begins a process that ends soon, and becomes a `sleep` before, which never asks for its result.
      const parent = spawn("sh", ["-c", "sleep 0.5 & echo $!; exec sleep 60"]);
      try {
        const pid = Number(await new Promise((resolve) => parent.stdout.once("data", resolve)));
        const state = () => readFileSync(`/proc/${pid}/stat`, "utf8");
        await vi.waitFor(() => expect(state()).toContain(") Z "), 10_000);
        beginAs({ pid, began: "" });
        expect(record.find()).toMatchObject({ name: "a.svg", progress: 0.4 });
      } finally {
        parent.kill();
      }
    },
  );

  it("is kept when the next drawing can't be read, and that drawing is named", () => {
    const gone = join(dir, "gone.svg");
    expect(() => record.begin(gone, PLOT)).toThrow(
      expect.objectContaining({
        code: "bad-file",
        message: `${gone} can't be read: there is no such file or folder.`,
      }),
    );
    expect(record.find()).not.toBeNull();
  });

  it("is neither begun nor resumed if the data folder can't be written to", () => {
    mkdirSync(stored("plot.json.new"));
    const refused = expect.objectContaining({
      code: "bad-setting",
      message: expect.stringMatching(/^The data folder .* can't be written to: it is a folder\./) as string,
    }) as Error;
    expect(() => record.begin(file, PLOT)).toThrow(refused);
    expect(() => record.takeOver(PLOT)).toThrow(refused);
  });
});
