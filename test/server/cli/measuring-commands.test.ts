/** `plotwright pen-times` and `plotwright ringing`: print sheets to measure a plotter with, and store what was read from them. */
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { Store } from "../../../server/storage/store.js";
import type { PlotSettings } from "../../../src/schema/index.js";
import { CommandUser } from "../../support/processes/command-user.js";

const user = new CommandUser();
const { done, shown, startServer } = user;

const plotterName = (): string => {
  const store = Store.open(user.data);
  const [{ id, name }] = store.plotters();
  store.close();
  return name ?? id;
};

describe("plotwright pen-times", () => {
  it("writes a sheet and the settings to plot it with, which wait as long as each line's number says", async () => {
    const sheet = join(user.home, "pen.svg");
    const { code, err } = await user.run("pen-times", sheet);
    expect([code, err]).toEqual([
      0,
      expect.stringContaining(`plotwright plot ${sheet} --config ${join(user.home, "pen.json")}`),
    ]);
    const planOf = async (...args: string[]): Promise<{ penLifts: number; durationS: number }> =>
      JSON.parse(await done("plan", sheet, "--json", ...args)) as { penLifts: number; durationS: number };
    const plain = await planOf("--no-fit", "--order", "none", "--pen-overlap", "off");
    const waiting = await planOf("--config", join(user.home, "pen.json"));
    expect(waiting.penLifts).toBe(plain.penLifts);
    // Nine lines of twelve strokes, and the numbers at 300 ms; the waits of some lines cancel each other.
    const numbers = plain.penLifts - 9 * 12;
    const extraMs = 2 * (numbers * 300 + 12 * (300 + 60 + 40 + 20 - 20 - 40 - 60 - 80));
    expect(Math.abs(waiting.durationS - plain.durationS - extraMs / 1_000)).toBeLessThan(0.5);
  });

  it("stores the number that was read with the plotter, and keeps its other settings", async () => {
    await done("settings", "save", "Ink", "--pen-down", "20");
    expect(await done("pen-times", "--right", "20")).toBe(
      "Extra wait after lifting\t20 ms\tplotter virtual\nExtra wait after lowering\t20 ms\tplotter virtual\n".replaceAll(
        "virtual",
        plotterName(),
      ),
    );
    expect((await shown()).settings.pen).toMatchObject({ extraLiftMs: 20, extraDropMs: 20, upPct: 60 });
    await done("pen-times", "--drop", "-40");
    expect((await shown()).settings.pen).toMatchObject({ extraLiftMs: 20, extraDropMs: -40 });
    expect(await done("settings", "presets")).toBe("Ink\n");
    const { code, err } = await user.run("pen-times", "--right", "-900");
    expect([code, err]).toEqual([2, expect.stringContaining("-900 ms: it must be -500 to 10000 ms")]);
  });

  it("stores it with the plotter of a running server", async () => {
    const server = await startServer();
    try {
      await done("pen-times", "--right", "40", "--url", server.url);
      expect((await shown()).settings.pen).toMatchObject({ extraLiftMs: 40, extraDropMs: 40 });
    } finally {
      await server.close();
    }
  });
});

describe("plotwright ringing", () => {
  /** The options of each command that it prints for plotting a sheet. */
  const printedOptions = async (...args: string[]): Promise<string[][]> => {
    const { err } = await user.run("ringing", join(user.home, "sheet.svg"), ...args);
    return [...err.matchAll(/plotwright plot \S+ (.*)/g)].map(([, options]) => options.split(" "));
  };

  it("prints commands that plot the sheets shaped only as they should be, also with a plotter that is already measured", async () => {
    await done("ringing", ...READ, "--store");
    await done("settings", "set", "shaper", "zv");
    const [sheet] = await printedOptions();
    expect((await shown(...sheet)).settings.motion.shaper).toBe("none");
    const checks = await printedOptions(
      "--check",
      "--spring-x",
      "15",
      "--spring-y",
      "25",
      "--damping",
      "0.1",
    );
    const settings: PlotSettings[] = [];
    for (const options of checks) settings.push((await shown(...options)).settings);
    expect(settings.map(({ motion }) => motion.shaper)).toEqual(["none", "zv", "zv", "zv", "zv", "zv"]);
    const springs = settings.slice(1).map(({ customMachine }) => customMachine?.springs);
    expect(springs.map((one) => one?.damping)).toEqual([0.1, 0.1, 0.1, 0.1, 0.1]);
    expect(springs.map((one) => one?.xHz)).toEqual([12, 13.5, 15, 16.5, 18.8]);
  });

  const READ = ["--ripples-x", "2,20", "--ripples-y", "3,18", "--damping", "0.08"];
  const SPRINGS = { xHz: 15.1, yHz: 25.3, damping: 0.08 };

  it("stores the swing with the plotter, in a copy of its built-in model", async () => {
    expect(await done("ringing", ...READ)).toBe("x\t15.1 Hz\ny\t25.3 Hz\n");
    expect(await done("ringing", ...READ, "--store")).toContain(
      `stored\tAxiDraw V3, measured\tplotter ${plotterName()}`,
    );
    const { settings } = await shown();
    expect([settings.machine, settings.customMachine?.springs]).toEqual(["axidraw-v3-measured", SPRINGS]);
    // Measured again, it is the same machine.
    await done("ringing", "--ripples-x", "2,19", "--ripples-y", "3,18", "--store");
    expect((await shown()).settings.machine).toBe("axidraw-v3-measured");
  });

  it("stores it with the plotter of a running server", async () => {
    const server = await startServer();
    try {
      await done("ringing", ...READ, "--store", "--url", server.url);
      expect((await shown()).settings.customMachine?.springs).toEqual(SPRINGS);
    } finally {
      await server.close();
    }
  });
});
