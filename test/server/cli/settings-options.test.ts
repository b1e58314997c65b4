import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { Command } from "commander";
import { describe, expect, it } from "vitest";
import { addSettingOptions, settingsFromOptions } from "../../../server/cli/settings-options.js";
import { MachineFiles } from "../../../server/storage/machine-files.js";
import { machineById } from "../../../src/index.js";
import { motionOfQuality } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../src/schema/index.js";
import { folderOfTest } from "../../support/processes/folders.js";

function settingsOf(...args: string[]): PlotSettings {
  const command = addSettingOptions(new Command())
    .exitOverride()
    .configureOutput({ writeErr: () => undefined });
  command.parse(args, { from: "user" });
  return settingsFromOptions(command.opts());
}

describe("the settings' options", () => {
  it("change no default if none is given", () => {
    expect(settingsOf()).toEqual(DEFAULT_PLOT_SETTINGS);
  });

  it("set speed, acceleration and corners by quality, from the frequencies that are given or stored", () => {
    const springs = { xHz: 15, yHz: 25, damping: 0.1 };
    const given = ["--spring-x", "15", "--spring-y", "25", "--damping", "0.1"];
    for (const quality of ["fine", "normal", "fast"] as const) {
      const { motion, customMachine } = settingsOf("--quality", quality, ...given);
      expect(motion).toMatchObject(motionOfQuality(quality, springs));
      expect(customMachine).toMatchObject({ id: "axidraw-v3", springs });
    }
    expect(settingsOf("--quality", "normal").motion).toMatchObject(motionOfQuality("normal", null));
    expect(() => settingsOf("--quality", "fast")).toThrow(/needs the measured swing of the machine/);
    // A machine that was measured on the page is known by its id.
    const folder = folderOfTest();
    new MachineFiles(folder).save({ ...machineById("axidraw-v3"), id: "mine", springs });
    const stored = settingsFromOptions({ data: folder, machine: "mine", quality: "fast" });
    expect(stored.motion).toMatchObject(motionOfQuality("fast", springs));
    expect(stored.customMachine).toMatchObject({ id: "mine", springs });
  });

  it("let single numbers and another shaper override a quality", () => {
    const given = ["--quality", "fast", "--spring-x", "15", "--spring-y", "25"];
    const { motion } = settingsOf(...given, "--accel", "900", "--shaper", "ei");
    expect(motion).toMatchObject({ shaper: "ei", draw: { speedMmPerS: 85, accelMmPerS2: 900 } });
    expect(() => settingsOf("--spring-x", "15")).toThrow(/--spring-y/);
    expect(() => settingsOf("--spring-x", "15", "--spring-y", "500")).toThrow(
      /--spring-y: it must be 2 to 200 Hz/,
    );
  });

  it("limit single axes, also together with a quality", () => {
    const axes = ["--speed-x", "60", "--speed-y", "40", "--accel-x", "900", "--accel-y", "300"];
    const limits = { speedXMmPerS: 60, speedYMmPerS: 40, accelXMmPerS2: 900, accelYMmPerS2: 300 };
    expect(settingsOf(...axes).motion).toEqual({ ...DEFAULT_PLOT_SETTINGS.motion, ...limits });
    const shaped = settingsOf(...axes, "--quality", "fast", "--spring-x", "15", "--spring-y", "25");
    expect(shaped.motion).toMatchObject({ shaper: "zv", ...limits });
    expect(() => settingsOf("--accel-y", "0")).toThrow(/^--accel-y: it must be more than 0/);
  });

  it("store each value in its setting", () => {
    const settings = settingsOf(
      ...["--machine", "axidraw-se-a3", "--paper", "a3", "--margin", "0", "--no-fit", "--rotate", "-90"],
      ...["--speed", "35.5", "--accel", "400", "--corner", "0.1", "--travel-speed", "200"],
      ...["--travel-accel", "1500", "--pen-up", "70", "--pen-down", "25", "--pen-extra-lift-ms", "100"],
      ...[
        "--pen-extra-drop-ms",
        "-20",
        "--order",
        "none",
        "--layers",
        "stroke",
        "--join",
        "0",
        "--simplify",
        "0.05",
      ],
    );
    expect(settings).toMatchObject({
      machine: "axidraw-se-a3",
      prepare: {
        paper: { widthMm: 297, heightMm: 420 },
        landscape: true,
        marginMm: 0,
        fit: false,
        rotateDeg: -90,
        order: "none",
        layers: "stroke",
        joinMm: 0,
        simplifyMm: 0.05,
      },
      motion: {
        draw: { speedMmPerS: 35.5, accelMmPerS2: 400, cornerMm: 0.1 },
        travel: { speedMmPerS: 200, accelMmPerS2: 1500 },
      },
      pen: { upPct: 70, downPct: 25, extraLiftMs: 100, extraDropMs: -20 },
    });
  });

  it("take a custom paper size as it is written, wide or high", () => {
    expect(settingsOf("--paper", "300x200").prepare.landscape).toBe(true);
    expect(settingsOf("--paper", "200x300.5").prepare).toMatchObject({
      paper: { widthMm: 200, heightMm: 300.5 },
      landscape: false,
    });
    expect(settingsOf("--paper", "200x300", "--landscape").prepare.landscape).toBe(true);
    expect(settingsOf("--paper", "A4", "--no-landscape").prepare.landscape).toBe(false);
  });

  it("include hatching, mirroring and other work on shapes", () => {
    const { prepare, motion } = settingsOf(
      ...["--hatch", "0.4", "--hatch-angle", "30", "--hatch-cross", "--hide-covered", "--no-outline-fills"],
      ...["--mirror", "leftRight", "--margins", "10,20,30,40", "--place", "5,6,70", "--spread", "shuffle"],
      ...["--order", "best", "--order-s", "3", "--mode", "scurve", "--jerk", "9000", "--no-clip", "--reloop"],
    );
    expect(prepare).toMatchObject({
      hatch: { spacingMm: 0.4, angleDeg: 30, cross: true },
      hideCovered: true,
      outlineFills: false,
      mirror: "leftRight",
      margins: { topMm: 10, rightMm: 20, bottomMm: 30, leftMm: 40 },
      layout: { xMm: 5, yMm: 6, widthMm: 70, heightMm: null },
      spread: "shuffle",
      order: "best",
      orderS: 3,
      clipToMargins: false,
      reloop: true,
    });
    expect(motion).toMatchObject({ mode: "scurve", draw: { jerkMmPerS3: 9_000 } });
  });

  it("apply flags over the file of --config, and the file over the defaults", () => {
    const dir = folderOfTest();
    const file = join(dir, "pen.json");
    writeFileSync(file, JSON.stringify({ pen: { upPct: 75 }, motion: { draw: { speedMmPerS: 20 } } }));
    const settings = settingsOf("--config", file, "--speed", "33");
    expect(settings.pen).toEqual({ ...DEFAULT_PLOT_SETTINGS.pen, upPct: 75 });
    expect(settings.motion.draw).toEqual({ ...DEFAULT_PLOT_SETTINGS.motion.draw, speedMmPerS: 33 });
    for (const [text, fault] of [
      ['{"pen":{"upPCT":75}}', /pen\.upPCT: there is no such setting \(did you mean upPct\?\)/],
      ['{"pen":{"upPct":"high"}}', /pen\.json: pen\.upPct/],
      ["[1]", /not a JSON object/],
      ["{", /pen\.json/],
    ] as const) {
      writeFileSync(file, text);
      expect(() => settingsOf("--config", file)).toThrow(fault);
    }
    expect(() => settingsOf("--config", join(dir, "none.json"))).toThrow(/there is no such file or folder/);
  });

  it("use the last of two opposite ones", () => {
    expect(settingsOf("--fit", "--no-fit").prepare.fit).toBe(false);
    expect(settingsOf("--no-fit", "--fit").prepare.fit).toBe(true);
  });

  it("name the flag if a value is invalid", () => {
    for (const args of [
      ["--speed", "fast"],
      ["--speed", ""],
      ["--speed", "NaN"],
      ["--speed", "-5"],
      ["--speed", "1e300"],
      ["--margin", "-1"],
      ["--pen-up", "101"],
      ["--paper", "16x10ft"],
      ["--paper", "A99"],
      ["--paper", "0x100"],
      ["--order", "random"],
      ["--layers", "some"],
    ]) {
      expect(() => settingsOf(...args)).toThrow(args[0]);
    }
  });
});
