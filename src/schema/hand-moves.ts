/** Moves by hand: the bodies of POST /plotters/:id/…, answered by the plotter. */
import { z } from "zod";
import { plotSettingsSchema } from "./settings.js";

/** Speeds, heights and machine of the move; left out: those of the last job or move. */
const settings = plotSettingsSchema.optional();
const wayMm = z.number().min(-5_000).max(5_000);
const placeMm = z.number().min(-5_000).max(5_000);

/** …/walk: pen up, to a place in mm from home. */
export const walkRequestSchema = z.object({ xMm: placeMm, yMm: placeMm, settings });
export type WalkRequest = z.infer<typeof walkRequestSchema>;

/** …/jog: pen up, by so many mm. */
export const jogRequestSchema = z.object({ dxMm: wayMm, dyMm: wayMm, settings });
export type JogRequest = z.infer<typeof jogRequestSchema>;

/** …/set-home, …/cycle-pen, …/test-patch. */
export const handMoveRequestSchema = z.object({ settings });
export type HandMoveRequest = z.infer<typeof handMoveRequestSchema>;

/** mm from home. */
export const boxMmSchema = z.object({
  xMm: placeMm,
  yMm: placeMm,
  widthMm: z.number().min(0).max(5_000),
  heightMm: z.number().min(0).max(5_000),
});
export type BoxMm = z.infer<typeof boxMmSchema>;

/** …/frame: around a job's drawing as its settings place it, or around a box. */
export const frameRequestSchema = z.union([
  z.object({ jobId: z.string().max(100), settings }),
  z.object({ boxMm: boxMmSchema, settings }),
]);
export type FrameRequest = z.infer<typeof frameRequestSchema>;

/** …/square: draws one, to be measured, to the right of and below where the carriage stands. */
export const squareRequestSchema = z.object({ sizeMm: z.number().min(5).max(500), settings });
export type SquareRequest = z.infer<typeof squareRequestSchema>;

/** …/servo: a raw position, 1/12 µs, to find a servo's range by touch. */
export const servoRequestSchema = z.object({ pos: z.int().min(1).max(65_535), settings });
export type ServoRequest = z.infer<typeof servoRequestSchema>;

/** …/command: one line to the board, as a console sends it. */
export const commandRequestSchema = z.object({
  line: z
    .string()
    .trim()
    .regex(/^[\x20-\x7e]{1,255}$/, "one line of at most 255 plain characters"),
});
export type CommandRequest = z.infer<typeof commandRequestSchema>;

export const commandAnswerSchema = z.object({
  replies: z.array(z.string()),
  /** What plotwright makes of it, when the line touched the motors' counters; else null. */
  note: z.string().nullable(),
});
export type CommandAnswer = z.infer<typeof commandAnswerSchema>;
