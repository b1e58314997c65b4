/** What server, web and tests use besides the public library. Anything here may change without notice. */
// errors
export { ERROR_CODES, ERROR_TABLE } from "./errors.js";

// drawing
export type {
  DrawingGroup,
  DrawingPaths,
  DrawingWarning,
  DashPattern,
  ClipRegion,
} from "./drawing/drawing.js";
export { settingsIdOf, strokeCount, pointCount, type StrokeLayer } from "./drawing/stroke-set.js";
export type { PaperName, PaperSize } from "./drawing/paper.js";

// import
export { importSvgSteps, importSvgWithPauses, type Pause } from "./import/svg/import-svg.js";
export { TEXT_MODES, type TextMode } from "./import/import-options.js";
export {
  importDrawingWithPauses,
  formatOf,
  DRAWING_FORMATS,
  type DrawingFormat,
  isDrawingName,
  DRAWING_EXTENSIONS,
} from "./import/registry.js";
export { encodingOf, textOfBytes } from "./import/text-of-bytes.js";

// settings
export {
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
  type ShiftMm,
  type SpreadMode,
  HATCH_TABLE,
  LAYER_REPEATS,
  PAPER_TABLE,
  PREPARE_TABLE,
} from "./settings/prepare.js";
export {
  DEFAULT_FIT,
  MOTION_MODES,
  type EaseSettings,
  type FitSettings,
  type LayerMotion,
  type MotionLimits,
  type MotionMode,
  DRAW_TABLE,
  EASE_TABLE,
  FIT_TABLE,
  TRAVEL_TABLE,
} from "./settings/motion.js";
export {
  type LayerPen,
  type PenOverlap,
  DROP_RATE,
  LAYER_WAIT,
  OVERLAP_TABLE,
  PEN_OVERLAPS,
  PEN_TABLE,
  PLOT_PEN_TABLE,
} from "./settings/pen.js";
export {
  isAllowed,
  rangeInWords,
  type NumberSetting,
  type Setting,
  type SwitchSetting,
} from "./settings/setting.js";
export { SETTING_FLAGS, flagInWords, valuesInWords, type SettingFlag } from "./settings/tables.js";
export { STREAM_TABLE } from "./settings/stream.js";

// prepare
export { orientedPaper, placeDrawing, type Placement } from "./prepare/place.js";
export type { PreparedLayer } from "./prepare/assemble.js";
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

// plan
export type { MotionState, PenMove, RunColumns } from "./plan/trajectory.js";
export { PlaceTimes } from "./plan/place-times.js";
export type { TrajectoryStats } from "./plan/stats.js";
export { drawLimitsOf } from "./plan/limits.js";
export { penOfLayer } from "./plan/pen-times.js";
export { codeOfSpeed, speedOfCode, withLayerCodes } from "./plan/coded-layers.js";
export { comeToRest, type RestPlan } from "./plan/come-to-rest.js";
export { movedPlace, pointOfPlace } from "./plan/place-on-drawing.js";
export { placeBehindSent, stoppedPlace } from "./plan/stopped-place.js";

// machines
export {
  INPUT_PORTS,
  type Controller,
  type EbbController,
  type GrblController,
  type HomingSwitches,
  type SwitchInput,
} from "./machines/controllers.js";
export { findMachine, machineOf, type MachineChoice } from "./machines/profiles.js";
export { DIRECTIONS, machineTurned, stepsPerMmMeasured, type Direction } from "./machines/set-up.js";
export { motor1FromXy, motor2FromXy, xFromMotors, yFromMotors } from "./machines/motors.js";
export { pctFromServoPos, servoPosFromPct } from "./drivers/ebb/protocol/servo-height.js";

// job
export { prepareJob, type PreparedJob } from "./job/prepare-job.js";

// drivers
export type { BoardState } from "./drivers/ebb/compile/command-stream.js";
export { firmwareLimitsMotion, motionForFirmware } from "./drivers/ebb/protocol/firmware-motion.js";
export { plotLines } from "./drivers/ebb/compile/plot-lines.js";
export {
  closingCommands,
  penCommand,
  penMoveOf,
  penMoveSetUp,
  penSetUpCommands,
  type PenWay,
} from "./drivers/ebb/protocol/commands.js";
export {
  compareFirmware,
  firmwareFeatures,
  firmwareFromReply,
  type FirmwareFeatures,
} from "./drivers/ebb/protocol/firmware.js";
export { commandName, replyShape, type ReplyShape, parseSteps } from "./drivers/ebb/protocol/replies.js";
export { LineSplitter } from "./drivers/line-splitter.js";
export type { Cancellation } from "./drivers/transport.js";
export { AnswerQueue, type AwaitedAnswer } from "./drivers/ebb/stream/answer-queue.js";
export type {
  BoardStatistics,
  DrawnPolyline,
  VirtualBoardState,
} from "./drivers/ebb/virtual/virtual-board.js";
export type { BoardIdentity, Outgoing, SessionOptions } from "./drivers/ebb/stream/session.js";
export { SessionLog } from "./drivers/session-log.js";
export type { StreamProgress } from "./drivers/ebb/stream/stream-commands.js";
export { Streamer } from "./drivers/ebb/stream/streamer.js";
export type { StreamOptions, StreamReport } from "./drivers/ebb/stream/stream-types.js";
export type { StreamPlace } from "./drivers/ebb/stream/timeline.js";
export { driverOf, firmwareFor, isPlannedAlike, usbIds } from "./drivers/registry.js";
export type {
  Driver,
  Machine,
  MachineEvents,
  MachineRun,
  PlaceAhead,
  UsbId,
  VirtualMachine,
} from "./drivers/driver.js";
export { powerLost, powerLow } from "./drivers/faults.js";
export type { MachineState, PlannedPlot } from "./drivers/machine-job.js";
export type { PlotProgress } from "./drivers/run-progress.js";

// export
export { codedLayerNames, svgOptionsOf } from "./export/coded-names.js";
export type { LayerLook, SvgOptions } from "./export/strokes-to-svg.js";
export { toJson, type StrokesJson } from "./export/strokes-to-json.js";
export { trajectoryToSvg, type TrajectorySvgOptions } from "./export/trajectory-to-svg.js";
