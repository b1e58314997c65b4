/** Emergency stops: between which times of the plan the board stopped, and the position of the pen there. */
import { describe, expect, it } from "vitest";
import { commandLine, compile, DEFAULT_MOTION, DEFAULT_PEN, machineById, plan } from "../../../src/index.js";
import type { CommandStream } from "../../../src/drivers/ebb/compile/command-stream.js";
import { waitingCount } from "../../../src/drivers/ebb/protocol/replies.js";
import { BoardTimeline, type RefusedCommand } from "../../../src/drivers/ebb/stream/timeline.js";
import { positionFromMotors } from "../../../src/machines/motors.js";
import { stateAt } from "../../../src/plan/trajectory.js";
import { stoppedPosition } from "../../../src/position/pen-position.js";
import { strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { seeded } from "../../support/plots/live-plot.js";
import { ManualClock } from "../../support/clocks/manual-clock.js";

const machine = machineById("axidraw-v3");
/** The same line many times: its steps are passed ten times, once in every 0.45 s. */
const AGAIN = strokeSetOf([Array.from({ length: 11 }, (_, i): Point => [20 + 15 * (i % 2), 30])]);
const LENGTH_MM = 150;
/** Max error of the host's estimate of the board's time. */
const OFF_S = 0.2;
const trajectory = plan(AGAIN, { ...DEFAULT_MOTION, mode: "junction" }, DEFAULT_PEN);

/** A timeline to which the last commands before `end` were written. */
function written(stream: CommandStream, end: number): BoardTimeline {
  const timeline = new BoardTimeline(new ManualClock(), 1, 2);
  for (let i = Math.max(0, end - 20); i < end; i++)
    timeline.written(stream, i, stream.boardS[i], stream.boardS[i + 1]);
  return timeline;
}

describe("the position of an emergency stop", () => {
  it.each(["2.5.3", "3.0.3"])(
    "is found from the number of waiting commands, however late the host's estimate is, on %s",
    (firmware) => {
      const stream = compile(trajectory, { machine, firmware, pen: DEFAULT_PEN });
      const random = seeded(5);
      for (let i = 1; i < stream.count; i++) {
        if (!/^(LM|LT)/.test(commandLine(stream, i))) continue;
        const waiting = Math.min(3, stream.count - 1 - i);
        const boardS = stream.boardS[i + 1] + OFF_S * (2 * random() - 1);
        const stop = { waitingCount: waiting, boardS };
        const spans = written(stream, i + 1 + waiting).spansAtStop(stop, true, []);
        expect(spans).toMatchObject([
          { stream, fromS: stream.planS[i], toS: stream.planS[Math.min(i + 2, stream.count)] },
        ]);
        // It has just ended: then its counters are known.
        const at = positionFromMotors(machine, stream.steps1[i], stream.steps2[i]);
        const { pass, place } = stoppedPosition(AGAIN, [{ ...spans[0], trajectory }], at, null)!;
        // Where the line turns, it is as near a little later, when the motors have made no step yet.
        expect(Math.abs(pass.planS - stream.planS[i + 1])).toBeLessThan(OFF_S);
        const { stroke, alongMm } = stateAt(trajectory, stream.planS[i + 1]);
        const foundMm = place?.alongMm ?? LENGTH_MM;
        if (stroke >= 0) expect(Math.abs(foundMm - alongMm)).toBeLessThan(0.05);
      }
    },
  );

  it("is the end of the last command if the firmware does not stop", () => {
    const stream = compile(trajectory, { machine, firmware: "2.8.1", pen: DEFAULT_PEN });
    const [span] = written(stream, 9).spansAtStop({ waitingCount: 1, boardS: 0 }, false, []);
    expect(span).toMatchObject({ fromS: stream.planS[8], toS: stream.planS[9] });
    expect(span.estimateS).toBeCloseTo(stream.planS[9], 9);
  });

  describe("with refused commands", () => {
    const stream = compile(trajectory, { machine, firmware: "3.0.3", pen: DEFAULT_PEN });
    const refused = (number: number, takesTime = true): RefusedCommand => {
      return { at: { stream, commandIndex: number, planS: stream.planS[number] }, number, takesTime };
    };
    const spansAt = (waiting: number, commands: readonly RefusedCommand[]) =>
      written(stream, 12).spansAtStop({ waitingCount: waiting, boardS: stream.boardS[12] }, true, commands);

    it("is before the first one, and those behind it did not wait", () => {
      // Commands 9 and 10 never were in the queue: 8 ran, 11 waited.
      expect(spansAt(1, [refused(9), refused(10)])).toMatchObject([
        { fromS: stream.planS[8], toS: stream.planS[9] },
      ]);
    });

    it("is not found on the plan if the board was beyond the first one", () => {
      expect(spansAt(0, [refused(9), refused(10)])).toEqual([]);
      expect(spansAt(0, [refused(9, false)])).toEqual([]);
    });
  });

  it("is on the plan, not where the carriage is, if commands were refused before it", () => {
    const planS = trajectory.totalS / 2;
    const span = { trajectory, fromS: planS, toS: planS, estimateS: planS };
    const { stroke, alongMm } = stateAt(trajectory, planS);
    const { place } = stoppedPosition(AGAIN, [span], { x: 27, y: 30.4 }, null)!;
    expect(place?.stroke).toBe(stroke);
    expect(place?.alongMm).toBeCloseTo(alongMm, 1);
  });

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
