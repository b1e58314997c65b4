import { setTimeout } from "node:timers/promises";
import { afterEach, describe, expect, it } from "vitest";
import { openSerial, openError } from "../../server/serial/serial-transport.js";
import { nodeClock } from "../../server/serial/node-clock.js";
import { BoardSession, type PlotwrightError } from "../../src/index.js";
import { PtyBoard } from "../support/processes/pty-board.js";
import { outcome } from "../support/plots/virtual-plotter.js";

const open: { close(): Promise<void> }[] = [];
const keep = <T extends { close(): Promise<void> }>(thing: T): T => {
  open.push(thing);
  return thing;
};
afterEach(async () => {
  for (const thing of open.splice(0).reverse()) await thing.close();
});

describe("a serial port", () => {
  it("carries a conversation with a board in another process", async () => {
    const board = keep(await PtyBoard.open({ firmware: "3.0.3" }));
    const session = keep(new BoardSession(await openSerial(board.path), { clock: nodeClock }));
    expect((await session.identify()).firmware).toBe("3.0.3");
    expect(await session.query("QS")).toBe("0,0");
  });

  it("restores a board that answers in its other syntax", async () => {
    const board = keep(await PtyBoard.open({ firmware: "3.0.3", futureSyntax: true }));
    const session = keep(new BoardSession(await openSerial(board.path), { clock: nodeClock }));
    expect((await session.identify()).firmware).toBe("3.0.3");
    expect(await session.query("QS")).toBe("0,0");
    expect(session.log.text()).toContain("> CU,10,0");
  });

  it("reports an unplugged cable as lost, with advice", async () => {
    const board = keep(await PtyBoard.open());
    const session = keep(new BoardSession(await openSerial(board.path), { clock: nodeClock }));
    await session.identify();
    const lost = new Promise<PlotwrightError>((resolve) => session.onFault(resolve));
    board.tell({ type: "unplug" });
    expect(await lost).toMatchObject({ code: "disconnected", message: expect.stringContaining("USB cable") });
  });

  it("is refused to a second program", async () => {
    const board = keep(await PtyBoard.open());
    keep(await openSerial(board.path));
    expect(await outcome(openSerial(board.path))).toContain(`busy: Another program is using ${board.path}:`);
  });

  it("is opened when another program frees it within a moment", async () => {
    const board = keep(await PtyBoard.open());
    const before = await openSerial(board.path);
    const opening = openSerial(board.path);
    await setTimeout(300);
    await before.close();
    keep(await opening);
  });

  it("explains how to find the right path if there is nothing at the given one", async () => {
    expect(await outcome(openSerial("/dev/no-such-port"))).toMatch(/^no-board: .*plotwright devices/);
  });

  it("reports a file that is not a port", async () => {
    expect(await outcome(openSerial(import.meta.filename))).toMatch(/^no-board: .*is not a serial port/);
  });

  it.each([
    ["Linux", "Error: Permission denied, cannot open /dev/ttyACM0", "not-allowed", "udev rule"],
    ["macOS", "Error: Resource busy, cannot open /dev/tty.usbmodem1", "busy", "Another program"],
    ["Windows", "Opening COM3: Access denied", "busy", "Another program"],
    ["Windows", "Opening COM9: File not found", "no-board", "no device"],
  ])("turns %s (%s) into a message with advice", (_, words, code, advice) => {
    const error = openError("PORT", new Error(words));
    expect(error.code).toBe(code);
    expect(error.message).toContain(advice);
  });
});
