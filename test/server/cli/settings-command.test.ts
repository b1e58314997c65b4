/** `plotwright settings`, the config file that always applies, and presets: the same with and without a server. */
import { existsSync, mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import fc from "fast-check";
import { beforeEach, describe, expect, it } from "vitest";
import { usualConfigPath } from "../../../server/cli/config-file.js";
import { SETTING_OPTIONS } from "../../../server/cli/setting-table.js";
import { Store } from "../../../server/storage/store.js";
import { SETTING_FLAGS } from "../../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  plotterSettingsSchema,
  withPreset,
  type Job,
  type PlotSettings,
} from "../../../src/schema/index.js";
import { cli } from "../../support/processes/command-line.js";
import { CommandUser } from "../../support/processes/command-user.js";

const user = new CommandUser();
const { done, shown, startServer } = user;
let drawing: string;
beforeEach(() => {
  drawing = join(user.home, "a.svg");
  writeFileSync(
    drawing,
    `<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20" stroke="black"><path d="M1 2h9"/></svg>`,
  );
});

const config = (): unknown => JSON.parse(readFileSync(usualConfigPath(), "utf8"));
const writeConfig = (value: unknown): void => {
  mkdirSync(dirname(usualConfigPath()), { recursive: true });
  writeFileSync(usualConfigPath(), JSON.stringify(value));
};
describe("the config file that always applies", () => {
  it("is where the platform keeps such files", () => {
    expect(usualConfigPath({ XDG_CONFIG_HOME: "/x" }, "linux")).toBe(join("/x", "plotwright", "config.json"));
    expect(usualConfigPath({}, "darwin")).toMatch(/[\\/]\.config[\\/]plotwright[\\/]config\.json$/);
    expect(usualConfigPath({ XDG_CONFIG_HOME: "" }, "linux")).toMatch(/[\\/]\.config[\\/]plotwright/);
    expect(usualConfigPath({ APPDATA: "/roaming" }, "win32")).toBe(
      join("/roaming", "plotwright", "config.json"),
    );
  });

  it("lies over the defaults and under --config and flags, part by part", async () => {
    writeConfig({ pen: { upPct: 71, downPct: 21 }, prepare: { marginMm: 4 } });
    const file = join(user.home, "other.json");
    writeFileSync(file, JSON.stringify({ pen: { downPct: 22 }, motion: { draw: { speedMmPerS: 33 } } }));
    const { settings, sources } = await shown("--config", file, "--speed", "34");
    expect(settings).toEqual({
      ...DEFAULT_PLOT_SETTINGS,
      prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, marginMm: 4 },
      pen: { ...DEFAULT_PLOT_SETTINGS.pen, upPct: 71, downPct: 22 },
      motion: {
        ...DEFAULT_PLOT_SETTINGS.motion,
        draw: { ...DEFAULT_PLOT_SETTINGS.motion.draw, speedMmPerS: 34 },
      },
    });
    expect(sources).toMatchObject({
      "pen.upPct": usualConfigPath(),
      "pen.downPct": `--config ${file}`,
      "prepare.marginMm": usualConfigPath(),
      "motion.draw.speedMmPerS": "--speed",
      "motion.draw.accelMmPerS2": "default",
      machine: "default",
    });
    expect((await shown("--no-config")).settings).toEqual(DEFAULT_PLOT_SETTINGS);
    // In any order, --no-config leaves out only the usual file.
    for (const flags of [
      ["--no-config", "--config", file],
      ["--config", file, "--no-config"],
    ]) {
      const { pen, prepare } = (await shown(...flags)).settings;
      expect([flags, pen.downPct, prepare]).toEqual([flags, 22, DEFAULT_PLOT_SETTINGS.prepare]);
      expect(pen.upPct).toBe(DEFAULT_PLOT_SETTINGS.pen.upPct);
    }
  });

  it("shows only the settings that are asked for, by option or by path", async () => {
    writeConfig({ pen: { upPct: 71 } });
    const source = usualConfigPath();
    expect(await done("settings", "show", "pen-up", "margin")).toBe(
      `prepare.marginMm\t15\tdefault\npen.upPct\t71\t${source}\n`,
    );
    const pen = await shown("pen");
    expect(pen.settings).toEqual({ pen: { ...DEFAULT_PLOT_SETTINGS.pen, upPct: 71 } });
    expect(Object.keys(pen.sources).every((path) => path.startsWith("pen."))).toBe(true);
    expect(await user.run("settings", "show", "get", "margin")).toMatchObject({
      code: 2,
      out: "",
      err: expect.stringContaining("get: there is no such setting"),
    });
  });

  it.each([
    ["{", /it is not JSON/],
    ["[1]", /it is not a JSON object/],
    ['{"pen":{"up":3}}', /pen\.up: there is no such setting/],
    ['{"machine":"typewriter"}', /no machine "typewriter"/],
  ])("is refused with its path if it is %s", async (text, words) => {
    writeConfig({});
    writeFileSync(usualConfigPath(), text);
    const { code, err } = await cli("plan", drawing);
    expect([code, err]).toEqual([2, expect.stringMatching(words)]);
    expect(err).toContain(`plotwright: ${usualConfigPath()}: `);
    // A fault of the file is never written over.
    if (!text.includes("typewriter")) {
      expect((await user.run("settings", "set", "margin", "3")).code).toBe(2);
      expect(readFileSync(usualConfigPath(), "utf8")).toBe(text);
    }
  });
});

