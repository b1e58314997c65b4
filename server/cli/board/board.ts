/**
 * `plotwright board --pty PATH`: a virtual EiBotBoard behind a pseudo-terminal, for any program that drives one.
 * On exit it reports what was drawn, and saves it as SVG.
 */
import { lstatSync, readlinkSync, rmSync, symlinkSync } from "node:fs";
import { machineById, PlotwrightError, VirtualBoard, type MachineProfile } from "../../../src/index.js";
import type { Springs } from "../../../src/internal.js";
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

export interface PtyBoardOptions {
  readonly firmware?: string;
  readonly speed?: number;
  readonly machine?: MachineProfile;
  readonly springs?: Springs;
}

export interface PtyBoard {
  /** Serial port to open; it changes after `replug`. */
  readonly path: string;
  readonly board: VirtualBoard;
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
 * A virtual board that any program can open as a serial port.
 *
 * @throws PlotwrightError "no-board" if there are no pseudo-terminals (Windows, or the optional package is missing)
 */
export async function openPtyBoard(options: PtyBoardOptions = {}): Promise<PtyBoard> {
  const board = new VirtualBoard({ clock: nodeClock, ...options });
  let line: OpenPty | null = null;
  let path = "";
  let isClosed = false;
  const plug = async (): Promise<void> => {
    const opened = await openPty();
    path = opened.path;
    // A board with a full queue stops reading: the kernel's buffer fills, and the sender's write blocks, as with USB.
    opened.pty.onData((bytes) => {
      if (line !== opened) return;
      board.receive(bytes);
      if (!board.accepting) opened.pty.pause();
    });
    line = opened;
  };
  const pull = async (): Promise<void> => {
    const pulled = line;
    line = null;
    if (pulled !== null) await closePty(pulled.pty);
  };
  board.onSend((bytes) => line?.pty.write(bytes));
  board.onDrain(() => line?.pty.resume());
  board.onDrop(() => void pull());
  await plug();
  return {
    get path() {
      return path;
    },
    board,
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

/** Runs until interrupted. */
export async function runBoard(options: BoardCommandOptions, io: CliIo): Promise<void> {
  const machine = machineById(options.machine ?? "axidraw-v3");
  checkLinkPath(options.pty);
  const ptyBoard = await openPtyBoard({
    machine,
    ...(options.firmware === undefined ? {} : { firmware: options.firmware }),
    ...(options.speed === undefined ? {} : { speed: options.speed }),
    ...(options.springs === undefined ? {} : { springs: options.springs }),
  });
  const { board } = ptyBoard;
  try {
    link(ptyBoard.path, options.pty);
  } catch (error) {
    await ptyBoard.close();
    throw error;
  }
  const stopped = new Promise<void>((resolve) => io.onInterrupt(() => resolve()));
  const stopListening = io.onLine((line) => io.err(applyFault(board, line)));
  const dropped = watchDrops(ptyBoard, options.pty, io);
  io.err(
    `Virtual board with firmware ${board.firmware} at ${options.pty} (${ptyBoard.path}). Press Ctrl-C to end it.\n`,
  );
  if (options.speed !== undefined && options.speed !== 1) {
    io.err(
      `It runs ${options.speed} times as fast as real time: plotwright drives it with --device ${options.pty} --virtual-speed ${options.speed}.\n`,
    );
  }
  if (io.isTerminal) io.err(faultHelp());
  try {
    await Promise.race([stopped, dropped]);
  } finally {
    stopListening();
    rmSync(options.pty, { force: true });
    await ptyBoard.close();
  }
  const svg = options.svg ?? "drawn.svg";
  if (svg === "-") io.err(summary(board));
  else io.out(summary(board));
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
    ptyBoard.board.onDrop(() => void replug().catch(reject));
  });
}

function summary(board: VirtualBoard): string {
  const s = board.statistics();
  const state = board.state();
  const rows: [string, string][] = [
    ["drawn", `${s.drawnMm.toFixed(1)} mm in ${board.drawn().filter((line) => line.penDown).length} strokes`],
    ["travelled", `${s.travelMm.toFixed(1)} mm`],
    ["pen moves", `${s.penMoveCount}`],
    ["moves", `${s.moveCount} in ${s.movingS.toFixed(2)} s, ${s.busyS.toFixed(2)} s with pen waits`],
    ["underruns", `${s.underrunCount}, ${(s.underrunS * 1e3).toFixed(1)} ms in all`],
    ["largest jump", `${s.largestJumpMmPerS.toFixed(2)} mm/s`],
    ["step counters", `${state.steps1}, ${state.steps2}`],
    ["position", `${state.xMm.toFixed(3)}, ${state.yMm.toFixed(3)} mm`],
  ];
  return rows.map(([name, value]) => `${name.padEnd(14)}${value}\n`).join("");
}

/** The drawn lines, one path per stroke, travel dotted. */
function drawnSvg(board: VirtualBoard, machine: MachineProfile): string {
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
    .option("--firmware <version>", "firmware version of the board (default: 2.8.1, of a NextDraw 3.0.3)")
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
