import { mkdirSync, symlinkSync, writeFileSync } from "node:fs";
import path from "node:path";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { findBoards, sysfsPorts } from "../../../server/serial/find-boards.js";
import { folderOfTest } from "../../support/processes/folders.js";

let root: string;

beforeEach(() => {
  root = folderOfTest();
});

afterEach(() => {
  vi.unstubAllEnvs();
});

/** A USB device with one serial port, as Linux lays it out. */
function addDevice(tty: string, files: Readonly<Record<string, string>>): void {
  const device = path.join(root, "devices", `usb-${tty}`);
  mkdirSync(path.join(device, "interface"), { recursive: true });
  for (const [name, text] of Object.entries(files)) writeFileSync(path.join(device, name), `${text}\n`);
  mkdirSync(path.join(root, "tty", tty), { recursive: true });
  symlinkSync(path.join(device, "interface"), path.join(root, "tty", tty, "device"));
}

describe("the serial ports of a Linux without udev", () => {
  it("are the modems, with the ids and names of their USB devices", () => {
    addDevice("ttyACM0", { idVendor: "04d8", idProduct: "fd92", manufacturer: "EiBotBoard", serial: "NO1" });
    addDevice("ttyACM1", { idVendor: "2341", idProduct: "0043" });
    addDevice("ttyS0", { idVendor: "04d8", idProduct: "fd92" });
    addDevice("ttyACM2", {});
    expect(sysfsPorts(path.join(root, "tty"))).toEqual([
      {
        path: "/dev/ttyACM0",
        vendorId: "04d8",
        productId: "fd92",
        manufacturer: "EiBotBoard",
        serialNumber: "NO1",
      },
      { path: "/dev/ttyACM1", vendorId: "2341", productId: "0043" },
      { path: "/dev/ttyACM2" },
    ]);
  });

  it("are also the serial adapters, whose ports are in a folder more", () => {
    const device = path.join(root, "devices", "usb");
    mkdirSync(path.join(device, "interface", "ttyUSB0"), { recursive: true });
    writeFileSync(path.join(device, "idVendor"), "1a86\n");
    writeFileSync(path.join(device, "idProduct"), "7523\n");
    mkdirSync(path.join(root, "tty", "ttyUSB0"), { recursive: true });
    symlinkSync(path.join(device, "interface", "ttyUSB0"), path.join(root, "tty", "ttyUSB0", "device"));
    expect(sysfsPorts(path.join(root, "tty"))).toEqual([
      { path: "/dev/ttyUSB0", vendorId: "1a86", productId: "7523" },
    ]);
  });

  it("are none if there is no such folder", () => {
    expect(sysfsPorts(path.join(root, "missing"))).toEqual([]);
  });
});

it.runIf(process.platform === "linux")("boards are found also where udevadm is not installed", async () => {
  vi.stubEnv("PATH", root);
  expect(Array.isArray(await findBoards())).toBe(true);
});