describe("settings set and unset", () => {
  it.each([
    ["machine", "axidraw-v3-a3", { machine: "axidraw-v3-a3" }],
    ["paper", "A3", { prepare: { paper: { widthMm: 297, heightMm: 420 } } }],
    ["paper", "20x30cm", { prepare: { paper: { widthMm: 200, heightMm: 300 }, landscape: false } }],
    ["prepare.paper", "300x200", { prepare: { paper: { widthMm: 300, heightMm: 200 }, landscape: true } }],
    ["margin", "1cm", { prepare: { marginMm: 10 } }],
    ["prepare.marginMm", "1cm", { prepare: { marginMm: 10 } }],
    ["fit", "off", { prepare: { fit: false } }],
    ["fit", "auto", { prepare: { fit: "auto" } }],
    ["rotate", "-90", { prepare: { rotateDeg: -90 } }],
    ["order", "best", { prepare: { order: "best" } }],
    ["margins", "1,2,3,4", { prepare: { margins: { topMm: 1, rightMm: 2, bottomMm: 3, leftMm: 4 } } }],
    ["pen.downPct", "25", { pen: { downPct: 25 } }],
    ["penStops", "never", { penStops: "never" }],
    ["motion.speedXMmPerS", "null", { motion: { speedXMmPerS: null } }],
    ["layerPens", '{"sky":"blue"}', { layerPens: { sky: "blue" } }],
  ])("%s to %s writes only that, and unset removes it", async (key, value, expected) => {
    writeConfig({ sendAheadMs: 200 });
    await done("settings", "set", key, value);
    expect(config()).toEqual({ sendAheadMs: 200, ...expected });
    await done("settings", "unset", key);
    await user.run("settings", "unset", "landscape");
    expect(config()).toEqual({ sendAheadMs: 200 });
    expect(await user.run("settings", "unset", key)).toMatchObject({
      code: 2,
      err: expect.stringContaining("does not have"),
    });
  });

  it.each([
    ["margin", "wide", "prepare.marginMm: it must be a length"],
    ["margin", "-3", "prepare.marginMm: it must be 0 to 1000 mm"],
    ["speed", "0", "motion.draw.speedMmPerS: it must be more than 0"],
    ["order", "random", "prepare.order: it must be one of none, fast, best"],
    ["pen.uppct", "3", "pen.uppct: there is no such setting (did you mean upPct?)"],
    ["machine", "typewriter", 'There is no machine "typewriter"'],
    ["quality", "fine", "quality: it sets several settings"],
    ["spring-x", "20", "spring-x: it belongs to the machine's profile"],
    ["liftMs", "3", "liftMs: there is no such setting (did you mean pen.extraLiftMs?)"],
    ["pen.lift", "3", "pen.lift: there is no such setting (did you mean pen.extraLiftMs?)"],
    ["no-landscape", "on", "no-landscape: there is no such setting (did you mean prepare.landscape?)"],
    ["delay", "3", "delay: there is no such setting (did you mean pen.extraLiftMs?)"],
    ["acceleration", "3", "(did you mean motion.draw.accelMmPerS2?)"],
    ["dpi", "96", "(did you mean prepare.pxPerInch?)"],
    ["pen.speed", "96", "pen.speed: there is no such setting (did you mean motion.draw.speedMmPerS?)"],
    ["xyzzy", "3", "plotwright: xyzzy: there is no such setting.\n"],
    ["__proto__.a", "1", "__proto__: there is no such setting.\n"],
    ["constructor", "1", "constructor: there is no such setting.\n"],
    ["penStops", "constructor", "penStops: it must be one of "],
  ])("%s to %s is refused, and writes nothing", async (key, value, words) => {
    const { code, err } = await user.run("settings", "set", key, value);
    expect([code, err]).toEqual([2, expect.stringContaining(words)]);
    expect(existsSync(usualConfigPath())).toBe(false);
  });

  it("take each setting that has a flag, by its flag's name and by its path", async () => {
    const numbers = SETTING_FLAGS.filter(
      ({ path, row }) => row.kind === "number" && !path.startsWith("spring"),
    );
    expect(numbers.length).toBeGreaterThan(25);
    for (const { path, flag, row } of numbers) {
      if (row.kind !== "number") continue;
      const value = row.isWhole ? row.max : (row.min + row.max) / 2;
      await done("settings", "set", flag.slice(2), String(value));
      const byFlag = config();
      await done("settings", "set", path, String(value));
      expect(config()).toEqual(byFlag);
    }
    const { sources } = await shown();
    expect(
      Object.values(sources).filter((source) => source === usualConfigPath()).length,
    ).toBeGreaterThanOrEqual(numbers.length);
  });

  it("give the plotter the user's machine, before and after its server first runs, and keep another model", async () => {
    await done("settings", "set", "machine", "axidraw-v3-a3");
    const server = await startServer();
    const { settings } = JSON.parse(await done("add", drawing, "--json")) as Job;
    await server.close();
    expect(settings.machine).toBe("axidraw-v3-a3");
    expect((await shown()).sources["machine"]).toBe("plotter main");
    await done("settings", "set", "machine", "axidraw-se-a2");
    expect((await shown()).settings.machine).toBe("axidraw-se-a2");
    await done("settings", "set", "machine", "nextdraw-2234", "--plotter", "main");
    expect((await shown()).settings.machine).toBe("nextdraw-2234");
    const { code, err } = await user.run("settings", "set", "machine", "axidraw-v3");
    expect([code, err]).toEqual([
      0,
      "note: The plotter main keeps its model, nextdraw-2234, which overrides the file's. To change it: plotwright settings set machine axidraw-v3 --plotter main\n",
    ]);
    expect((await shown()).settings.machine).toBe("nextdraw-2234");
  });
});

