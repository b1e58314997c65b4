/** A job for one machine: its motion, and the commands that make the machine perform it. */
import type { PenSetup } from "../prepare/layers/pens.js";
import type { Cancellation } from "../prepare/work.js";
import type { StrokeSet } from "../drawing/stroke-set.js";
import type { MachineProfile } from "../machines/profile.js";
import type { MachineChoice } from "../machines/profiles.js";
import type { StrokePosition, Trajectory } from "../plan/trajectory.js";
import type { MotionSettings } from "../settings/motion.js";
import type { PenSettings } from "../settings/pen.js";
import type { StreamValues } from "../settings/values.js";

/** The part of a job's settings that determines its motion. */
export interface JobSettings {
  /** Speeds, accelerations, corners. */
  readonly motion: MotionSettings;
  /** Pen heights and waits. */
  readonly pen: PenSettings;
}

/** The settings that a connected machine needs. */
export interface MachineSettings extends JobSettings, MachineChoice, StreamValues {}

/**
 * The state of a machine between two jobs. Only its driver reads the content. Plain data, so that it can be passed
 * between threads.
 */
export type MachineState = object;

/**
 * The commands of a job in the format of its driver. All other code reads only these fields. Plain data, so that it can
 * be passed between threads.
 */
export interface MachineCommands {
  readonly count: number;
  /** Trajectory seconds at each command's start; count + 1 entries. */
  readonly planS: Float64Array;
  /** Limits that required splitting or slowing, in words. */
  readonly warnings: readonly string[];
}

/** A planned job: its motion, and its commands for one machine. */
export interface MachineJob<Commands extends MachineCommands = MachineCommands> {
  /** The motion that the machine will perform. For a controller that plans by itself, a model of it. */
  readonly trajectory: Trajectory;
  /** The commands of the machine's driver. Computed on the first call, because a preview needs only the motion. */
  commands(): Commands;
  /** The whole plot as text, one command per line, including its beginning and end. */
  lines(): string[];
}

/** A job with its commands, as it is passed between threads. */
export interface PlannedPlot {
  readonly trajectory: Trajectory;
  readonly commands: MachineCommands;
}

export interface DriverPlanOptions {
  /** Where in the drawing to begin, possibly within a stroke; default: the start of the drawing. */
  readonly from?: StrokePosition | null | undefined;
  /** Where the carriage is, mm from home; default 0, 0. The pen is up there. */
  readonly startXMm?: number | undefined;
  readonly startYMm?: number | undefined;
  /**
   * The machine's state at the beginning (`Machine.state`); default: at home, with the motors just switched on.
   */
  readonly board?: MachineState | undefined;
  /** Version of the controller's firmware: "2.8.1". Null or left out: the driver's choice. */
  readonly firmware?: string | null | undefined;
  /** Begin with a lift, because the pen's height is unknown. Default false. */
  readonly liftFirst?: boolean | undefined;
  /** Where to go when everything is drawn, mm from home; default: home. */
  readonly endXMm?: number | undefined;
  readonly endYMm?: number | undefined;
  /** A part of a live drawing. Left out: the drawing is complete, and the job begins with the pen up and ends at home. */
  readonly live?: LivePart | undefined;
  /** Checked before every stroke. */
  readonly cancel?: Cancellation | undefined;
}

/** A part of a drawing that is not complete yet. */
export interface LivePart {
  /** The pen is down at the start, at rest on the line at `from`. */
  readonly penDown: boolean;
  /** Where the pen is at the end: on the line, because the stroke goes on; up above it; at the end position of the job. */
  readonly end: "down" | "up" | "home";
  /** Strokes whose end may not be known yet. */
  readonly mayGrow: (stroke: number) => boolean;
}

/** The properties of a controller's firmware that affect a plan. */
export interface FirmwareRules {
  /** Whether a version reported by a machine belongs to this controller. */
  isOwn(firmware: string): boolean;
  /** Whether a plan with these pen settings for one version is also right for the other; null: the version is unknown. */
  isPlannedAlike(pen: PenSettings, a: string | null, b: string | null): boolean;
  /** What users of this version should know, in one sentence; null: nothing. */
  advice(firmware: string): string | null;
}

/** Makes a job from strokes, and from settings with the codes of the layer names applied. The pens are for its `lines`. */
export type PlanForMachine = (
  strokes: StrokeSet,
  settings: JobSettings & Partial<PenSetup>,
  machine: MachineProfile,
  options: DriverPlanOptions,
) => MachineJob;
