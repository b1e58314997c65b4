/**
 * The public library: every name listed. Anything not here may change without notice.
 * Each owner's names stand in a section of their own, in the order of the flow.
 */
// errors, units
export { PlotwrightError, ERROR_CODES, ERROR_TABLE, type ErrorCode } from "./errors.js";

// drawing
export type {
  Drawing,
  DrawingGroup,
  DrawingPaths,
  DrawingWarning,
  DashPattern,
  ClipRegion,
} from "./drawing/drawing.js";
export {
  settingsIdOf,
  strokeCount,
  pointCount,
  type StrokeSet,
  type StrokeLayer,
} from "./drawing/stroke-set.js";
export { strokesOf, type Line } from "./drawing/lines.js";
export { PAPER_SIZES, type PaperName, type PaperSize } from "./drawing/paper.js";

// import
export { importSvg, importSvgSteps, importSvgWithPauses, type Pause } from "./import/svg/import-svg.js";
export { TEXT_MODES, type ImportOptions, type TextMode } from "./import/import-options.js";
export { openOutlineFont } from "./import/text/outline-font.js";
export type { TextFont } from "./import/text/text-font.js";
export {
  importDrawing,
  importDrawingWithPauses,
  formatOf,
  DRAWING_FORMATS,
  type DrawingFormat,
} from "./import/registry.js";

// prepare
export { prepare, type Prepared } from "./prepare/prepare.js";
export { orientedPaper, placeDrawing, type Placement } from "./prepare/place.js";
export type { PreparedLayer } from "./prepare/assemble.js";
export { checkBounds } from "./prepare/check-bounds.js";
export type { Work } from "./prepare/work.js";
export {
  NO_CODES,
  formatLayerName,
  parseLayerName,
  shownLayerName,
  type LayerCodes,
} from "./prepare/layer-codes.js";
export {
  NO_PENS,
  PEN_STOP_MODES,
  penOf,
  penStopsOf,
  prepareSettingsOf,
  type PenSetup,
  type PenStop,
  type PenStopMode,
  type PlotPen,
} from "./prepare/pens.js";
export {
  DEFAULT_PREPARE,
  LAYER_MODES,
  MIRROR_MODES,
  ORDER_MODES,
  SPREAD_MODES,
  type FourMargins,
  type HatchSettings,
  type LayerHatch,
  type LayerMode,
  type MirrorMode,
  type OrderMode,
  type PlacedBox,
  type PrepareSettings,
  type ShiftMm,
  type SpreadMode,
} from "./settings/prepare.js";

// plan
export {
  DEFAULT_FIT,
  DEFAULT_MOTION,
  MOTION_MODES,
  type EaseSettings,
  type FitSettings,
  type LayerMotion,
  type MotionLimits,
  type MotionMode,
  type MotionSettings,
} from "./settings/motion.js";
export { DEFAULT_PEN, type LayerPen, type PenOverlap, type PenSettings } from "./settings/pen.js";
export { plan, type PlanOptions } from "./plan/plan.js";
export {
  stateAt,
  type MotionState,
  type PenMove,
  type Place,
  type RunColumns,
  type Trajectory,
} from "./plan/trajectory.js";
export { PlaceTimes } from "./plan/place-times.js";
export { trajectoryStats, type TrajectoryStats } from "./plan/stats.js";

export { drawLimitsOf } from "./plan/limits.js";
export { penOfLayer } from "./plan/pen-times.js";
export { codeOfSpeed, speedOfCode, withLayerCodes } from "./plan/coded-layers.js";

// machines
export {
  INPUT_PORTS,
  type HomingSwitches,
  type MachineProfile,
  type SwitchInput,
} from "./machines/profile.js";
export { findMachine, MACHINES, machineById, machineOf, type MachineChoice } from "./machines/profiles.js";
export { DIRECTIONS, machineTurned, stepsPerMmMeasured, type Direction } from "./machines/set-up.js";
export { motor1FromXy, motor2FromXy, xFromMotors, yFromMotors } from "./machines/motors.js";
export { pctFromServoPos, servoPosFromPct } from "./machines/pen.js";

// job
export { planSvg, type PlannedSvg, type SvgSettings } from "./job/plan-svg.js";
export { planJob, type JobOptions, type JobSettings, type MachineJob } from "./job/plan-job.js";

// ebb
export type { BoardState, CommandStream } from "./drivers/ebb/compile/command-stream.js";
export { commandLine, compile, type CompileOptions } from "./drivers/ebb/compile/compile.js";
export { firmwareLimitsMotion, motionForFirmware } from "./drivers/ebb/protocol/firmware-motion.js";
export { plotLines } from "./drivers/ebb/compile/plot-lines.js";
export {
  closingCommands,
  penCommand,
  penMoveOf,
  penMoveSetUp,
  penSetUpCommands,
  setUpCommands,
  type PenWay,
} from "./drivers/ebb/protocol/commands.js";
export {
  compareFirmware,
  firmwareFeatures,
  firmwareFromReply,
  type FirmwareFeatures,
} from "./drivers/ebb/protocol/firmware.js";
export { commandName, LineSplitter, replyShape, type ReplyShape } from "./drivers/ebb/protocol/replies.js";

// board
export type { Cancellation, Clock, Transport } from "./drivers/transport.js";
export { AnswerQueue, type AwaitedAnswer } from "./drivers/ebb/stream/answer-queue.js";
export {
  VirtualBoard,
  type BoardStatistics,
  type DrawnPolyline,
  type VirtualBoardOptions,
  type VirtualBoardState,
} from "./drivers/ebb/virtual/virtual-board.js";
export {
  BoardSession,
  type BoardIdentity,
  type Outgoing,
  type SessionOptions,
} from "./drivers/ebb/stream/session.js";
export { SessionLog } from "./drivers/ebb/stream/session-log.js";
export { comeToRest, type RestPlan } from "./plan/come-to-rest.js";
export { streamCommands, type StreamProgress } from "./drivers/ebb/stream/stream-commands.js";
export { parseSteps } from "./drivers/ebb/protocol/replies.js";
export { Streamer } from "./drivers/ebb/stream/streamer.js";
export type { StreamOptions, StreamReport } from "./drivers/ebb/stream/stream-types.js";
export type { StreamPlace } from "./drivers/ebb/stream/timeline.js";

// export
export { codedLayerNames, svgOptionsOf } from "./export/coded-names.js";
export { toSvg, type LayerLook, type SvgOptions } from "./export/strokes-to-svg.js";
export { toJson, type StrokesJson } from "./export/strokes-to-json.js";
export { trajectoryToSvg, type TrajectorySvgOptions } from "./export/trajectory-to-svg.js";
