import { Readable } from "node:stream";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { SerialPort } from "serialport";
import { afterEach, describe, expect, it } from "vitest";
import { openPtyBoard, runBoard, type PtyBoard } from "../../../server/cli/board/board.js";
import { nodeClock } from "../../../server/serial/node-clock.js";
import { VirtualBoard } from "../../../src/index.js";
import { folderOfTest } from "../../support/processes/folders.js";

const boards: PtyBoard[] = [];
const ports: SerialPort[] = [];

afterEach(async () => {
  for (const port of ports.splice(0)) await new Promise<void>((resolve) => port.close(() => resolve()));
  for (const board of boards.splice(0)) await board.close();
});

/** Opens the port; `ask` resolves once the expected number of OKs has arrived. */
async function openPort(path: string) {
  const port = new SerialPort({ path, baudRate: 9600, autoOpen: false });
  await new Promise<void>((resolve, reject) => port.open((error) => (error ? reject(error) : resolve())));
  ports.push(port);
  let text = "";
  let wake = (): void => undefined;
  port.on("data", (bytes: Buffer) => {
    text += bytes.toString("latin1");
    wake();
  });
  const ask = async (lines: string, end: RegExp): Promise<string> => {
    port.write(lines);
    while (!end.test(text)) await new Promise<void>((resolve) => (wake = resolve));
    const answer = text;
    text = "";
    return answer;
  };
  return { port, ask };
}

