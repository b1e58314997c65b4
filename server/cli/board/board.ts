/**
 * `plotwright board --pty PATH`: the virtual controller of a plotter behind a pseudo-terminal, for any program that drives
 * one. On exit it reports what was drawn, and saves it as SVG.
 */
import { lstatSync, readlinkSync, rmSync, symlinkSync } from "node:fs";
import { machineById, PlotwrightError, type MachineProfile, type Transport } from "../../../src/index.js";
import { driverOf, type Springs, type VirtualMachine } from "../../../src/internal.js";
import { nodeClock } from "../../serial/node-clock.js";
import { applyFault, faultHelp } from "./board-faults.js";
import { fileFault } from "../../storage/file-fault.js";
import { writeOut } from "../files.js";
import type { CliIo } from "../io.js";
import { Option } from "commander";
import { positive, springs, type Declare } from "../options.js";

export interface BoardCommandOptions {
  /** Where the serial port appears: a link to the pseudo-terminal. */
  readonly pty: string;
  readonly firmware?: string;
  /** Board seconds per second. */
  readonly speed?: number;
  /** Machine id. */
  readonly machine?: string;
  /** How its pen swings; default: it does not. */
  readonly springs?: Springs;
  /** File for the drawn lines; default: drawn.svg. */
  readonly svg?: string;
}

type Served = Pick<VirtualMachine, "transport" | "close">;

export interface PtyBoard<Board extends Served = Served> {
  /** Serial port to open; it changes after `replug`. */
  readonly path: string;
  readonly board: Board;
  /** Calls `listener` when the board has dropped its connection. */
  onDrop(listener: () => void): void;
  /** Plugs in the board again as a new port, after it dropped its connection. False if it is closed. */
  replug(): Promise<boolean>;
  close(): Promise<void>;
}

/** The pseudo-terminal library passes raw bytes if its encoding is null; its types lack this. */
interface RawPty {
  onData(listener: (bytes: Uint8Array) => void): { dispose(): void };
  onExit(listener: () => void): { dispose(): void };
  write(bytes: Uint8Array): void;
  pause(): void;
  resume(): void;
  kill(signal?: string): void;
}

interface OpenPty {
  readonly pty: RawPty;
  readonly path: string;
}

const REPLUG_MS = 1_000;

type PtyModule = typeof import("@lydell/node-pty");

/**
 * Puts a virtual machine behind a pseudo-terminal, so that any program can open it as a serial port.
 *
 * @throws PlotwrightError "no-board" if there are no pseudo-terminals (Windows, or the optional package is missing)
 */
export async function openPtyBoard<Board extends Served>(board: Board): Promise<PtyBoard<Board>> {
  let line: OpenPty | null = null;
  let path = "";
  let isClosed = false;
  let dropped = (): void => undefined;
  const plug = async (): Promise<void> => {
    const opened = await openPty();
    path = opened.path;
    line = opened;
    const transport = board.transport();
    opened.pty.onData((bytes) => void passOn(bytes, transport, opened.pty));
    transport.onData((bytes) => opened.pty.write(bytes));
    transport.onClose(() => {
      if (line !== opened) return;
      void pull();
      dropped();
    });
  };
  const pull = async (): Promise<void> => {
    const pulled = line;
    line = null;
    if (pulled !== null) await closePty(pulled.pty);
  };
  await plug();
  return {
    get path() {
      return path;
    },
    board,
    onDrop: (listener) => (dropped = listener),
    replug: async () => {
      await pull();
      if (!isClosed) await plug();
      return !isClosed;
    },
    close: async () => {
      isClosed = true;
      await pull();
      board.close();
    },
  };
}

/**
 * A board with a full queue stops reading: the kernel's buffer fills, and the sender's write blocks, as with USB. Bytes for
 * a board that has dropped its connection are lost.
 */
async function passOn(bytes: Uint8Array, transport: Transport, pty: RawPty): Promise<void> {
  pty.pause();
  await transport.write(bytes).then(
    () => pty.resume(),
    () => undefined,
  );
}

/** Runs until interrupted. */
export async function runBoard(options: BoardCommandOptions, io: CliIo): Promise<void> {
  const machine = machineById(options.machine ?? "axidraw-v3");
  checkLinkPath(options.pty);
  const { bench, virtualMachine } = await driverOf(machine);
  const { speed = 1, firmware, springs } = options;
  const board = virtualMachine({ clock: nodeClock, machine, speed, firmware, springs });
  const ptyBoard = await openPtyBoard(board);
  try {
    link(ptyBoard.path, options.pty);
  } catch (error) {
    await ptyBoard.close();
    throw error;
  }
  const stopped = new Promise<void>((resolve) => io.onInterrupt(() => resolve()));
  const stopListening = io.onLine((line) => io.err(applyFault(board, bench, line)));
  const dropped = watchDrops(ptyBoard, options.pty, io);
  io.err(
    `Virtual board with firmware ${board.firmware} at ${options.pty} (${ptyBoard.path}). Press Ctrl-C to end it.\n`,
  );
  if (options.speed !== undefined && options.speed !== 1) {
    io.err(
      `It runs ${options.speed} times as fast as real time: plotwright drives it with --device ${options.pty} --virtual-speed ${options.speed}.\n`,
    );
  }
  if (io.isTerminal) io.err(faultHelp(bench.faults));
  try {
    await Promise.race([stopped, dropped]);
  } finally {
    stopListening();
    rmSync(options.pty, { force: true });
    await ptyBoard.close();
  }
  const svg = options.svg ?? "drawn.svg";
  const done = bench.summary(board).map(([name, value]) => `${name.padEnd(14)}${value}\n`);
  if (svg === "-") io.err(done.join(""));
  else io.out(done.join(""));
  writeOut(svg, drawnSvg(board, machine), io);
  if (svg !== "-") io.err(`The drawn lines are in ${svg}.\n`);
}

