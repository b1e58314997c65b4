/** A machine on the network: a virtual Grbl behind a TCP port. */
import { afterEach, describe, expect, it } from "vitest";
import { driver } from "../../../src/drivers/grbl/driver.js";
import { NODE_PARTS } from "../../../server/plotter/node-parts.js";
import { nodeClock } from "../../../server/serial/node-clock.js";
import { tcpAddress } from "../../../server/serial/tcp-transport.js";
import { NO_EVENTS } from "../../support/machines/machine.js";
import { SETTINGS } from "../../support/plots/grbl-plotter.js";
import { LocalPlanner, strokesOf } from "../../support/plots/local-planner.js";
import { networkGrbl } from "../../support/plots/network-grbl.js";
import { NodePlotter } from "../../support/plots/node-plotter.js";

const SPEED = 50;
const closing: (() => Promise<unknown> | void)[] = [];
afterEach(async () => {
  for (const close of closing.splice(0).reverse()) await close();
});

/** A FluidNC on this computer. */
async function onNetwork() {
  const { close, ...grbl } = await networkGrbl({ face: "FluidNC" }, SPEED);
  closing.push(close);
  return grbl;
}

describe("a machine on the network", () => {
  it("plots like one on a serial port", async () => {
    const { board, device } = await onNetwork();
    const plotter = new NodePlotter({ device, settings: SETTINGS, virtualSpeed: SPEED });
    closing.push(() => plotter.close());
    await plotter.start();
    expect(plotter.state).toMatchObject({ connection: "idle", firmware: "FluidNC 3.7.16", device });
    const run = await plotter.plot(new LocalPlanner(strokesOf([10, 10, 60, 10, 60, 40])), SETTINGS);
    expect(await run.finished).toEqual({ kind: "done" });
    const drawn = board.drawn().filter(({ penDown, xy }) => penDown && xy.length > 2);
    expect(drawn.map(({ xy }) => [...xy])).toEqual([[10, 10, 60, 10, 60, 40]]);
  });

  it("is named when the connection is lost, and connected again", async () => {
    const { device, sockets } = await onNetwork();
    const plotter = new NodePlotter({ device, settings: SETTINGS, virtualSpeed: SPEED });
    closing.push(() => plotter.close());
    await plotter.start();
    for (const socket of sockets) socket.destroy();
    await expect
      .poll(() => plotter.state.message)
      .toMatch(/^The connection to tcp:\/\/127\.0\.0\.1:\d+ was lost: /);
    await expect.poll(() => plotter.state.connection).toBe("idle");
  });

  it("that nobody listens for is reported with what to check", async () => {
    await expect(NODE_PARTS.devices.open("tcp://127.0.0.1:1")).rejects.toMatchObject({
      code: "no-board",
      message: expect.stringMatching(
        /^There is no connection to tcp:\/\/127\.0\.0\.1:1 \(.*ECONNREFUSED/,
      ) as string,
    });
  });

  it("closes once and for all", async () => {
    const { device } = await onNetwork();
    const line = await NODE_PARTS.devices.open(device);
    const machine = await driver.identify(line, {
      clock: nodeClock,
      machineClock: nodeClock,
      speed: 1,
      events: NO_EVENTS,
    });
    await machine.close();
    await line.close();
    await expect(line.write(Uint8Array.of(63))).rejects.toMatchObject({ code: "disconnected" });
  });
});

describe("the address of a device", () => {
  it.each([
    ["tcp://fluidnc.local:23", { host: "fluidnc.local", port: 23 }],
    ["tcp://fluidnc.local", { host: "fluidnc.local", port: 23 }],
    ["TCP://192.168.1.7:8080", { host: "192.168.1.7", port: 8080 }],
    ["tcp://[fe80::1]:23", { host: "fe80::1", port: 23 }],
    ["/dev/ttyUSB0", null],
    ["COM3", null],
    ["virtual", null],
  ])("%s is read", (device, address) => {
    expect(tcpAddress(device)).toEqual(address);
  });

  it.each(["tcp://", "tcp://:23", "tcp:fluidnc", "tcp://a:b", "tcp://host:99999", "tcp://host/path"])(
    "%s is refused with an example",
    (device) => {
      expect(() => tcpAddress(device)).toThrow(/is not the address of a machine.*tcp:\/\/fluidnc\.local:23/);
    },
  );
});