describe("the virtual board behind a pseudo-terminal", () => {
  it("answers a real serial port, byte for byte", async () => {
    const ptyBoard = await openPtyBoard(
      new VirtualBoard({ clock: nodeClock, firmware: "2.8.1", speed: 100 }),
    );
    boards.push(ptyBoard);
    const { ask } = await openPort(ptyBoard.path);
    expect(await ask("V\r", /\n$/)).toBe("EBBv13_and_above EB Firmware Version 2.8.1\r\n");
    expect(await ask("QS\r", /OK\r\n$/)).toBe("0,0\n\rOK\r\n");
  });

  it("takes thousands of commands written at once and loses none", async () => {
    const ptyBoard = await openPtyBoard(
      new VirtualBoard({ clock: nodeClock, firmware: "3.0.3", speed: 1_000 }),
    );
    boards.push(ptyBoard);
    const { ask } = await openPort(ptyBoard.path);
    const count = 3_000;
    await ask("SM,20,3,5\r".repeat(count), new RegExp(`^(OK\r\n){${count}}$`));
    await ask("SM,20,1,1\rSM,20,1,1\rSM,20,1,1\r", /^(OK\r\n){3}$/);
    expect(ptyBoard.board.statistics().moveCount).toBeGreaterThanOrEqual(count);
  });

  it("is found at the path given on the command line, and saves a picture", async () => {
    const folder = folderOfTest();
    const path = join(folder, "ebb");
    const svg = join(folder, "out.svg");
    let stop = (): void => undefined;
    let said = "";
    let started = (): void => undefined;
    const up = new Promise<void>((resolve) => (started = resolve));
    const run = runBoard(
      { pty: path, svg, speed: 1_000 },
      {
        out: (text) => (said += text),
        err: () => started(),
        isTerminal: false,
        status: () => undefined,
        hasKeyboard: false,
        onInterrupt: (listener) => {
          stop = () => listener(false);
          return () => undefined;
        },
        endWithin: () => undefined,
        onLine: () => () => undefined,
        inputLines: () => Readable.from([]),
      },
    );
    await up;
    const { ask } = await openPort(path);
    await ask("SP,0,600\rSM,100,800,800\rSP,1,10\r", /^(OK\r\n){3}$/);
    await ask("SM,1,0,0\rSM,1,0,0\rQS\r", /800,800\n\rOK\r\n$/);
    stop();
    await run;
    expect(existsSync(path)).toBe(false);
    expect(said).toMatch(/drawn +10\.0 mm in 1 strokes/);
    expect(readFileSync(svg, "utf8")).toContain('<path d="M0 0L10 0"/>');
  });

  it("accepts faults typed to it, and comes back after the cable was unplugged", async () => {
    const folder = folderOfTest();
    const path = join(folder, "ebb");
    let stop = (): void => undefined;
    let type = (_line: string): void => undefined;
    let said = "";
    let heard = (): void => undefined;
    const says = async (pattern: RegExp): Promise<void> => {
      while (!pattern.test(said)) await new Promise<void>((resolve) => (heard = resolve));
      said = "";
    };
    const run = runBoard(
      { pty: path, svg: join(folder, "out.svg"), speed: 1_000 },
      {
        out: () => undefined,
        err: (text) => {
          said += text;
          heard();
        },
        isTerminal: false,
        status: () => undefined,
        hasKeyboard: false,
        onInterrupt: (listener) => {
          stop = () => listener(false);
          return () => undefined;
        },
        endWithin: () => undefined,
        inputLines: () => Readable.from([]),
        onLine: (listener) => {
          type = listener;
          return () => undefined;
        },
      },
    );
    await says(/Ctrl-C/);
    const before = await openPort(path);
    await before.ask("SM,10,8,8\rQC\r", /0394,0297\r\nOK\r\n$/);
    type("volts 5");
    await before.ask("QC\r", /0394,01\d\d\r\nOK\r\n$/);
    type("motionless on");
    await before.ask("SM,10,8,8\rSM,1,0,0\rSM,1,0,0\rQS\r", /8,8\n\rOK\r\n$/);
    type("volts many");
    await says(/Type volts V/);
    type("sneeze");
    await says(/Faults to type/);
    type("unplug");
    await says(/It is back/);
    const after = await openPort(path);
    await after.ask("QS\r", /^8,8\n\rOK\r\n$/);
    stop();
    await run;
  });

  it.each(["grblHAL 1.1f", "FluidNC 3.7.16", "DrawCore 2.09", "Grbl 0.9j", "Grbl 1.1h"])(
    "is a %s for a model with such a controller",
    async (version) => {
      const folder = folderOfTest();
      const path = join(folder, "grbl");
      let stop = (): void => undefined;
      let type = (_line: string): void => undefined;
      let [said, warned] = ["", ""];
      let started = (): void => undefined;
      const up = new Promise<void>((resolve) => (started = resolve));
      const run = runBoard(
        { pty: path, machine: "idraw-h-a3", firmware: version, svg: join(folder, "out.svg"), speed: 100 },
        {
          out: (text) => (said += text),
          err: (text) => {
            warned += text;
            started();
          },
          isTerminal: false,
          status: () => undefined,
          hasKeyboard: false,
          onInterrupt: (listener) => {
            stop = () => listener(false);
            return () => undefined;
          },
          endWithin: () => undefined,
          onLine: (listener) => {
            type = listener;
            return () => undefined;
          },
          inputLines: () => Readable.from([]),
        },
      );
      await up;
      expect(warned).toContain(`with firmware ${version} at`);
      const { ask } = await openPort(path);
      await ask("G1G90Z5F5000\nG1X10F3000\nG1Z0.5\nG4P0\n", /^(ok\r\n){4}$/);
      type("refuse 1");
      await ask("G4P0\n", /error: ?\w.*\r\n$/);
      stop();
      await run;
      expect(said).toMatch(/drawn +10\.0 mm in 1 strokes\n/);
      expect(said).toMatch(/starved +0 times/);
      expect(readFileSync(join(folder, "out.svg"), "utf8")).toContain('id="drawn"');
    },
  );

  it("does not overwrite a file with its link", async () => {
    const folder = folderOfTest();
    await expect(
      runBoard(
        { pty: folder },
        {
          out: () => undefined,
          err: () => undefined,
          isTerminal: false,
          status: () => undefined,
          hasKeyboard: false,
          onInterrupt: () => () => undefined,
          endWithin: () => undefined,
          onLine: () => () => undefined,
          inputLines: () => Readable.from([]),
        },
      ),
    ).rejects.toMatchObject({ code: "bad-setting" });
  });
});
