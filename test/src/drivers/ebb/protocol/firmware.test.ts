import { describe, expect, it } from "vitest";
import {
  compareFirmware,
  firmwareFeatures,
  NEWEST_FIRMWARE,
  newerFirmwareNote,
  firmwareFromReply,
} from "../../../../../src/drivers/ebb/protocol/firmware.js";

describe("the firmware table", () => {
  it.each([
    ["2.4.4", "slices"],
    ["2.5.2", "slices"],
    ["2.5.3", "steps"],
    ["2.6.9", "steps"],
    ["2.7.0", "timed"],
    ["2.8.1", "timed"],
    ["3.0.0", "jerk"],
    ["3.1.0", "jerk"],
    ["10.0.0", "jerk"],
  ])("plots with firmware %s by %s", (version, motion) => {
    expect(firmwareFeatures(version).motion).toBe(motion);
  });

  it("treats a version newer than it knows as the newest one, and says so", () => {
    const newest = firmwareFeatures(NEWEST_FIRMWARE);
    for (const version of ["3.1.8", "3.2.0", "10.0.0"]) {
      expect(firmwareFeatures(version)).toEqual({ ...newest, version });
      expect(newerFirmwareNote(version)).toContain(`Firmware ${version} is newer than plotwright knows`);
    }
    for (const version of ["2.4.4", "3.0.3", "3.1.0", NEWEST_FIRMWARE])
      expect(newerFirmwareNote(version)).toBeNull();
  });

  it("orders versions by number, not by letter", () => {
    expect(compareFirmware("2.10.0", "2.9.9")).toBe(1);
    expect(compareFirmware("2.8", "2.8.0")).toBe(0);
    expect(compareFirmware("2.5.3", "2.6.0")).toBe(-1);
  });

  it("reads the version from the board's reply", () => {
    expect(firmwareFromReply("EBBv13_and_above EB Firmware Version 2.8.1\r\n")).toBe("2.8.1");
    expect(firmwareFromReply("V,EBBv13_and_above EB Firmware Version 3.0.3")).toBe("3.0.3");
    expect(firmwareFromReply("Grbl 1.1h")).toBeNull();
  });

  it.each(["3.1.7-beta", "3.1.7b", "3.1.7.1", "v3.1.7", "3.1.7 (rc 2.0)"])(
    "reads the three numbers of version %s",
    (version) => {
      expect(firmwareFromReply(`EBBv13_and_above EB Firmware Version ${version}\r\n`)).toBe("3.1.7");
    },
  );

  it("refuses an invalid version", () => {
    for (const text of ["", "two", "2", "2.8.1; EM", "-1.0.0"]) {
      expect(() => firmwareFeatures(text)).toThrow(/firmware version/);
    }
  });
});