describe("the source of a setting", () => {
  it("is the flag for each setting that has one, also if it sets the value that applies anyway", async () => {
    const flags = SETTING_OPTIONS.filter(
      ({ path, flags: text }) => path.includes(".") && !path.startsWith("springs.") && text.includes("<"),
    );
    const usual = (path: string): unknown =>
      path
        .split(".")
        .reduce<unknown>((at, key) => (at as Record<string, unknown>)[key], DEFAULT_PLOT_SETTINGS);
    for (const { path, flags: text, choices } of flags) {
      const value = usual(path);
      if (choices === undefined && typeof value !== "number") continue;
      const flag = text.split(" ")[0];
      expect([path, (await shown(flag, String(value))).sources[path]]).toEqual([path, flag]);
    }
  });
});

describe("a preset", () => {
  it("is stored for the plotter, once, where the page has its presets", async () => {
    await done("settings", "save", "Fine", "--speed", "20", "--pen-down", "22");
    await done("settings", "save", "Fine", "--speed", "21", "--pen-down", "22");
    expect(await done("settings", "presets")).toBe("Fine\n");
    const store = Store.open(user.data);
    const { presets } = plotterSettingsSchema.parse(store.plotterSettings()["main"]);
    store.close();
    const { draw } = DEFAULT_PLOT_SETTINGS.motion;
    expect(presets).toEqual(
      withPreset([], "Fine", {
        ...DEFAULT_PLOT_SETTINGS,
        motion: { ...DEFAULT_PLOT_SETTINGS.motion, draw: { ...draw, speedMmPerS: 21 } },
        pen: { ...DEFAULT_PLOT_SETTINGS.pen, downPct: 22 },
      }),
    );
    // The data folder has access keys too.
    if (process.platform !== "win32") expect(statSync(user.data).mode & 0o077).toBe(0);
    await done("settings", "remove", "fine");
    expect(await user.run("settings", "presets")).toMatchObject({ code: 0, out: "" });
  });

  it("lies over the config file that always applies, and under --config and flags", async () => {
    await done("settings", "save", "Fine", "--speed", "20", "--pen-down", "22");
    writeConfig({ pen: { downPct: 11 }, prepare: { marginMm: 4 } });
    const file = join(user.home, "other.json");
    writeFileSync(file, JSON.stringify({ motion: { draw: { accelMmPerS2: 77 } } }));
    const { settings, sources } = await shown("--preset", "fine", "--config", file, "--pen-up", "66");
    expect(settings.motion.draw).toMatchObject({ speedMmPerS: 20, accelMmPerS2: 77 });
    expect(settings.pen).toMatchObject({ downPct: 22, upPct: 66 });
    expect(settings.prepare.marginMm).toBe(4);
    expect(sources).toMatchObject({
      "pen.downPct": "preset Fine",
      "pen.upPct": "--pen-up",
      "motion.draw.accelMmPerS2": `--config ${file}`,
      "prepare.marginMm": usualConfigPath(),
    });
  });

  it("that does not exist is refused with the names that there are", async () => {
    const fault = async (...args: string[]): Promise<readonly [number, string]> => {
      const { code, err } = await user.run(...args);
      return [code, err];
    };
    for (const args of [
      ["plan", drawing],
      ["plot", drawing, "--device", "virtual"],
      ["settings", "show"],
    ]) {
      expect(await fault(...args, "--preset", "Ink")).toEqual([
        2,
        'plotwright: The plotter has no preset "Ink". It has none.\n',
      ]);
    }
    await done("settings", "save", "Fine");
    expect(await fault("plan", drawing, "--preset", "Ink")).toEqual([
      2,
      'plotwright: The plotter has no preset "Ink". It has Fine.\n',
    ]);
    expect(await fault("settings", "remove", "Ink")).toEqual([2, expect.stringContaining("It has Fine.")]);
    expect(await fault("settings", "save", "x".repeat(61))).toEqual([
      2,
      expect.stringContaining("The name of the preset: it must have at most 60 characters"),
    ]);
  });
});

