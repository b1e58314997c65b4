/**
 * What plotwright asks of a controller. A driver is a folder beside this file and a line in `registry.ts`; nothing
 * outside its folder knows its commands.
 *
 *   PlanForMachine ──────> MachineJob   the motion and its commands, without a machine
 *   Driver ──identify──> Machine      one that is connected: pen, moves by hand, supply, console
 *                          └──startRun──> MachineRun   one plot: play, hold, stop, go over to another plan
 *
 * A controller may follow our plan (EBB) or plan by itself (Grbl): then its trajectory is a model of what it does.
 */
import type { StrokeSet } from "../drawing/stroke-set.js";
import type { PlotwrightError } from "../errors.js";
import type { MachineProfile } from "../machines/profile.js";
import type { Place } from "../plan/trajectory.js";
import type { MachineSettings, MachineState, PlannedPlot } from "./machine-job.js";
import type { PlotProgress, RunProgress } from "./run-progress.js";
import type { Clock, Transport } from "./transport.js";

/** A kind of USB device, in hexadecimal, lower case. */
export interface UsbId {
  readonly vendorId: string;
  readonly productId: string;
}

export interface Driver {
  /** Devices that are surely this controller: "auto" takes the first. None: the user names the port. */
  readonly usbIds: readonly UsbId[];
  /** Learns who is at the other end. Closes the line and rejects when it is nobody that this driver knows. */
  identify(transport: Transport, options: ConnectOptions): Promise<Machine>;
  /** The controller in software, to plot without hardware. */
  virtualMachine(options: VirtualMachineOptions): VirtualMachine;
}

export interface ConnectOptions {
  /** Counts our seconds. */
  readonly clock: Clock;
  /** Counts the machine's seconds. */
  readonly machineClock: Clock;
  /** The machine's seconds in one of ours; only a virtual machine is ever not 1. */
  readonly speed: number;
  readonly events: MachineEvents;
}

export interface MachineEvents {
  /** Pen, motors or place have changed. */
  changed(): void;
  /** The button on the machine was pressed while it plotted. */
  buttonPressed(): void;
  /** One reading of the motors' supply while it plotted. A single one may be wrong. */
  supplyRead(isLow: boolean): void;
  /** The line or the controller has failed; the machine is of no use any more. */
  lost(error: PlotwrightError): void;
}

export interface VirtualMachineOptions {
  readonly clock: Clock;
  readonly speed: number;
  readonly machine: MachineProfile;
  /** Version that it shows; left out: the driver's usual one. */
  readonly firmware?: string | undefined;
}

export interface VirtualMachine {
  /** A new line to it: the machine stays as it is when a line is closed. */
  transport(): Transport;
  close(): void;
}

/** One connected machine. Places are mm from home; null where nobody knows. */
export interface Machine {
  readonly firmware: string;
  /** The controller's own name; null where it has none. */
  readonly name: string | null;
  /** Counts the machine's seconds. */
  readonly clock: Clock;
  /** The machine's seconds in one of ours. */
  readonly speed: number;
  readonly penUp: boolean | null;
  readonly motorsOn: boolean | null;
  /** Until something moves: how a machine stood that had kept its place when it was connected. */
  readonly left: { readonly penUp: boolean } | null;
  /** What the next job has to begin from; null while its place is not known. */
  readonly state: MachineState | null;
  place(profile: MachineProfile): { readonly x: number; readonly y: number } | null;

