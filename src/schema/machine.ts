/** A plotter's profile, as sent, stored or written to a file. */
import { z } from "zod";
import { nameSchema } from "./name.js";
import type { ControllerDescription } from "../drivers/driver.js";
import { CONTROLLERS } from "../drivers/registry.js";
import type { Controller, ControllerField, ControllerFields, MachineProfile } from "../machines/profile.js";
import { PEN_SERVO_TABLE, SPRINGS_TABLE } from "../settings/machine.js";
import { schemaOf, shapeOf } from "./setting.js";

function fieldSchema(field: ControllerField): z.ZodType {
  const schema = valueSchema(field);
  return field.isOptional ? schema.nullable().optional() : schema;
}

function valueSchema(field: ControllerField): z.ZodType {
  switch (field.kind) {
    case "one-of":
      return z.literal([...field.values]);
    case "text":
      return z.string().max(field.maxLength);
    case "group":
      return z.object(fieldShape(field.fields));
    default:
      return schemaOf(field, field.about);
  }
}

const fieldShape = (fields: ControllerFields): Record<string, z.ZodType> =>
  Object.fromEntries(Object.entries(fields).map(([key, field]) => [key, fieldSchema(field)]));

const kindSchema = (kind: string, { fields, contradictionOf = () => null }: ControllerDescription) =>
  z.object({ kind: z.literal(kind), ...fieldShape(fields) }).superRefine((controller, context) => {
    const contradiction = contradictionOf(controller);
    if (contradiction === null) return;
    context.addIssue({ code: "custom", path: [contradiction.field], message: contradiction.message });
  });

const [firstKind, ...otherKinds] = Object.entries(CONTROLLERS).map(([kind, one]) => kindSchema(kind, one));
const controllerSchema = z.discriminatedUnion("kind", [
  firstKind,
  ...otherKinds,
]) as unknown as z.ZodType<Controller>;

const profileShape = {
  /** Also used as a file name. */
  id: z.string().regex(/^[a-z0-9][a-z0-9-]{0,62}$/, "lower-case letters, digits and -, at most 63"),
  name: nameSchema(100),
  widthMm: z.number().gt(0).max(5_000),
  heightMm: z.number().gt(0).max(5_000),
  stepsPerMm: z.number().min(0.1).max(10_000),
  motors: z.enum(["mixed", "direct"]),
  flipX: z.boolean().optional(),
  flipY: z.boolean().optional(),
  swapAxes: z.boolean().optional(),
  springs: z.object(shapeOf(SPRINGS_TABLE)).nullable().optional(),
  penServo: z.object(shapeOf(PEN_SERVO_TABLE)).nullable().optional(),
  controller: controllerSchema,
};

export const machineProfileSchema = z.object(profileShape) satisfies z.ZodType<MachineProfile>;

/** An entry of GET /machines. */
export const listedMachineSchema = z.object({
  ...profileShape,
  /** Comes with plotwright; custom machines can be changed and removed. */
  builtIn: z.boolean(),
});
export type ListedMachine = z.infer<typeof listedMachineSchema>;

export const machineListSchema = z.object({ machines: z.array(listedMachineSchema) });
export type MachineList = z.infer<typeof machineListSchema>;
