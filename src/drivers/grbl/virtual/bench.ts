/** The virtual Grbl for authors of programs that drive one: faults to cause, and what it has done. */
import type { VirtualBench, VirtualFault } from "../../driver.js";
import type { VirtualGrbl } from "./virtual-grbl.js";

interface Fault extends Omit<VirtualFault, "apply"> {
  readonly apply: (board: VirtualGrbl, value: string | undefined) => boolean;
}

const faults: Readonly<Record<string, Fault>> = {
  unplug: {
    usage: "unplug",
    does: "the cable is unplugged, and plugged in again",
    apply: act((board) => board.unplug()),
  },
  reset: {
    usage: "reset",
    does: "its reset button is pressed: it counts from 0 where it stands",
    apply: act((board) => board.restart()),
  },
  hold: { usage: "hold", does: "its hold button is pressed", apply: act((board) => board.pressHold()) },
  resume: {
    usage: "resume",
    does: "its resume button is pressed, which ends a hold, also that of a closed door",
    apply: act((board) => board.takeFromOther("~")),
  },
  door: {
    usage: "door open|close",
    does: "its safety door is opened or closed",
    apply: (board, value) => {
      if (value !== "open" && value !== "close") return false;
      board.setDoor(value === "open");
      return true;
    },
  },
  limit: { usage: "limit", does: "a limit switch is hit", apply: act((board) => board.stopWith(1)) },
  lose: {
    usage: "lose N",
    does: "the next N answers are lost",
    apply: count((board, n) => board.spoil("reply-lost", n)),
  },
  double: {
    usage: "double N",
    does: "the next N answers are sent twice",
    apply: count((board, n) => board.spoil("reply-doubled", n)),
  },
  refuse: {
    usage: "refuse N",
    does: "the next N lines are refused with error:20",
    apply: count((board, n) => board.spoil("refused", n)),
  },
  garbage: { usage: "garbage", does: "noise on the line", apply: act((board) => board.say("\x7f!\x01A")) },
};

export const bench: VirtualBench = {
  faults,
  summary: (machine) => summary(machine as VirtualGrbl),
};

function summary(board: VirtualGrbl): readonly (readonly [string, string])[] {
  const { movingS, starvedCount, lostCount, earlyCount, xMm, yMm, penUp } = board.state();
  const lines = board.drawn().filter(({ penDown }) => penDown);
  return [
    [
      "drawn",
      `${lines.reduce((mm, { xy }) => mm + lengthMm(xy), 0).toFixed(1)} mm in ${lines.length} strokes`,
    ],
    ["in motion", `${movingS.toFixed(2)} s`],
    ["starved", `${starvedCount} times: the next move came too late`],
    ["lost", `${lostCount} characters, which arrived when its buffer was full`],
    ["too early", `${earlyCount} moves while the pen's servo was still on its way`],
    ["position", `${xMm.toFixed(3)}, ${yMm.toFixed(3)} mm, pen ${penUp ? "up" : "down"}`],
  ];
}

function lengthMm(xy: Float64Array): number {
  let sum = 0;
  for (let i = 2; i < xy.length; i += 2) sum += Math.hypot(xy[i] - xy[i - 2], xy[i + 1] - xy[i - 1]);
  return sum;
}

function act(run: (board: VirtualGrbl) => void): Fault["apply"] {
  return (board) => {
    run(board);
    return true;
  };
}

function count(run: (board: VirtualGrbl, n: number) => void): Fault["apply"] {
  return (board, value = "") => {
    if (!/^\d+$/.test(value)) return false;
    run(board, Number(value));
    return true;
  };
}
