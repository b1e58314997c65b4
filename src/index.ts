/**
 * The public library. Names that are not listed here may change without notice.
 * `docs/library.md` is the guide; `npm run docs` makes the reference from the docstrings of these names.
 */
// One call
export { planSvg, type PlannedSvg, type SvgSettings } from "./job/plan-svg.js";

// Import: text to a drawing
export { importDrawing } from "./import/registry.js";
export { importSvg } from "./import/svg/import-svg.js";
export type { ImportOptions } from "./import/import-options.js";
export { openOutlineFont } from "./import/text/outline-font.js";
export type { TextFont } from "./import/text/text-font.js";
export type { Drawing } from "./drawing/drawing.js";

// Prepare: a drawing to strokes
export { prepare, type Prepared } from "./prepare/prepare.js";
export { DEFAULT_PREPARE, type PrepareSettings } from "./settings/prepare.js";
export type { Work } from "./prepare/work.js";
export { PAPER_SIZES } from "./drawing/paper.js";
export { strokesOf, type Line } from "./drawing/stroke-set.js";
export type { StrokeSet } from "./drawing/stroke-set.js";
export { checkBounds } from "./prepare/on-paper.js";
export { toSvg } from "./export/strokes-to-svg.js";

// Plan: strokes to motion
export { plan, type PlanOptions } from "./plan/plan.js";
export { DEFAULT_MOTION, type MotionSettings } from "./settings/motion.js";
export { DEFAULT_PEN, type PenSettings } from "./settings/pen.js";
export { stateAt, type StrokePosition, type Trajectory } from "./plan/trajectory.js";
export { trajectoryStats } from "./plan/stats.js";

// Jobs: strokes to motion and commands for a machine
export { MACHINES, machineById } from "./machines/profiles.js";
export type { MachineProfile } from "./machines/profile.js";
export { planJob, type JobOptions, type JobSettings, type MachineJob } from "./job/plan-job.js";
export { commandLine, compile, type CompileOptions } from "./drivers/ebb/compile/compile.js";
export type { CommandStream } from "./drivers/ebb/compile/command-stream.js";

// Plot: commands to a board
export type { Clock, Transport } from "./drivers/transport.js";
export { BoardSession } from "./drivers/ebb/stream/session.js";
export { setUpCommands } from "./drivers/ebb/protocol/commands.js";
export { streamCommands } from "./drivers/ebb/stream/stream-commands.js";
export { VirtualBoard, type VirtualBoardOptions } from "./drivers/ebb/virtual/virtual-board.js";

// Errors
export { PlotwrightError, type ErrorCode } from "./errors.js";
