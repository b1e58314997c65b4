/** The virtual board for authors of drivers: faults to cause, and what it has done. */
import type { VirtualBench, VirtualFault } from "../../driver.js";
import type { VirtualBoard } from "./virtual-board.js";

interface Fault extends Omit<VirtualFault, "apply"> {
  readonly apply: (board: VirtualBoard, value: string | undefined) => boolean;
}

const noise = Uint8Array.of(0xff, 0x21, 13, 0x80, 0x41, 13, 10);

const CONDITIONS = ["good", "absent", "stuck"] as const;

const faults: Readonly<Record<string, Fault>> = {
  unplug: {
    usage: "unplug",
    does: "the cable is unplugged, and plugged in again",
    apply: act((b) => b.unplug()),
  },
  reset: { usage: "reset", does: "its supply fails briefly", apply: act((b) => b.resetByPower()) },
  button: { usage: "button", does: "its button is pressed", apply: act((b) => b.pressButton()) },
  mute: {
    usage: "mute on|off",
    does: "it accepts everything and answers nothing",
    apply: toggle((b, on) => b.setMute(on)),
  },
  freeze: {
    usage: "freeze on|off",
    does: "it answers, but the running command never ends",
    apply: toggle((b, on) => b.setFrozen(on)),
  },
  motionless: {
    usage: "motionless on|off",
    does: "moves take their time, but make no steps",
    apply: toggle((b, on) => b.setMotionless(on)),
  },
  volts: {
    usage: "volts V",
    does: "the motors' supply; 9.1 is right, 0 switched off",
    apply: quantity((b, volts) => b.setMotorVolts(volts)),
  },
  switch: {
    usage: "switch good|absent|stuck",
    does: "the home switch of a NextDraw: not plugged in, or never pressed",
    apply: (board, value) => {
      const condition = CONDITIONS.find((one) => one === value);
      if (board.gantry && condition) board.gantry.switchCondition = condition;
      return board.gantry !== null && condition !== undefined;
    },
  },
  obstacle: {
    usage: "obstacle MM",
    does: "the carriage of a NextDraw gets no further left than that; 0: nothing is in its way",
    apply: (board, value) => {
      const mm = Number(value);
      if (board.gantry && mm >= 0) board.gantry.obstacleMm = mm === 0 ? -Infinity : mm;
      return board.gantry !== null && mm >= 0;
    },
  },
  lose: { usage: "lose N", does: "the next N answers are lost", apply: quantity((b, n) => b.loseReplies(n)) },
  garbage: { usage: "garbage", does: "noise on the line", apply: act((b) => b.sendGarbage(noise)) },
  slow: {
    usage: "slow BYTES",
    does: "its connection carries that many bytes per second; 0: no limit",
    apply: quantity((b, bytesPerS) => b.setUsbBytesPerS(bytesPerS === 0 ? Infinity : bytesPerS)),
  },
};

function summary(board: VirtualBoard): readonly (readonly [string, string])[] {
  const s = board.statistics();
  const state = board.state();
  return [
    ["drawn", `${s.drawnMm.toFixed(1)} mm in ${board.drawn().filter((line) => line.penDown).length} strokes`],
    ["travelled", `${s.travelMm.toFixed(1)} mm`],
    ["pen moves", `${s.penMoveCount}`],
    ["moves", `${s.moveCount} in ${s.movingS.toFixed(2)} s, ${s.busyS.toFixed(2)} s with pen waits`],
    ["underruns", `${s.underrunCount}, ${(s.underrunS * 1e3).toFixed(1)} ms in all`],
    ["largest jump", `${s.largestJumpMmPerS.toFixed(2)} mm/s`],
    ["step counters", `${state.steps1}, ${state.steps2}`],
    ["position", `${state.xMm.toFixed(3)}, ${state.yMm.toFixed(3)} mm`],
  ];
}

export const bench: VirtualBench = { faults, summary };

function act(run: (board: VirtualBoard) => void): Fault["apply"] {
  return (board) => {
    run(board);
    return true;
  };
}

function toggle(run: (board: VirtualBoard, isOn: boolean) => void): Fault["apply"] {
  return (board, value = "on") => {
    if (value !== "on" && value !== "off") return false;
    run(board, value === "on");
    return true;
  };
}

function quantity(run: (board: VirtualBoard, value: number) => void): Fault["apply"] {
  return (board, value = "") => {
    const number = Number(value);
    if (value === "" || !(number >= 0)) return false;
    run(board, number);
    return true;
  };
}
