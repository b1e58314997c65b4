/**
 * The interfaces of a controller's driver. A driver is a folder beside this file, listed in `registry.ts`. Code outside
 * the folder does not know its commands.
 *
 *   ControllerDescription    the fields in a machine's profile, USB ids, versions
 *   PlanForMachine ──────> MachineJob   the motion and its commands; needs no connected machine
 *   Driver ──identify──> Machine      a connected machine: pen, manual moves, and optional parts such as a console
 *                          └──startRun──> Playback   one plot: play, hold, stop, switch to another plan
 *
 * A controller either follows our plan (EBB) or plans by itself (Grbl). In the second case the trajectory is a model of
 * the controller's own planning.
 */
import type { StrokeSet } from "../drawing/stroke-set.js";
import type { PlotwrightError } from "../errors.js";
import type { Controller, ControllerFields, MachineProfile, Springs } from "../machines/profile.js";
import type { StrokePosition, Trajectory } from "../plan/trajectory.js";
import type { Cancellation } from "../prepare/work.js";
import type { DrawnPolyline } from "./drawn-polylines.js";
import type { FirmwareRules, MachineSettings, MachineState, PlannedPlot } from "./machine-job.js";
import type { PenMoment, PlotProgress, PlaybackProgress } from "./playback-progress.js";
import type { Clock, Transport } from "./transport.js";

/** A kind of USB device, in hexadecimal, lower case. */
export interface UsbId {
  readonly vendorId: string;
  /** Left out: all products of that vendor. */
  readonly productId?: string;
}

/** Static facts about a controller: available without planning and without a connection. */
export interface ControllerDescription {
  /** Its fields in a machine's profile. */
  readonly fields: ControllerFields;
  /** Optional fields that exclude each other, for forms. Left out: none do. */
  readonly choice?: ControllerChoice;
  /** Finds a contradiction between valid fields, and the field to change. Left out: no fields can contradict. */
  readonly contradictionOf?: (controller: Controller) => { field: string; message: string } | null;
  /** Whether a machine finds home by itself. Left out: none does. */
  readonly findsHome?: (machine: MachineProfile) => boolean;
  /** Devices that are certainly this controller; the port "auto" takes the first. */
  readonly usbIds: readonly UsbId[];
  /** USB chips of its boards that other devices have too: "auto" asks these devices, and takes the first that answers. */
  readonly candidateIds: readonly UsbId[];
  readonly firmware: FirmwareRules;
  /** Lines that a user may type in the console and that change nothing, for a hint. */
  readonly consoleExamples: readonly [string, ...string[]];
  /**
   * Labels of the settings that do not affect its plots, by path, such as "motion.layers.*.cornerMm". Left out: none.
   */
  readonly unusedSettings?: Readonly<Record<string, string>>;
  /**
   * For a controller that is told where to go in mm: it mixes the motors and counts steps by itself. Its own settings of
   * the steps per mm of its two axes. Left out: it is told steps.
   */
  readonly scaleSettings?: readonly [first: string, second: string];
}

/** One of several groups of fields that a profile has, such as the ways to lift a pen. */
export interface ControllerChoice {
  readonly label: string;
  /** `fields`: their names. The first one tells which option a profile has. */
  readonly options: readonly { readonly label: string; readonly fields: readonly string[] }[];
}

export interface Driver {
  /**
   * Asks a device, which may be anything, for its name and version, such as "Grbl 1.1h". It only sends questions: they must
   * not move or change other devices. Null: none of this driver's boards answers. Closes the connection.
   */
  ask(transport: Transport, clock: Clock): Promise<string | null>;
  /** Identifies the connected board. Closes the connection and rejects if it is not one of this driver's. */
  identify(transport: Transport, options: ConnectOptions): Promise<Machine>;
  /** A simulated controller, to plot without hardware. */
  virtualMachine(options: VirtualMachineOptions): VirtualMachine;
  readonly bench: VirtualBench;
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
  /** One reading of the motors' supply during a plot. A single "low" may be wrong. */
  supplyRead(state: SupplyState): void;
  /** The connection or the controller has failed; this object cannot be used any more. */
  lost(error: PlotwrightError): void;
}

/** The motors' supply. "failed": it is good, but has failed since the last reading, as far as the board notices that. */
export type SupplyState = "good" | "low" | "failed";

export interface VirtualMachineOptions {
  readonly clock: Clock;
  readonly speed: number;
  readonly machine: MachineProfile;
  /** The version it reports; default: the driver's choice. */
  readonly firmware?: string | undefined;
  /** How its pen swings; default: not at all. */
  readonly springs?: Springs | undefined;
}

export interface VirtualMachine {
  /** The version that it reports. */
  readonly firmware: string;
  /** Opens a new connection to it. The machine keeps its state when a connection is closed. */
  transport(): Transport;
  /** Its lines and travels so far, mm from home. */
  drawn(): readonly DrawnPolyline[];
  close(): void;
}

/** For the authors of programs that drive the simulated controller. */
export interface VirtualBench {
  /** By the first word of `usage`. */
  readonly faults: Readonly<Record<string, VirtualFault>>;
  /** What the machine has done: names and values. */
  summary(machine: VirtualMachine): readonly (readonly [name: string, value: string])[];
}

