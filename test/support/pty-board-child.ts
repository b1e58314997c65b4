/**
 * A virtual board behind a real pseudo-terminal, in a process of its own: what the driver's tests plug in.
 * Started by pty-board.ts; told by messages what shall happen to the board.
 */
import { spawn } from "@lydell/node-pty";
import { VirtualBoard } from "../../src/index.js";
import { nodeClock } from "../../server/serial/node-clock.js";
import { wakefulClock } from "./wakeful-clock.js";
import type { FromBoard, ToBoard } from "./pty-board.js";

const { firmware, speed, futureSyntax, wakeful } = JSON.parse(process.argv[2]!) as {
  firmware: string;
  speed: number;
  futureSyntax: boolean;
  wakeful: boolean;
};
const ownClock = wakeful ? wakefulClock() : null;
const board = new VirtualBoard({ clock: ownClock ?? nodeClock, firmware, speed });
const say = (message: FromBoard): void => void process.send!(message);

// A shell holds the terminal open and makes it pass bytes as they are; its first line is the terminal's name.
const terminal = spawn("sh", ["-c", "stty raw -echo; tty; exec sleep 1000000"], { encoding: null });
let isOpen = false;
let foreignAnswer: string | null = null;
let head = "";
terminal.onData((data: unknown) => {
  const bytes = data as Buffer;
  if (isOpen) {
    if (foreignAnswer !== null) {
      terminal.write(foreignAnswer);
      return;
    }
    board.receive(bytes);
    if (!board.accepting) terminal.pause();
    return;
  }
  head += bytes.toString("latin1");
  const path = /^(\/dev\/\S+)\s/.exec(head)?.[1];
  if (path !== undefined) {
    isOpen = true;
    if (futureSyntax) board.receive(Buffer.from("CU,10,1\r"));
    say({ type: "open", path });
  }
});
board.onDrain(() => terminal.resume());
board.onSend((bytes) => terminal.write(Buffer.from(bytes).toString("latin1")));
board.onDrop(() => terminal.kill("SIGKILL"));
process.on("message", (message: ToBoard) => {
  switch (message.type) {
    case "unplug":
      board.unplug();
      break;
    case "reset":
      board.resetByPower();
      break;
    case "foreign":
      foreignAnswer = message.answer;
      break;
    case "mute":
      board.setMute(message.mute);
      break;
    case "frozen":
      board.setFrozen(message.frozen);
      break;
    case "motionless":
      board.setMotionless(message.motionless);
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
    case "button":
      board.pressButton();
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
  terminal.kill("SIGKILL");
  process.exit(0);
});