  /** After connecting: what a machine has kept from before. Lifts a pen that was left on the paper. */
  takeOver(): Promise<void>;
  /** Motors on, where they are off. Where the place is not known, here is home. */
  ready(profile: MachineProfile, pen: MachineSettings["pen"]): Promise<MachineState>;
  /** Resolves when the pen is there. */
  movePen(up: boolean, settings: MachineSettings, heightPct?: number): Promise<void>;
  /** To a raw position of the pen's servo. */
  moveServo(profile: MachineProfile, pos: number): Promise<void>;
  /** Pen up, in a straight line to a place, at travel speed. */
  walk(xMm: number, yMm: number, settings: MachineSettings): Promise<void>;
  /** Plays a job that ends with the pen up, with no run around it. */
  perform(plot: PlannedPlot, settings: MachineSettings): Promise<void>;
  /** Here is home from now on. */
  setHome(profile: MachineProfile, pen: MachineSettings["pen"]): Promise<void>;
  /** Finds home by the machine's own switches; false, with nothing moved, where it has none. */
  findHome(settings: MachineSettings): Promise<boolean>;
  /** Lets the carriage be pushed by hand; its place is not known then. */
  motorsOff(): Promise<void>;
  /** Something else has moved the carriage. */
  forgetPlace(): Promise<void>;
  /** After the place is lost: pen up, motors off. */
  letGo(settings: MachineSettings): Promise<void>;
  /** Before the line is given up in the middle of something: stops at once, pen up. */
  leave(settings: MachineSettings): Promise<void>;
  /** A move by hand ends with `conflict`, and the place is read back. */
  stopAtOnce(): void;

  /** Asks; false too where the controller cannot tell. */
  isSupplyLow(): Promise<boolean>;
  /** How long the motors may still run after an emergency stop. */
  emergencyStopMs(settings: MachineSettings): number;
  /** One line that the user has typed. Rejects with `bad-setting` for what would end the talk. */
  command(line: string): Promise<ConsoleAnswer>;
  /** What was said on the line, as text to be downloaded. */
  log(): string;
  startRun(request: RunRequest): MachineRun;
  close(): Promise<void>;
}

export interface ConsoleAnswer {
  readonly replies: string[];
  /** What became of place or pen; null: nothing. */
  readonly note: string | null;
}

export interface RunRequest {
  readonly strokes: StrokeSet;
  /** As they stand now: they may change on the way. */
  settings(): MachineSettings;
  readonly events: RunEvents;
}

export interface RunEvents {
  tell(progress: PlotProgress): void;
  /** A play has ended, however it did; `place`: the first that is still to be drawn, null where that is not known. */
  ended(place: Place | null): void;
}

/** One plot on a machine. What is to be drawn, and when, is said by the caller. */
export interface MachineRun {
  readonly progress: RunProgress;
  /** What plays now, another object for each play; null at rest. */
  readonly playing: object | null;
  /** Set when a play was stopped on purpose: what is still to be drawn then. */
  readonly stopped: { readonly place: Place | null } | null;
  /** What the machine will be given next is from there on: it draws up to there by itself. */
  readonly sentPlace: Place | undefined;
  /** Plays a plan to its end, or to the rest that was asked for; `afterS`: what of the plot follows its end. */
  play(plot: PlannedPlot, afterS: number, begun: () => void): Promise<void>;
  /** Where the pen is now; null at rest. */
  now(): PlotProgress | null;
  /** Slows down along the path and lifts the pen; `play` ends. */
  slowToRest(): void;
  /** Drops what the machine has; `play` ends with the place read back. */
  stopAtOnce(): void;
  /** Stops the motors for good: what plays, or would be played next, fails with the error. */
  fail(error: PlotwrightError): void;
  /** On its way to another plan; until it is there, it can't be told to go to a third one. */
  readonly isGoingOver: boolean;
  /**
   * A place at least `leadS` ahead where another plan can take over in motion; null when what is left is too short, or
   * the controller cannot do it: then a change waits for the next rest.
   */
  placeAhead(leadS: number): PlaceAhead | null;
}

/** Where another plan can take over: plan on `from` there, at `x`, `y` in mm. */
export interface PlaceAhead {
  readonly from: Place;
  readonly x: number;
  readonly y: number;
  /** How the machine will stand there. */
  readonly board: MachineState;
  /** Goes over to a plan from there; false when the machine has got there meanwhile. */
  goOver(plot: PlannedPlot, afterS: number): boolean;
}
