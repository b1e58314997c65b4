/** Manual moves: the bodies of POST /plotters/:id/…, answered with the plotter. */
import { z } from "zod";
import { machineProfileSchema } from "./machine.js";
import { givenSettingsSchema } from "./given-settings.js";

/** Speeds and heights of the move, laid over the plotter's settings. */
const settings = givenSettingsSchema.optional();
/** A profile that is being set up: the move is made with it, instead of with the plotter's model. */
const profile = machineProfileSchema.optional();
const how = { settings, profile };
/** A position, or a distance to either side. */
const mm = z.number().min(-5_000).max(5_000);

/** …/move-to: pen up, to a position in mm from home. */
export const moveToRequestSchema = z.object({ xMm: mm, yMm: mm, ...how });
export type MoveToRequest = z.infer<typeof moveToRequestSchema>;

/** …/jog: pen up, by a distance in mm. */
export const jogRequestSchema = z.object({ dxMm: mm, dyMm: mm, ...how });
export type JogRequest = z.infer<typeof jogRequestSchema>;

/** …/set-home, …/cycle-pen, …/test-line, …/test-patch. */
export const handMoveRequestSchema = z.object(how);
export type HandMoveRequest = z.infer<typeof handMoveRequestSchema>;

/** mm from home. */
export const boxMmSchema = z.object({
  xMm: mm,
  yMm: mm,
  widthMm: z.number().min(0).max(5_000),
  heightMm: z.number().min(0).max(5_000),
});
export type BoxMm = z.infer<typeof boxMmSchema>;

/** …/frame: around a job's drawing, placed by its settings, or around a box. */
export const frameRequestSchema = z.union([
  z.object({ jobId: z.string().max(100), ...how }),
  z.object({ boxMm: boxMmSchema, ...how }),
]);
export type FrameRequest = z.infer<typeof frameRequestSchema>;

/** …/square: draws a square to measure, to the right of and below the carriage. */
export const squareRequestSchema = z.object({ sizeMm: z.number().min(5).max(500), ...how });
export type SquareRequest = z.infer<typeof squareRequestSchema>;

/** …/servo: a raw position, 1/12 µs, for finding a servo's range by trial. */
export const servoRequestSchema = z.object({ pos: z.int().min(1).max(65_535), ...how });
export type ServoRequest = z.infer<typeof servoRequestSchema>;

/** A manual move as data: its kind is the last part of the route above. */
export const handMoveSchema = z.discriminatedUnion("kind", [
  /** A machine with limit switches finds home with them. Otherwise to the set home. */
  z.object({ kind: z.literal("home") }),
  /** Makes the current position home. */
  z.object({ kind: z.literal("set-home") }),
  /** Lowers the pen and lifts it again, to check the heights. */
  z.object({ kind: z.literal("cycle-pen") }),
  /** Draws a line near the current position, and comes back. */
  z.object({ kind: z.literal("test-line") }),
  /** Draws a small pattern at the current position, and comes back. */
  z.object({ kind: z.literal("test-patch") }),
  moveToRequestSchema.omit({ settings: true, profile: true }).extend({ kind: z.literal("move-to") }),
  /** May go beyond home, since this is how the user finds home. */
  jogRequestSchema.omit({ settings: true, profile: true }).extend({ kind: z.literal("jog") }),
  /** Moves around a box with the pen up, and back. */
  z.object({ kind: z.literal("frame"), boxMm: boxMmSchema }),
  squareRequestSchema.omit({ settings: true, profile: true }).extend({ kind: z.literal("square") }),
  servoRequestSchema.omit({ settings: true, profile: true }).extend({ kind: z.literal("servo") }),
]);
export type HandMove = z.infer<typeof handMoveSchema>;

/** …/command: one line to the board, as typed in a console. */
export const commandRequestSchema = z.object({
  line: z
    .string()
    .trim()
    .regex(/^[\x20-\x7e]{1,255}$/, "one line of at most 255 ASCII characters"),
});
export type CommandRequest = z.infer<typeof commandRequestSchema>;

export const commandAnswerSchema = z.object({
  replies: z.array(z.string()),
  /** The machine answered with an error, which is among the replies. */
  refused: z.boolean(),
  /** A note if the line changed the motors' position counters; otherwise null. */
  note: z.string().nullable(),
});
export type CommandAnswer = z.infer<typeof commandAnswerSchema>;
