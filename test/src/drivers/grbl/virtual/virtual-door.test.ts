/** The virtual Grbl's door, holds and other programs, as Grbl's own reference describes them. */
import { describe, expect, it } from "vitest";
import { bench } from "../../../../../src/drivers/grbl/virtual/bench.js";
import type { FaceName } from "../../../../../src/drivers/grbl/virtual/faces.js";
import { VirtualGrbl } from "../../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import { asciiBytes } from "../../../../../src/drivers/line-splitter.js";
import { ManualClock } from "../../../../support/clocks/manual-clock.js";
import { GRBL, GRBL_SERVO } from "../../../../support/machines/machine.js";

const DOOR = "\x84";
const RESET = "\x18";

async function typedAt(face: FaceName = "1.1", machine = GRBL_SERVO, settings = {}) {
  const world = new ManualClock();
  const board = new VirtualGrbl({ clock: world, speed: 1, machine }, { face, settings });
  const line = board.transport();
  let received = "";
  line.onData((bytes) => (received += new TextDecoder().decode(bytes)));
  /** Returns what it answers meanwhile. */
  const type = async (text: string, forS = 0.01): Promise<string> => {
    received = "";
    await line.write(asciiBytes(text));
    await world.advance(forS);
    return received;
  };
  const state = (): string => board.state().state;
  return { world, board, type, state };
}

describe("a door that opens in motion", () => {
  it("brakes, switches the output off, and goes on where it was only after ~ with the door closed", async () => {
    const { world, board, type, state } = await typedAt();
    await type("M3S300\nG1X100F6000\n", 0.5);
    const { xMm } = board.state();
    board.setDoor(true);
    expect(state()).toBe("Door:2");
    await world.advance(0.2);
    expect(state()).toBe("Door:1");
    const stoppedMm = board.state().xMm;
    // It brakes from 100 mm/s at 1,000 mm/s².
    expect(stoppedMm - xMm).toBeCloseTo(5, 1);
    expect(await type("~G4P0\n", 1)).toBe("");
    expect(state()).toBe("Door:1");
    board.setDoor(false);
    expect(state()).toBe("Door:0");
    await type("~", 3.9);
    expect(state()).toBe("Door:3");
    expect(board.state().xMm).toBe(stoppedMm);
    await world.advance(0.2);
    expect(state()).toBe("Run");
    await world.advance(2);
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 100 });
  });

  it("is announced, and a grblHAL numbers its return otherwise", async () => {
    const { board, type, state } = await typedAt("grblHAL");
    await type("M3S300\n");
    board.setDoor(true);
    expect(await type("?")).toMatch(/^<Door:1\|/);
    board.setDoor(false);
    await type("~");
    expect(state()).toBe("Door:4");
    expect(await type(DOOR)).toBe("[MSG:Check Door]\r\n");
    expect(state()).toBe("Door:0");
  });

  it("waits for no spindle that stood", async () => {
    const { type, state } = await typedAt();
    await type(`G1X50F600\n`, 1);
    await type(DOOR, 0.5);
    expect(state()).toBe("Door:0");
    await type("~");
    expect(state()).toBe("Run");
  });
});

describe("an open door", () => {
  it("stops a Grbl that was reset again, and takes its answers", async () => {
    const { board, type, state } = await typedAt();
    board.setDoor(true);
    expect(await type(RESET)).toBe("Grbl 1.1h ['$' for help]\r\n[MSG:Check Door]\r\n");
    expect(await type("$G\n", 5)).toBe("");
    board.setDoor(false);
    expect(await type(RESET)).toBe("Grbl 1.1h ['$' for help]\r\n");
    expect(state()).toBe("Idle");
  });

  it("keeps a locked Grbl locked, and ends a search for switches with ALARM:7", async () => {
    const { board, type, state } = await typedAt("1.1", GRBL_SERVO, { 22: 1 });
    await type("$H\n", 1);
    board.setDoor(true);
    expect(state()).toBe("Alarm");
    expect(await type("$X\n")).toBe("error:13\r\n");
    board.setDoor(false);
    expect(await type("$X\n")).toContain("ok");
  });
});

describe("a hold", () => {
  it("interrupts a wait", async () => {
    const { type, state } = await typedAt("1.1", GRBL);
    await type("G4P1\n", 0.6);
    expect(await type("!", 3)).toBe("");
    expect(state()).toBe("Hold:0");
    expect(await type("~", 0.3)).toBe("");
    expect(await type("", 0.2)).toBe("ok\r\n");
  });
});

describe("another program", () => {
  it("jogs, and a hold ends that; a line that comes meanwhile is refused", async () => {
    const { board, type, state } = await typedAt();
    board.takeFromOther("$J=G91X50F600");
    expect(await type("G1X1F100\n", 1)).toBe("error:9\r\n");
    expect(state()).toBe("Jog");
    await type("!", 0.2);
    expect(state()).toBe("Idle");
    expect(board.state().xMm).toBeCloseTo(10.1, 0);
  });

  it("switches the check of lines on and off, and nothing moves meanwhile", async () => {
    const { board, type, state } = await typedAt();
    board.takeFromOther("$C");
    expect(state()).toBe("Check");
    expect(await type("G1X10F600\nG5X1\n", 3)).toBe("ok\r\nerror:20\r\n");
    expect(board.state()).toMatchObject({ state: "Check", xMm: 0 });
    board.takeFromOther("$C");
    expect(state()).toBe("Idle");
  });
});

it("characters beyond ASCII, of a comment say, act or are dropped", async () => {
  const { type, state } = await typedAt();
  // The second byte of Ä is that of the door.
  expect(await type("(\xc3\x94)\n")).toBe("ok\r\n");
  expect(state()).toBe("Idle");
  await type("(\xc3\x84)\n");
  expect(state()).toBe("Door:0");
});

it("its door and its buttons can be typed", async () => {
  const { board, state } = await typedAt();
  const apply = (name: string, value?: string): boolean => bench.faults[name].apply(board, value);
  expect(apply("door", "ajar")).toBe(false);
  expect(state()).toBe("Idle");
  expect(apply("door", "open")).toBe(true);
  expect(state()).toBe("Door:1");
  expect(apply("door", "close")).toBe(true);
  expect(apply("resume")).toBe(true);
  expect(state()).toBe("Idle");
});
