/**
 * A virtual board behind a real pseudo-terminal, in its own process: the device for the driver's tests.
 * Started by pty-board.ts, which sends messages for the board's events and faults.
 */
import { chmodSync, mkdtempSync, rmSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { spawn, type IPty } from "@lydell/node-pty";
import { VirtualBoard, type VirtualServo } from "../../../src/drivers/ebb/virtual/virtual-board.js";
import { machineById } from "../../../src/index.js";
import { nodeClock } from "../../../server/serial/node-clock.js";
import { wakefulClock } from "../clocks/wakeful-clock.js";
import type { FromBoard, ToBoard } from "./pty-board.js";

const { firmware, speed, futureSyntax, wakeful, servo, machine } = JSON.parse(process.argv[2]) as {
  firmware: string;
  speed: number;
  futureSyntax: boolean;
  wakeful: boolean;
  servo: VirtualServo;
  machine: string;
};
const ownClock = wakeful ? wakefulClock() : null;
const board = new VirtualBoard({
  clock: ownClock ?? nodeClock,
  firmware,
  speed,
  servo,
  machine: machineById(machine),
});
const say = (message: FromBoard): void => void process.send!(message);

const folder = mkdtempSync(path.join(tmpdir(), "plotwright-pty-"));
chmodSync(folder, 0o755);
const link = path.join(folder, "board");

let terminal: IPty | null = null;
/** Bytes from the host that still arrive; after that the connection is deaf and mute. */
let bytesUntilDeaf = Infinity;

/** A shell holds a terminal open and makes it pass bytes unchanged; its first line is the terminal's name. */
function plugIn(opened: () => void): void {
  const shell = spawn("sh", ["-c", "stty raw -echo; tty; exec sleep 1000000"], { encoding: null });
  terminal = shell;
  let head = "";
  let isOpen = false;
  shell.onData((data: unknown) => {
    const bytes = data as Buffer;
    if (isOpen) {
      if (shell === terminal) fromHost(bytes);
      return;
    }
    head += bytes.toString("latin1");
    const device = /^(\/dev\/\S+)\s/.exec(head)?.[1];
    if (device === undefined) return;
    isOpen = true;
    symlinkSync(device, link);
    opened();
  });
}

function pullOut(): void {
  rmSync(link, { force: true });
  terminal?.kill("SIGKILL");
  terminal = null;
}

function fromHost(bytes: Buffer): void {
  const received = bytes.subarray(0, bytesUntilDeaf);
  bytesUntilDeaf -= received.length;
  board.receive(received);
  if (!board.accepting) terminal?.pause();
}

function toHost(bytes: Uint8Array): void {
  if (bytesUntilDeaf > 0) terminal?.write(Buffer.from(bytes).toString("latin1"));
}

plugIn(() => {
  if (futureSyntax) board.receive(Buffer.from("CU,10,1\r"));
  say({ type: "open", path: link });
});
board.onDrain(() => terminal?.resume());
board.onSend(toHost);
board.onDrop(pullOut);
process.on("message", (message: ToBoard) => {
  switch (message.type) {
    case "unplug":
      board.unplug();
      break;
    case "replug":
      plugIn(() => undefined);
      break;
    case "deaf":
      bytesUntilDeaf = message.deaf ? (message.afterBytes ?? 0) : Infinity;
      break;
    case "reset":
      board.resetByPower();
      break;
    case "mute":
      board.setMute(message.mute);
      break;
    case "frozen":
      board.setFrozen(message.frozen);
      break;
    case "garbage":
      board.sendGarbage(Uint8Array.from(message.bytes));
      break;
    case "lose":
      board.loseReplies(message.count);
      break;
    case "volts":
      board.setMotorVolts(message.volts);
      break;
    case "slow":
      board.setUsbBytesPerS(message.bytesPerS);
      break;
    case "send":
      board.receive(Buffer.from(message.line));
      break;
    case "report":
      say({
        type: "report",
        state: board.state(),
        statistics: board.statistics(),
        sleptS: ownClock?.sleptS() ?? 0,
        drawn: board.drawn().map(({ penDown, xy }) => ({ penDown, xy: [...xy] })),
      });
      break;
  }
});
process.on("disconnect", () => {
  pullOut();
  rmSync(folder, { recursive: true, force: true });
  process.exit(0);
});
