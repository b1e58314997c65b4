/** A plotter's profile, as sent, stored or written to a file. */
import { z } from "zod";
import { nameSchema } from "./name.js";
import { CONTROLLER_TABLES, INPUT_PORTS, type Controller } from "../machines/controllers.js";
import type { MachineProfile } from "../machines/profile.js";
import { SPRINGS_TABLE } from "../settings/springs.js";
import { shapeOf } from "./setting.js";

const switchInputSchema = z.object({
  port: z.enum(INPUT_PORTS),
  pin: z.int().min(0).max(7),
  pressed: z.union([z.literal(0), z.literal(1)]),
});

/** The board stores servo positions in 16 bits. */
const servoPosSchema = z.int().min(1).max(65_535);

const ebbControllerSchema = z
  .object({
    kind: z.literal("ebb"),
    microstepMode: z.union([z.literal(1), z.literal(2), z.literal(3), z.literal(4), z.literal(5)]),
    servoPosAt0Pct: servoPosSchema,
    servoPosAt100Pct: servoPosSchema,
    servoPin: z.union([z.literal(4), z.literal(5)]),
    homing: z.object({ x: switchInputSchema, y: switchInputSchema }).nullable().optional(),
  })
  .refine(({ servoPosAt0Pct, servoPosAt100Pct }) => servoPosAt0Pct !== servoPosAt100Pct, {
    message: "the servo has no range: 0 % and 100 % are the same position",
    path: ["servoPosAt100Pct"],
  });

const controllerSchema = z.discriminatedUnion("kind", [
  ebbControllerSchema,
  ...Object.entries(CONTROLLER_TABLES).map(([kind, table]) =>
    z.object({ kind: z.literal(kind), ...shapeOf(table) }),
  ),
  // The tables are the types' source too, but their keys are lost in the list.
]) as z.ZodType<Controller>;

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
  controller: controllerSchema,
};

/** In format 1 the controller's fields are among the machine's; format 2 has `controller`. */
function upgrade(stored: unknown): unknown {
  if (typeof stored !== "object" || stored === null || "controller" in stored) return stored;
  const { microstepMode, servoPosAt0Pct, servoPosAt100Pct, servoPin, homing, ...machine } = stored as Record<
    string,
    unknown
  >;
  const controller = { kind: "ebb", microstepMode, servoPosAt0Pct, servoPosAt100Pct, servoPin, homing };
  return { ...machine, controller };
}

export const machineProfileSchema = z.preprocess(
  upgrade,
  z.object(profileShape),
) satisfies z.ZodType<MachineProfile>;

/** An entry of GET /machines. */
export const listedMachineSchema = z.object({
  ...profileShape,
  /** Comes with plotwright; custom machines can be changed and removed. */
  builtIn: z.boolean(),
});
export type ListedMachine = z.infer<typeof listedMachineSchema>;

export const machineListSchema = z.object({ machines: z.array(listedMachineSchema) });
export type MachineList = z.infer<typeof machineListSchema>;
