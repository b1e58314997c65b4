/**
 * What plotwright needs from a controller. A driver is a folder beside this file and its names in `registry.ts`;
 * nothing outside its folder knows its commands.
 *
 *   ControllerDescription    the fields in a machine's profile, USB ids, versions
 *   PlanForMachine ──────> MachineJob   the motion and its commands, without a machine
 *   Driver ──identify──> Machine      a connected one: pen, moves by hand, supply, console
 *                          └──startRun──> MachineRun   one plot: play, hold, stop, switch to another plan
 *
 * A controller may follow our plan (EBB) or plan by itself (Grbl). In the second case its trajectory is a
 * model of what it does.
 */
import type { StrokeSet } from "../drawing/stroke-set.js";
import type { PlotwrightError } from "../errors.js";
import type { Controller, ControllerFields } from "../machines/controller.js";
import type { MachineProfile } from "../machines/profile.js";
import type { Place } from "../plan/trajectory.js";
import type { FirmwareRules, MachineSettings, MachineState, PlannedPlot } from "./machine-job.js";
import type { PlotProgress, RunProgress } from "./run-progress.js";
import type { Clock, Transport } from "./transport.js";

/** A kind of USB device, in hexadecimal, lower case. */
export interface UsbId {
  readonly vendorId: string;
  readonly productId: string;
}

/** What is known about a controller without planning for it or talking to it. */
export interface ControllerDescription {
  /** Its fields in a machine's profile. */
  readonly fields: ControllerFields;
  /** A contradiction between valid fields, and the field to change; left out: there is none. */
  readonly contradictionOf?: (controller: Controller) => { field: string; message: string } | null;
  /** Devices that are certainly this controller: "auto" takes the first. Empty: the user names the port. */
  readonly usbIds: readonly UsbId[];
  readonly firmware: FirmwareRules;
  /**
   * Settings that do not change its plots: their labels by path, such as "motion.layers.*.cornerMm". Left out: none.
   */
  readonly unusedSettings?: Readonly<Record<string, string>>;
}

export interface Driver {
  /** Finds out what is connected. Closes the connection and rejects if this driver does not know it. */
  identify(transport: Transport, options: ConnectOptions): Promise<Machine>;
  /** A simulated controller, to plot without hardware. */
  virtualMachine(options: VirtualMachineOptions): VirtualMachine;
}

export interface ConnectOptions {
  /** Counts seconds of this computer. */
  readonly clock: Clock;
  /** Counts the machine's seconds. */
  readonly machineClock: Clock;
  /** The machine's seconds per second of this computer; not 1 only for a virtual machine. */
  readonly speed: number;
  readonly events: MachineEvents;
}

export interface MachineEvents {
  /** Pen, motors or position have changed. */
  changed(): void;
  /** The button on the machine was pressed during a plot. */
  buttonPressed(): void;
  /** One reading of the motors' supply during a plot. A single one may be wrong. */
  supplyRead(isLow: boolean): void;
  /** The connection or the controller has failed; this machine cannot be used any more. */
  lost(error: PlotwrightError): void;
}

export interface VirtualMachineOptions {
  readonly clock: Clock;
  readonly speed: number;
  readonly machine: MachineProfile;
  /** The version it reports; default: the driver's choice. */
  readonly firmware?: string | undefined;
}

export interface VirtualMachine {
  /** Opens a new connection to it. The machine keeps its state when a connection is closed. */
  transport(): Transport;
  close(): void;
}

/** One connected machine. Positions are mm from home; null if unknown. */
export interface Machine {
  readonly firmware: string;
  /** The controller's own name; null if it has none. */
  readonly name: string | null;
  /** Counts the machine's seconds. */
  readonly clock: Clock;
  /** The machine's seconds per second of this computer. */
  readonly speed: number;
  readonly penUp: boolean | null;
  readonly motorsOn: boolean | null;
  /**
   * Set until something moves: how the machine was found, if it still knew its position when it was
   * connected.
   */
  readonly left: { readonly penUp: boolean } | null;
  /** Where and how the next job begins; null while the position is unknown. */
  readonly state: MachineState | null;
  place(profile: MachineProfile): { readonly x: number; readonly y: number } | null;

