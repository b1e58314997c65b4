import type { Setting } from "../settings/setting.js";
import type { PenServo, Springs } from "../settings/values.js";

export type { PenServo, Springs } from "../settings/values.js";

/** The properties of a plotter, as data. */
export interface MachineProfile<C extends Controller = Controller> {
  /** Stored in settings: "axidraw-v3". */
  readonly id: string;
  /** Shown to users: "AxiDraw V3". */
  readonly name: string;
  /** Travel limits, mm from home. */
  readonly widthMm: number;
  readonly heightMm: number;
  /** Microsteps per mm along an axis; on mixed machines along an axis of the carriage, see `motors`. */
  readonly stepsPerMm: number;
  /** "mixed": motor 1 = x + y, motor 2 = x − y (H-bot, CoreXY). "direct": motor 1 = x, motor 2 = y. */
  readonly motors: "mixed" | "direct";
  /** The axis runs opposite to its motor wiring. Left out: it does not. */
  readonly flipX?: boolean | undefined;
  readonly flipY?: boolean | undefined;
  /** x and y are exchanged, because of how the motors are plugged in or how the machine is placed. */
  readonly swapAxes?: boolean | undefined;
  /** How the machine swings. Null or left out: not measured. */
  readonly springs?: Springs | null | undefined;
  /** How the servo of the pen lift moves. Null or left out: like AxiDraw's, or NextDraw's on its servo output. */
  readonly penServo?: PenServo | null | undefined;
  /** The controller of the motors and the pen. */
  readonly controller: C;
}

/**
 * The controller of the motors and the pen. `kind` names the driver; the other fields depend on the driver and are
 * listed in docs/api.md.
 */
export interface Controller {
  readonly kind: string;
  readonly [field: string]: unknown;
}

/** The fields of one kind of controller, besides `kind`. They are defined in its driver's folder (src/drivers). */
export type ControllerFields = Readonly<Record<string, ControllerField>>;

/** A setting of a controller, with what it does in a phrase. */
export type ControllerSetting = Setting & { readonly about: string };

/** With `isOptional` it may be null or left out. */
export type ControllerField = { readonly isOptional?: true } & (
  | ControllerSetting
  | { readonly kind: "one-of"; readonly values: readonly (string | number)[] }
  | { readonly kind: "text"; readonly label: string; readonly maxLength: number }
  /** An object of fields. */
  | { readonly kind: "group"; readonly fields: ControllerFields }
);