/** Plugs in a board that dropped its connection again after a second. Rejects if that fails. */
function watchDrops(ptyBoard: PtyBoard, path: string, io: CliIo): Promise<never> {
  const replug = async (): Promise<void> => {
    rmSync(path, { force: true });
    io.err("The board has dropped its connection.\n");
    await new Promise((resolve) => setTimeout(resolve, REPLUG_MS));
    if (!(await ptyBoard.replug())) return;
    link(ptyBoard.path, path);
    io.err(`It is back at ${path} (${ptyBoard.path}).\n`);
  };
  return new Promise((_, reject) => {
    ptyBoard.onDrop(() => void replug().catch(reject));
  });
}

/** The drawn lines, one path per stroke, travel dotted. */
function drawnSvg(board: VirtualMachine, machine: MachineProfile): string {
  const { widthMm, heightMm } = machine;
  const parts = [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${widthMm}mm" height="${heightMm}mm" ` +
      `viewBox="0 0 ${widthMm} ${heightMm}" fill="none" stroke-linecap="round" stroke-linejoin="round">\n`,
  ];
  for (const penDown of [false, true]) {
    const style = penDown
      ? 'id="drawn" stroke="#000" stroke-width="0.3"'
      : 'id="travel" stroke="#7aa" stroke-width="0.1" stroke-dasharray="0.5 1"';
    parts.push(`<g ${style}>\n`);
    for (const line of board.drawn()) {
      if (line.penDown === penDown) parts.push(`<path d="${pathOf(line.xy)}"/>\n`);
    }
    parts.push("</g>\n");
  }
  parts.push("</svg>\n");
  return parts.join("");
}

/** A dot is a line of zero length; round caps make it visible. */
function pathOf(xy: Float64Array): string {
  let d = "";
  for (let i = 0; i < xy.length; i += 2) {
    d += `${i === 0 ? "M" : "L"}${Number(xy[i].toFixed(4))} ${Number(xy[i + 1].toFixed(4))}`;
  }
  return xy.length === 2 ? `${d}h0` : d;
}

/** Throws if `path` is anything but a link. */
function checkLinkPath(path: string): void {
  try {
    if (lstatSync(path).isSymbolicLink()) return;
  } catch {
    return;
  }
  throw new PlotwrightError("bad-setting", `${path} exists and is not a link: choose another --pty path.`);
}

function link(target: string, path: string): void {
  try {
    if (isLink(path)) rmSync(path);
    symlinkSync(target, path);
  } catch (cause) {
    throw new PlotwrightError(
      "bad-setting",
      `${path} can't be made: ${fileFault(cause)}. Choose another --pty path.`,
      {
        cause,
      },
    );
  }
}

function isLink(path: string): boolean {
  try {
    readlinkSync(path);
    return true;
  } catch {
    return false;
  }
}

async function openPty(): Promise<OpenPty> {
  const module = await loadPty();
  // Keep the other end of the terminal open: reading fails while no program has it open.
  const keeper = module.spawn("sh", ["-c", "stty raw -echo; tty; exec sleep 1000000"], {
    name: "dumb",
    encoding: null,
  });
  const pty = keeper as unknown as RawPty;
  const path = await new Promise<string>((resolve, reject) => {
    let text = "";
    const data = pty.onData((bytes) => {
      text += String.fromCharCode(...bytes);
      const match = /(\/\S+)\s/.exec(text);
      if (match === null) return;
      data.dispose();
      exit.dispose();
      resolve(match[1]);
    });
    const exit = pty.onExit(() => reject(noPty(`its keeper ended: ${text.trim()}`)));
  });
  return { pty, path };
}

async function loadPty(): Promise<PtyModule> {
  if (process.platform === "win32") throw noPty("Windows has none");
  try {
    return await import("@lydell/node-pty");
  } catch (cause) {
    throw noPty("the optional package @lydell/node-pty is not installed; npm install adds it", cause);
  }
}

const noPty = (why: string, cause?: unknown): PlotwrightError =>
  new PlotwrightError("no-board", `A pseudo-terminal is required, but not available: ${why}.`, { cause });

function closePty(pty: RawPty): Promise<void> {
  return new Promise((resolve) => {
    pty.onExit(() => resolve());
    pty.resume();
    pty.kill("SIGKILL");
  });
}

export const declareBoard: Declare = (command, { io }) => {
  command
    .requiredOption("--pty <path>", "path where the serial port appears")
    .option(
      "--firmware <version>",
      "firmware of the board, for example 3.0.3 (default: one that the plotter usually has)",
    )
    .addOption(
      new Option("--speed <factor>", "board seconds per real second (default: 1)").argParser(positive),
    )
    .addOption(
      new Option(
        "--springs <x,y>",
        "Hz at which the pen swings, and the damping (15,25,0.05); default: not at all",
      ).argParser(springs),
    )
    .option("--machine <id>", "plotter model (default: axidraw-v3)")
    .option("--svg <file>", "file for the drawn lines, or - for stdout (default: drawn.svg)")
    .action((options: BoardCommandOptions) => runBoard(options, io));
};