  /** Called after connecting: reads the state that the machine kept. Lifts a pen that was left on the paper. */
  takeOver(): Promise<void>;
  /** Switches the motors on if they are off. If the position is unknown, this place becomes home. */
  ready(profile: MachineProfile, pen: MachineSettings["pen"]): Promise<MachineState>;
  /** Resolves when the pen has arrived. */
  movePen(up: boolean, settings: MachineSettings, heightPct?: number): Promise<void>;
  /** Moves the pen's servo to a raw position. */
  moveServo(profile: MachineProfile, pos: number): Promise<void>;
  /** Lifts the pen and moves in a straight line to a position, at travel speed. */
  walk(xMm: number, yMm: number, settings: MachineSettings): Promise<void>;
  /** Plays a job that ends with the pen up, outside any run. */
  perform(plot: PlannedPlot, settings: MachineSettings): Promise<void>;
  /** Makes this place home. */
  setHome(profile: MachineProfile, pen: MachineSettings["pen"]): Promise<void>;
  /** Finds home with the machine's own switches. False if it has none; nothing moves then. */
  findHome(settings: MachineSettings): Promise<boolean>;
  /** Lets the carriage be pushed by hand; its position is unknown from then on. */
  motorsOff(): Promise<void>;
  /** Something else has moved the carriage. */
  forgetPlace(): Promise<void>;
  /** After the position is lost: pen up, motors off. */
  letGo(settings: MachineSettings): Promise<void>;
  /** Before the connection is closed during motion: stops at once, pen up. */
  leave(settings: MachineSettings): Promise<void>;
  /** Stops a move by hand, which rejects with `conflict`, and reads the position back. */
  stopAtOnce(): void;

  /** Asks the machine. False too if the controller cannot tell. */
  isSupplyLow(): Promise<boolean>;
  /** How long the motors may keep running after an emergency stop. */
  emergencyStopMs(settings: MachineSettings): number;
  /** One line that the user typed. Rejects with `bad-setting` for a line that would break the communication. */
  command(line: string): Promise<ConsoleAnswer>;
  /** The log of the communication, as text to download. */
  log(): string;
  startRun(request: RunRequest): MachineRun;
  close(): Promise<void>;
}

export interface ConsoleAnswer {
  readonly replies: string[];
  /** What happened to the position or the pen; null: nothing. */
  readonly note: string | null;
}

export interface RunRequest {
  readonly strokes: StrokeSet;
  /** The current settings; they may change during the plot. */
  settings(): MachineSettings;
  readonly events: RunEvents;
}

export interface RunEvents {
  tell(progress: PlotProgress): void;
  /** A play has ended, for whatever reason; `place`: the first that is still to be drawn, null if unknown. */
  ended(place: Place | null): void;
}

/** One plot on a machine. The caller decides what is drawn, and when. */
export interface MachineRun {
  readonly progress: RunProgress;
  /** What is playing now, a new object for each play; null at rest. */
  readonly playing: object | null;
  /** Set when a play was stopped on purpose: what is still to be drawn. */
  readonly stopped: { readonly place: Place | null } | null;
  /** The machine already has everything up to this place and will draw it; what it receives next begins here. */
  readonly sentPlace: Place | undefined;
  /** Plays a plan to its end, or to a hold; `afterS`: time of the plot after the end of this plan. */
  play(plot: PlannedPlot, afterS: number, begun: () => void): Promise<void>;
  /** Current position of the pen; null at rest. */
  now(): PlotProgress | null;
  /** Slows down along the path and lifts the pen; `play` ends. */
  slowToRest(): void;
  /** Drops what the machine has queued; `play` ends and the position is read back. */
  stopAtOnce(): void;
  /** Stops the motors for good: the current play, or the next one, fails with the error. */
  fail(error: PlotwrightError): void;
  /** Switching to another plan; until that is done, no third plan is accepted. */
  readonly isGoingOver: boolean;
  /**
   * A place at least `leadS` ahead where another plan can take over in motion. Null if too little is left, or
   * if the controller cannot do it: a change then waits for the next rest.
   */
  placeAhead(leadS: number): PlaceAhead | null;
}

/** Where another plan can take over: plan from `from`, at `x`, `y` in mm. */
export interface PlaceAhead {
  readonly from: Place;
  readonly x: number;
  readonly y: number;
  /** The machine's state there. */
  readonly board: MachineState;
  /** Switches to a plan that begins there; false if the machine has already passed the place. */
  goOver(plot: PlannedPlot, afterS: number): boolean;
}