/** An event or a fault that a user can cause. */
export interface VirtualFault {
  /** What to type, for example "volts V". */
  readonly usage: string;
  readonly does: string;
  /** False if the value is invalid. */
  apply(machine: VirtualMachine, value: string | undefined): boolean;
}

/** A machine when its connection was lost. */
export interface PenBefore {
  /** Null: the pen may have been on the paper. */
  readonly penUp: boolean | null;
  /** Its `memory`. Left out or null: it had none. */
  readonly memory?: object | null;
}

/** One connected machine: its motion, its runs, and the parts that it has. Positions are mm from home; null if unknown. */
export interface Machine extends MachineParts {
  readonly firmware: string;
  /** Counts the machine's seconds. */
  readonly clock: Clock;
  /** The machine's seconds per second of this computer. */
  readonly speed: number;
  readonly penUp: boolean | null;
  /** The pen is still moving to that state. */
  readonly penMoving: boolean;
  readonly motorsOn: boolean | null;
  /** Where and how the next job begins; null while the position is unknown. */
  readonly state: MachineState | null;
  positionMm(profile: MachineProfile): { readonly x: number; readonly y: number } | null;

  /**
   * Called after connecting: reads the state that the machine kept, and lifts a pen that was left on the paper. `before`:
   * the pen when an earlier connection to the machine was lost; null: there was none.
   */
  readKeptState(settings: MachineSettings, before: PenBefore | null): Promise<void>;
  /**
   * Switches the motors on if they are off. If the position is unknown, a machine that can finds home; otherwise the
   * current position becomes home.
   */
  prepareMotors(settings: MachineSettings): Promise<MachineState>;
  /** Resolves when the pen has arrived. */
  movePen(up: boolean, settings: MachineSettings, heightPct?: number): Promise<void>;
  /** Lifts the pen and moves in a straight line to a position, at travel speed. */
  moveTo(xMm: number, yMm: number, settings: MachineSettings): Promise<void>;
  /** Plays a job that ends with the pen up, outside any run. */
  perform(plot: PlannedPlot, settings: MachineSettings): Promise<void>;
  startPlayback(request: PlaybackRequest): Playback;
  /** Makes the current position home. */
  setHome(settings: MachineSettings): Promise<void>;
  /** Switches the motors off, so that the carriage can be pushed by hand. Its position is then unknown. */
  motorsOff(): Promise<void>;
  /** Call when something else has moved the carriage: its position is then unknown. */
  forgetPosition(): Promise<void>;
  /** Call after the position is lost. */
  liftAndFreeMotors(settings: MachineSettings): Promise<void>;

  /** Stops a manual move, which then rejects with `conflict`, and reads the position back. */
  stopAtOnce(): void;
  /**
   * The signal for a move that begins now: `stopAtOnce` aborts it, and later moves get another one. A move of several
   * steps checks it before each: a stop between two of them finds no motion to stop, but must end the move.
   */
  readonly stopSignal: StopSignal;
  /** Call before the connection is closed during motion: stops at once and lifts the pen. */
  stopAndLift(settings: MachineSettings): Promise<void>;
  /** How long the motors may keep running after an emergency stop. */
  emergencyStopMs(settings: MachineSettings): number;

  /** The log of the communication, as text to download. */
  log(): string;
  close(): Promise<void>;
}

/** Tells the steps of a manual move that the user has stopped it. Like an AbortSignal, which `src` cannot use. */
export interface StopSignal extends Cancellation {
  /** @throws PlotwrightError "conflict" */
  throwIfAborted(): void;
}

/** What only some controllers have. Left out or null: this one does not. */
interface MachineParts {
  /** The controller's own name. */
  readonly name?: string | null;
  /** What the user should know about this machine before plotting, in words. */
  readonly note?: string | null;
  /**
   * How the machine was found, if an unfinished plot had moved it last and it still knew its position when it was
   * connected. Null after the first move.
   */
  readonly foundMidPlot?: FoundMidPlot | null;
  /** A servo that moves the pen. */
  readonly servo?: ServoPart;
  /** What this machine itself does not keep, for the next connection to it. Only its driver reads the content. */
  readonly memory?: object | null;
  /** Moves the pen with an axis that does not find its height by itself. */
  readonly height?: HeightPart;
  /** Measures the motors' supply. */
  readonly supply?: SupplyPart;
  /** Asks a machine without `supply` for anything, to notice if it no longer answers. */
  ping?(): Promise<void>;
  /** Finds home with switches. */
  readonly homing?: HomingPart;
  /** Takes lines that the user types. */
  readonly console?: ConsolePart;
}

interface ServoPart {
  /** Moves the servo to a raw position. */
  moveTo(pos: number, settings: MachineSettings): Promise<void>;
}

export interface HeightPart {
  /** The controller counts from wherever the pen was when it was reset or switched on. */
  readonly isUnsure: boolean;
  /** The user has brought the pen to the height at which the machine is switched on. Does nothing if the height is sure. */
  isAsSwitchedOn(): Promise<void>;
}

