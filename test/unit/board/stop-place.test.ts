import { describe, expect, it } from "vitest";
import { commandLine, compile, DEFAULT_MOTION, DEFAULT_PEN, machineById, plan } from "../../../src/index.js";
import { placeOfStop } from "../../../src/drivers/ebb/stream/stop-place.js";
import { firmwareFeatures } from "../../../src/drivers/ebb/protocol/firmware.js";
import { waitingCount } from "../../../src/drivers/ebb/protocol/replies.js";
import { strokeSetOf, type Point } from "../../support/arbitraries.js";
import { seeded } from "../../support/live-plot.js";

const machine = machineById("axidraw-v3");
/** The same line many times: its steps are passed ten times, once in every 0.45 s. */
const AGAIN = strokeSetOf([Array.from({ length: 11 }, (_, i): Point => [20 + 15 * (i % 2), 30])]);
/** Max error of the host's estimate of the board's time. */
const OFF_S = 0.2;

describe("the place of an emergency stop", () => {
  it.each(["2.5.3", "3.0.3"])(
    "is found from the number of waiting commands, however late the host's estimate is, on %s",
    (firmware) => {
      const features = firmwareFeatures(firmware);
      const trajectory = plan(AGAIN, { ...DEFAULT_MOTION, mode: "junction" }, DEFAULT_PEN);
      const stream = compile(trajectory, { machine, firmware, pen: DEFAULT_PEN });
      const all = Array.from({ length: stream.count }, (_, index) => ({
        ...{ number: index, stream, index, writtenS: 0 },
        ...{ startS: stream.boardS[index], endS: stream.boardS[index + 1] },
      }));
      const random = seeded(5);
      for (let i = 1; i < stream.count; i++) {
        if (!/^(LM|LT)/.test(commandLine(stream, i))) continue;
        // It has just ended: then its counters are known.
        const waiting = Math.min(3, stream.count - 1 - i);
        const found = placeOfStop(
          {
            commands: all.slice(Math.max(0, i - 20), i + 1 + waiting),
            waitingCount: waiting,
            stepsLeft: features.arithmetic === "signed" ? null : [0, 0],
            boardS: stream.boardS[i + 1] + OFF_S * (2 * random() - 1),
          },
          features,
          stream.steps1[i],
          stream.steps2[i],
        );
        expect(found!.commandIndex).toBeGreaterThanOrEqual(i);
        expect(found!.commandIndex).toBeLessThanOrEqual(i + 1);
      }
    },
  );

  it.each([
    ["QU,6", "6,12", 12],
    ["QU,6", "12", 12],
    ["QG", "2F", 1],
    ["QG", "2E", 0],
    ["QM", "1,1,0,1", 1],
    ["QM", "1,1,0", null],
  ])("counts the waiting commands from %s and the reply %s", (line, reply, count) => {
    expect(waitingCount(line, reply)).toBe(count);
  });
});
