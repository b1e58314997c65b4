/** The command line on virtual Grbls of several versions and ways to report, over real pseudo-terminals. */
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import type { VirtualGrblOptions } from "../../src/drivers/grbl/virtual/virtual-settings.js";
import { machineById, type MachineProfile } from "../../src/index.js";
import { GRBL } from "../support/machines/machine.js";
import { cli } from "../support/processes/command-line.js";
import { folderOfTest } from "../support/processes/folders.js";
import { PtyGrbl } from "../support/processes/pty-grbl.js";

const SPEED = 20;

let dir: string;
let drawing: string;
let profile: string;
let board: PtyGrbl;
beforeEach(() => {
  dir = folderOfTest();
  drawing = join(dir, "line.svg");
  profile = join(dir, "my-grbl.json");
  writeFileSync(profile, JSON.stringify(GRBL));
  writeFileSync(
    drawing,
    '<svg xmlns="http://www.w3.org/2000/svg" width="80mm" height="50mm" viewBox="0 0 80 50" fill="none" stroke="#000"><path d="M10 10H60V40"/></svg>',
  );
});
afterEach(() => board.close());

const open = async (options: VirtualGrblOptions, machine: MachineProfile = GRBL): Promise<void> => {
  board = await PtyGrbl.open({ ...options, machine, speed: SPEED });
};
const plotWith = (...machine: string[]): ReturnType<typeof cli> =>
  cli("plot", drawing, ...machine, "--device", board.path, "--virtual-speed", String(SPEED), "--data", dir);
/** Sends one line. */
const raw = (line: string, ...machine: string[]): ReturnType<typeof cli> =>
  cli("raw", line, ...machine, "--device", board.path, "--data", dir);
const drawn = async (): Promise<number[][]> =>
  (await board.report()).drawn.flatMap(({ penDown, xy }) => (penDown && xy.length > 2 ? [[...xy]] : []));
const LINE = [[10, 10, 60, 10, 60, 40]];

describe("a Grbl 0.9", () => {
  it.each([3, 7, 15, 31])("draws if its reports have both positions: report mask %i", async (mask) => {
    await open({ face: "0.9", settings: { 10: mask } });
    expect(await plotWith("--machine-file", profile)).toMatchObject({ code: 0 });
    expect(await drawn()).toEqual(LINE);
  });

  it.each([1, 2, 5])(
    "moves nothing if they lack one, until another mask is sent: report mask %i",
    async (mask) => {
      await open({ face: "0.9", settings: { 10: mask } });
      const refused = await plotWith("--machine-file", profile);
      expect(refused).toMatchObject({ code: 2 });
      expect(refused.err).toMatch(/\(\$10\).* Nothing has moved\. Send \$10=3 in the console\./);
      expect((await board.report()).state).toMatchObject({ xMm: 0, yMm: 0, movingS: 0 });
      expect(await raw("$10=3", "--machine-file", profile)).toMatchObject({ code: 0 });
      expect(await plotWith("--machine-file", profile)).toMatchObject({ code: 0 });
      expect(await drawn()).toEqual(LINE);
    },
  );

  it.each([0, 12])("is not connected if they have no position: report mask %i", async (mask) => {
    await open({ face: "0.9", settings: { 10: mask } });
    const { code, err } = await plotWith("--machine-file", profile);
    expect(code).toBe(4);
    expect(err).toMatch(/\(\$10\).* Nothing has moved\. Send \$10=3 with another program\./);
    expect((await board.report()).state).toMatchObject({ xMm: 0, yMm: 0, movingS: 0 });
  });
});

describe("a DrawCore that was running before its port was opened", () => {
  const A3 = ["--machine", "idraw-h-a3"];

  it("draws with the model of an iDraw H", async () => {
    await open({ face: "DrawCore" }, machineById("idraw-h-a3"));
    expect(await plotWith(...A3)).toMatchObject({ code: 0 });
    expect((await board.report()).state).toMatchObject({ penUp: true, xMm: 0, yMm: 0 });
    expect(await drawn()).toHaveLength(1);
  });

  it("is locked as it is delivered, until the user unlocks it", async () => {
    await open({ face: "DrawCore", settings: { 22: 1 } }, machineById("idraw-h-a3"));
    const { code, err } = await plotWith(...A3);
    expect(code).toBe(5);
    expect(err).toMatch(/locked until it is homed \(\$22=1\).* send \$X in the console\./);
    expect((await board.report()).state).toMatchObject({ state: "Alarm", movingS: 0 });
    expect(await raw("$X", ...A3)).toMatchObject({ code: 0 });
    expect(await plotWith(...A3)).toMatchObject({ code: 0 });
    expect(await drawn()).toHaveLength(1);
  });

  it("draws without arcs also if the profile says arcs", async () => {
    await open({ face: "DrawCore" });
    expect(await plotWith("--machine-file", profile)).toMatchObject({ code: 0 });
  });
});