describe("beside a running server", () => {
  it("presets and the config file give a job the settings that they give a plot without it", async () => {
    writeConfig({ prepare: { marginMm: 7 }, machine: "axidraw-v3-a3" });
    const jobWith = async (...args: string[]): Promise<PlotSettings> => {
      const [line] = (await done("add", drawing, "--json", ...args)).split("\n");
      return (JSON.parse(line) as Job).settings;
    };
    let server = await startServer();
    await done("settings", "set", "machine", "axidraw-v3-a3");
    await done("settings", "save", "Fine", "--speed", "20", "--pen-down", "22");
    const args = ["--preset", "fine", "--travel-speed", "99"];
    const beside = await shown(...args);
    const job = await jobWith(...args);
    const plan = await done("plan", drawing, ...args, "--json");
    await server.close();
    const without = await shown(...args);
    expect(beside).toEqual(without);
    expect(job).toEqual(without.settings);
    expect(without.settings).toMatchObject({
      machine: "axidraw-v3-a3",
      prepare: { marginMm: 7 },
      motion: { draw: { speedMmPerS: 20 }, travel: { speedMmPerS: 99 } },
      pen: { downPct: 22 },
    });
    const again = JSON.parse(await done("plan", drawing, ...args, "--json")) as { durationS: number };
    expect(JSON.parse(plan)).toMatchObject({ durationS: again.durationS });
    // A preset of the command line is one of the page.
    server = await startServer();
    const response = await fetch(new URL("/api/v1/plotters/main/settings", server.url));
    expect(await response.json()).toMatchObject({ presets: [{ name: "Fine", pen: { downPct: 22 } }] });
    await server.close();
  });

  it("a plot on a board of its own takes the server's presets", async () => {
    const server = await startServer();
    await done("settings", "save", "Fine", "--speed", "20");
    const { code, err } = await user.run(
      ...["plot", drawing, "--device", "virtual", "--virtual-speed", "50", "--preset", "Fine"],
    );
    expect([code, err]).toEqual([0, expect.stringContaining("Done: a.svg")]);
    await server.close();
  });
});

describe("any settings", () => {
  it("that are shown, saved to a file and given by --config are the same again", async () => {
    await fc.assert(
      fc.asyncProperty(
        fc.integer({ min: 0, max: 100 }),
        fc.double({ min: 1, max: 900, noNaN: true }),
        fc.constantFrom("none", "fast", "best"),
        async (down, speed, order) => {
          const { settings } = await shown(
            ...["--pen-down", String(down), "--speed", String(speed), "--order", order],
          );
          const file = join(user.home, "saved.json");
          writeFileSync(file, JSON.stringify(settings));
          expect((await shown("--config", file)).settings).toEqual(settings);
        },
      ),
      { numRuns: 15 },
    );
  });
});