interface SupplyPart {
  read(): Promise<SupplyState>;
}

interface HomingPart {
  /** False if the machine's profile has no switches; nothing moves then. */
  seekHome(settings: MachineSettings): Promise<boolean>;
}

interface ConsolePart {
  /** Sends one line. Rejects with `bad-setting` for a line that would break the communication. */
  send(line: string): Promise<ConsoleAnswer>;
}

export interface ConsoleAnswer {
  readonly replies: string[];
  /** The machine answered with an error, which is among the replies. */
  readonly refused: boolean;
  /** Effect on the position or the pen, in words; null: none. */
  readonly note: string | null;
}

/** Number of the first run. Smaller numbers in a machine's counter may be those of another program. */
export const MIN_RUN = 2 ** 28;

/** How a machine was found in the middle of a plot. */
export interface FoundMidPlot {
  readonly penUp: boolean;
  /** It did not draw all that it had received. Left out: it did. */
  readonly isCutShort?: boolean;
  /** Whether that run (`PlaybackRequest`) moved it last, as far as the machine can keep its number. */
  isOfRun(run: number | undefined): boolean;
}

export interface PlaybackRequest {
  /** Tells this run of a plot from all others, `MIN_RUN` … 2 · `MIN_RUN` - 1. A machine may keep it, for the next connection. */
  readonly run: number;
  /** Of a live drawing: those known so far. */
  readonly strokes: StrokeSet;
  /** The plan will grow. Default false. */
  readonly grows?: boolean;
  /** The current settings; they may change during the plot. */
  settings(): MachineSettings;
  readonly events: PlaybackEvents;
}

export interface PlaybackEvents {
  progressed(progress: PlotProgress): void;
  /** A play has ended, for any reason; `place`: the first place still to be drawn, null if unknown. */
  ended(place: StrokePosition | null): void;
}

/** One plot on a machine. The caller decides what is drawn, and when. */
export interface Playback {
  readonly progress: PlaybackProgress;
  /** Identifies the current play: a new object for each; null at rest. */
  readonly playing: object | null;
  /** Set when a play was stopped on purpose: the first place still to be drawn, null if everything is drawn. */
  readonly stopped: { readonly place: StrokePosition | null } | null;
  /**
   * The machine has acknowledged everything before this place, and draws it even if nothing more is sent. Still known when
   * a play ends because the connection is lost. Undefined before the first stroke of a play, and if the machine may have
   * been stopped on the way to the place.
   */
  readonly receivedPlace: StrokePosition | undefined;
  /**
   * How much motion after the first place that may not be drawn can be sent within `withinS` from now, in the machine's
   * seconds. Undefined at rest. Left out by a machine that is sent motion by time (`sendAheadMs`).
   */
  sentAheadS?(withinS: number): number | undefined;
  /** Plays a plan to its end, or to a hold; the pen must be up. `afterS`: time of the plot after the end of this plan. */
  play(plot: PlannedPlot, afterS: number, begun: () => void): Promise<void>;
  /** Current position of the pen; null at rest. */
  now(): PlotProgress | null;
  /**
   * Where the pen will be every `stepS` from now, at most `count` times: as far as motion is sent that only a stop can
   * change. `stepS` in the machine's seconds.
   */
  ahead(stepS: number, count: number): readonly PenMoment[];
  /** Slows down along the path and lifts the pen; `play` ends. */
  slowToRest(): void;
  /** Clears the machine's queue; `play` ends and the position is read back. */
  stopAtOnce(): void;
  /** Stops the motors for good: the current play, or the next one, fails with the error. */
  fail(error: PlotwrightError): void;
  /** Switching to another plan; until that is done, no third plan is accepted. */
  readonly isSwitching: boolean;
  /**
   * A place at least `leadS` ahead where another plan can take over in motion. Null if too little of the plot is left or
   * the controller cannot switch in motion: a change then waits for the next rest.
   */
  placeAhead(leadS: number): PlaceAhead | null;
  /** Goes on with longer plans while a drawing grows. Left out: the controller can't. */
  readonly growth?: PlaybackGrowth;
}

/** A live drawing: its plan always ends at rest, and is replaced by a longer one while it is played. */
export interface PlaybackGrowth {
  /** Planned time that is not sent yet, s of the machine; 0 at rest. */
  readonly unsentS: number;
  /**
   * Goes on with a plan that begins where the current one did, or on the stroke that is being drawn, and moves like it up
   * to what is sent. False if it does not; the current plan then continues.
   */
  extend(plan: Trajectory): boolean;
  /** Goes on with a plan that begins at rest where the current one ends. False before everything is sent. */
  append(plan: Trajectory): boolean;
}

/** Where another plan can take over: plan from `from`, at `x`, `y` in mm. */
export interface PlaceAhead {
  readonly from: StrokePosition;
  readonly x: number;
  readonly y: number;
  /** The machine's state there. */
  readonly board: MachineState;
  /** Switches to a plan that begins there; false if the machine has already passed the place. */
  switchTo(plot: PlannedPlot, afterS: number): boolean;
}
