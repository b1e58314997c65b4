import { describe, expect, it } from "vitest";
import { AxisMotion, registersFor } from "../../../../../src/drivers/ebb/model/accumulator.js";
import type { TickArithmetic } from "../../../../../src/drivers/ebb/protocol/firmware.js";

/**
 * Recorded by the firmware's own regression tests (evil-mad/EggBot, RegressionTests, outputs of 2023-05-07):
 * [command, rate, accel, jerk, step limit, tick limit, start accumulator, ticks, steps, accumulator, rate, net].
 */
const GOLDEN = [
  ["LM,490123456,5,0", 490123456, 0, 0, 5, Infinity, 0, 22, 5, 45297792, 490123456, 5],
  ["LM,8589934,29,17353403", 8589934, 17353403, 0, 29, Infinity, 0, 85, 29, 1142286978, 1474952488, 29],
  [
    "LM,395851877,3,-77012345",
    395851877,
    -77012345,
    0,
    3,
    Infinity,
    115030,
    17,
    3,
    2043764022,
    -874851816,
    -3,
  ],
  [
    "LM,-1050109930,134,5099123",
    -1050109930,
    5099123,
    0,
    134,
    Infinity,
    2 ** 31 - 1,
    471,
    134,
    128535542,
    1349027442,
    34,
  ],
  ["LT,22,-490123456,0", -490123456, 0, 0, Infinity, 22, 2 ** 31 - 1, 22, 5, 2102185855, -490123456, -5],
  ["LT,11,1204481500,-77012345", 1204481500, -77012345, 0, Infinity, 11, 0, 11, 4, 115030, 395851877, 4],
  ["LT,14,-79000000,10015000", -79000000, 10015000, 0, Infinity, 14, 128535542, 14, 2, 4005542, 56202500, 0],
  [
    "LT,8842,-388686102,70433",
    -388686102,
    70433,
    0,
    Infinity,
    8842,
    623903050,
    8842,
    682,
    21112357,
    234047268,
    -318,
  ],
  [
    "T3,19512,-490123456,0,11",
    -490123456,
    0,
    11,
    Infinity,
    19512,
    2 ** 31 - 1,
    19512,
    4761,
    1311430011,
    1603719021,
    1889,
  ],
  [
    "T3,69,1800095000,-26012345,600999",
    1800095000,
    -26012345,
    600999,
    Infinity,
    69,
    0,
    69,
    44,
    700483895,
    1428293187,
    44,
  ],
] as const;

describe("the model of the accumulator", () => {
  for (const [name, rate, accel, jerk, steps, limit, acc, ticks, made, accEnd, lastRate, net] of GOLDEN) {
    it(`reproduces what firmware 3 recorded for ${name}`, () => {
      const motion = new AxisMotion("signed", registersFor("signed", rate, accel, jerk), acc, steps, limit);
      expect([
        motion.ticks,
        motion.stepsMadeAfter(ticks),
        motion.acc,
        motion.rateDuring(ticks),
        motion.net,
      ]).toEqual([ticks, made, accEnd, lastRate, net]);
    });
  }
});

describe("LM aimed at a rate of exactly zero", () => {
  // 40 mm of x on an AxiDraw: accelerate over 400 steps, cruise 2400, brake over the last 400.
  const ramp = (arithmetic: TickArithmetic) =>
    new AxisMotion(arithmetic, registersFor(arithmetic, 0, 274878), 0, 400, Infinity);
  const cruise = (arithmetic: TickArithmetic) =>
    new AxisMotion(arithmetic, registersFor(arithmetic, 687194767, 0), ramp(arithmetic).acc, 2400, Infinity);
  const brake = (arithmetic: TickArithmetic) =>
    new AxisMotion(
      arithmetic,
      registersFor(arithmetic, 687194767, -274878),
      cruise(arithmetic).acc,
      400,
      Infinity,
    );

  it("accelerates and cruises for the known ticks", () => {
    expect(ramp("signed")).toMatchObject({ ticks: 2500, acc: 290800 });
    expect(ramp("signed").rateDuring(2500)).toBe(687057561);
    expect(cruise("signed")).toMatchObject({ ticks: 7500, acc: 288100 });
  });

  it("reverses on firmware 3 and loses two steps", () => {
    expect(brake("signed")).toMatchObject({ ticks: 2625, net: 398 });
  });

  it("wraps to full speed on firmware 2.8", () => {
    const motion = brake("half");
    expect(motion).toMatchObject({ ticks: 2501, net: 400 });
    expect(motion.rateDuring(2501)).toBeGreaterThan(0.9 * 2 ** 31);
  });

  it("stops short at a rate above zero on firmware 2.5.3", () => {
    const motion = brake("late");
    expect(motion).toMatchObject({ ticks: 2430, net: 400 });
    expect(motion.rateDuring(2430)).toBeGreaterThan(0);
  });
});
