/** A job for one machine: its motion, and the commands that make the machine perform it. */
import type { StrokeSet } from "../drawing/stroke-set.js";
import type { MachineProfile } from "../machines/profile.js";
import type { MachineChoice } from "../machines/profiles.js";
import type { Place, Trajectory } from "../plan/trajectory.js";
import type { MotionSettings } from "../settings/motion.js";
import type { PenSettings } from "../settings/pen.js";

/** The part of a job's settings that decides its motion. */
export interface JobSettings {
  /** Speeds, accelerations, corners. */
  readonly motion: MotionSettings;
  /** Pen heights and waits. */
  readonly pen: PenSettings;
}

/** What a connected machine needs of the settings. */
export interface MachineSettings extends JobSettings, MachineChoice {
  /** Motion that is sent before its time, so that a busy computer does not stop the pen. */
  readonly sendAheadMs: number;
}

/**
 * How a machine stands between two jobs, as its driver knows it. Only that driver looks inside. Plain data, which can
 * cross threads.
 */
export type MachineState = object;

/** The commands of a job in the form of one driver; others read only this. Plain data, which can cross threads. */
export interface MachineCommands {
  readonly count: number;
  /** Trajectory seconds at each command's start; count + 1 entries. */
  readonly planS: Float64Array;
  /** Limits that had to be met by splitting or slowing, in words. */
  readonly warnings: readonly string[];
}

/** A planned job: its motion, and its commands for one machine. */
export interface MachineJob<Commands extends MachineCommands = MachineCommands> {
  /** The motion that the machine will perform: for a controller that plans by itself, a model of what it does. */
  readonly trajectory: Trajectory;
  /** The commands of the machine's driver. Computed on the first call, because a preview needs only the motion. */
  commands(): Commands;
  /** The whole plot as text, one command a line, with what begins and ends it. */
  lines(): string[];
}

/** A job with its commands made, as it crosses threads. */
export interface PlannedPlot {
  readonly trajectory: Trajectory;
  readonly commands: MachineCommands;
}

export interface DriverPlanOptions {
  /** Where in the drawing to begin, in the middle of a stroke too; default: its beginning. */
  readonly from?: Place | null | undefined;
  /** Where the carriage is, mm from home; default 0, 0. The pen is up there. */
  readonly startXMm?: number | undefined;
  readonly startYMm?: number | undefined;
  /** How the machine stands there (`Machine.state`); default: at home, as it is after the motors were switched on. */
  readonly board?: MachineState | undefined;
  /** Version of the controller's firmware: "2.8.1". Default, and where it is null: the driver's choice. */
  readonly firmware?: string | null | undefined;
  /** Begin with a lift, because nobody knows where the pen is. Default false. */
  readonly liftFirst?: boolean | undefined;
  /** Where to go when everything is drawn, mm from home; default home itself. */
  readonly endXMm?: number | undefined;
  readonly endYMm?: number | undefined;
  /** Checked before every stroke. An AbortSignal fits. */
  readonly cancel?: { readonly aborted: boolean } | undefined;
}

/** What of a controller's firmware decides a plan. */
export interface FirmwareRules {
  /** Whether a version that some machine has shown is one of this controller's. */
  isOwn(firmware: string): boolean;
  /** Whether plans for it are slower than the settings ask for; null: nobody has been asked. */
  limitsMotion(firmware: string | null): boolean;
}

/** From strokes, and settings that already hold the codes of the layers' names, to a job. */
export type PlanForMachine = (
  strokes: StrokeSet,
  settings: JobSettings,
  machine: MachineProfile,
  options: DriverPlanOptions,
) => MachineJob;
