/** Asking what is on serial ports, over real pseudo-terminals: virtual boards in other processes, and a device that is silent. */
import { spawn, type IPty } from "@lydell/node-pty";
import { afterAll, beforeAll, describe, expect, it, vi } from "vitest";
import { askPorts } from "../../host/plotter/ask-ports.js";
import { NamedPlotter } from "../../host/plotter/named-plotter.js";
import type { Devices, FoundBoard } from "../../host/plotter/devices.js";
import { nodeClock } from "../../server/serial/node-clock.js";
import { openSerial } from "../../server/serial/serial-transport.js";
import { machineById } from "../../src/index.js";
import { hasUsbId, type UsbId } from "../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import { cli } from "../support/processes/command-line.js";
import { PtyBoard } from "../support/processes/pty-board.js";
import { PtyGrbl } from "../support/processes/pty-grbl.js";

/** A terminal that keeps what it is sent, and says nothing. */
class SilentPort {
  heard = "";
  private constructor(
    readonly path: string,
    private readonly terminal: IPty,
  ) {}

  static open(): Promise<SilentPort> {
    return new Promise((resolve) => {
      const terminal = spawn("sh", ["-c", "stty raw -echo; tty; exec sleep 1000000"], {});
      let head = "";
      let port: SilentPort | null = null;
      terminal.onData((text) => {
        if (port) return void (port.heard += text);
        head += text;
        const path = /^(\/dev\/\S+)\s/.exec(head)?.[1];
        if (path !== undefined) resolve((port = new SilentPort(path, terminal)));
      });
    });
  }

  close(): void {
    this.terminal.kill("SIGKILL");
  }
}

const IDS = {
  ch340: { vendorId: "1a86", productId: "7523" },
  esp32: { vendorId: "303a", productId: "1001" },
  ebb: { vendorId: "04d8", productId: "fd92" },
};

let silent: SilentPort;
let drawCore: PtyGrbl;
let fluidNc: PtyGrbl;
let ebb: PtyBoard;
let ports: readonly (readonly [path: string, chip: keyof typeof IDS])[];
beforeAll(async () => {
  const machine = machineById("idraw-h-a3");
  silent = await SilentPort.open();
  drawCore = await PtyGrbl.open({ face: "DrawCore", machine, speed: 10 });
  fluidNc = await PtyGrbl.open({ face: "FluidNC", machine, speed: 10 });
  ebb = await PtyBoard.open();
  ports = [
    [silent.path, "ch340"],
    [ebb.path, "ebb"],
    [drawCore.path, "ch340"],
    [fluidNc.path, "esp32"],
  ];
});
afterAll(async () => {
  silent.close();
  await Promise.all([drawCore.close(), fluidNc.close(), ebb.close()]);
});

/** In the order of `ports`, the silent one first. */
const find = (ids: readonly UsbId[]): Promise<readonly FoundBoard[]> =>
  Promise.resolve(
    ports
      .filter(([, chip]) => hasUsbId(ids, IDS[chip].vendorId, IDS[chip].productId))
      .map(([path]) => ({ path, description: "USB device", serialNumber: null })),
  );
const devices: Devices = { find, open: openSerial };
vi.mock("../../server/serial/find-boards.js", () => ({ findBoards: (ids: readonly UsbId[]) => find(ids) }));

describe("the ports of this computer", () => {
  it("are asked, and tell what is there", async () => {
    const asked = await askPorts({ devices, clock: nodeClock });
    const answers = new Map(asked.map(({ path, answer, fault }) => [path, answer ?? fault]));
    expect(answers.get(drawCore.path)).toBe("DrawCore 2.09");
    expect(answers.get(fluidNc.path)).toMatch(/^FluidNC \d+\.\d+/);
    expect(answers.get(ebb.path)).toBe("EiBotBoard 2.8.1");
    expect(answers.get(silent.path)).toBeNull();
    expect(answers.size).toBe(4);
  });

  it("are sent nothing but the question for a status while they are silent", () => {
    expect(silent.heard).toMatch(/^\?+$/);
  });

  it("are left out if they are taken", async () => {
    const asked = await askPorts({ devices, clock: nodeClock }, (path) => path !== ebb.path);
    expect(asked.map(({ path }) => path)).toEqual([ebb.path]);
  });

  it("say why they can't be opened", async () => {
    const holding = await openSerial(ebb.path);
    const asked = await askPorts({ devices, clock: nodeClock }, (path) => path !== ebb.path);
    await holding.close();
    expect(asked).toMatchObject([
      { answer: null, fault: expect.stringContaining("Another program is using") },
    ]);
  });
});

describe("plotwright devices", () => {
  it("shows what answers on each port, only with --ask", async () => {
    const asked = await cli("devices", "--ask");
    expect(asked.code).toBe(0);
    const lines = asked.out.split("\n");
    const lineOf = (path: string) => lines.find((line) => line.startsWith(path));
    expect(lineOf(drawCore.path)).toBe(`${drawCore.path}\tUSB device\tDrawCore 2.09`);
    expect(lineOf(silent.path)).toBe(`${silent.path}\tUSB device\tno answer`);
    expect(lineOf("virtual")).toBe("virtual\tthe built-in virtual board");
    const heardBefore = silent.heard.length;
    const listed = await cli("devices");
    expect(listed.out).toContain(drawCore.path);
    expect(listed.out).not.toContain("DrawCore 2.09");
    expect(silent.heard.length).toBe(heardBefore);
  });
});

describe("a plotter on the port auto", () => {
  const open = async (machine: string): Promise<NamedPlotter> => {
    const settings = { ...DEFAULT_PLOT_SETTINGS, machine };
    const plotter = new NamedPlotter(
      { id: "main", name: null, machine },
      { device: "auto", virtualIfNone: false, settings, clock: nodeClock, devices },
    );
    await plotter.start();
    return plotter;
  };

  it("is the first Grbl that answers, for a model with a Grbl", async () => {
    const plotter = await open("idraw-h-a3");
    expect(plotter.snapshot()).toMatchObject({ connection: "idle", device: drawCore.path });
    await plotter.close();
  });

  it("is the EiBotBoard for other models, and no other port is asked", async () => {
    const heardBefore = silent.heard.length;
    const plotter = await open("axidraw-v3");
    expect(plotter.snapshot()).toMatchObject({ connection: "idle", device: ebb.path });
    await plotter.close();
    expect(silent.heard.length).toBe(heardBefore);
  });
});

describe("a port with a board of another controller", () => {
  it("is named in the message", async () => {
    const plotter = new NamedPlotter(
      { id: "main", name: null, machine: null },
      { device: fluidNc.path, settings: DEFAULT_PLOT_SETTINGS, clock: nodeClock, devices },
    );
    await plotter.start();
    expect(plotter.snapshot().message).toMatch(/: FluidNC [\d.]+ answers on this port, but the model has/);
    await plotter.close();
  });
});
