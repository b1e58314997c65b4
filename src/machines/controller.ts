/**
 * The part of a machine profile that belongs to its controller. Its fields are defined in the driver's folder
 * (src/drivers); the schema and the checks are derived from that table.
 */
import type { Setting } from "../settings/setting.js";

/**
 * The controller of the motors and the pen. `kind` names the driver; the other fields depend on the driver and are
 * listed in docs/api.md.
 */
export interface Controller {
  readonly kind: string;
  readonly [field: string]: unknown;
}

/** The fields of one kind of controller, besides `kind`. */
export type ControllerFields = Readonly<Record<string, ControllerField>>;

export type ControllerField =
  | Setting
  | { readonly kind: "one-of"; readonly values: readonly (string | number)[] }
  /** An object of fields. With `isOptional` it may be null or left out. */
  | { readonly kind: "group"; readonly isOptional?: true; readonly fields: ControllerFields };
