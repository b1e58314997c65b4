/** Exports for server, web and tests besides the public library. Anything here may change without notice. */
// lengths
export {
  LENGTH_UNITS,
  mmInWords,
  lengthFromMm,
  mmFromLength,
  parseLength,
  parseSize,
  type LengthUnit,
} from "./units.js";

// errors and text
export { ERROR_TABLE } from "./errors.js";
export { printable, printableJson } from "./plain-text.js";

// drawing
export { hasFill, type DrawingWarning } from "./drawing/drawing.js";
export { settingsIdOf, strokeCount, pointCount, type StrokeLayer } from "./drawing/stroke-set.js";
export {
  compose,
  inverse,
  mapAround,
  meanScale,
  rotation,
  scaling,
  translation,
  type Affine,
} from "./geometry/affine.js";
export { firstWhere } from "./geometry/binary-search.js";
export { ColumnBuffer, PointBuffer } from "./geometry/growable.js";
export { nearestShare } from "./geometry/polyline.js";
export type { PaperName, PaperSize } from "./drawing/paper.js";
export { combine, type SheetItem, type SheetSource } from "./drawing/combine.js";
export { listColor, rampColor } from "./drawing/color-ramp.js";
export { otherPapers, PX_NOTE, withPxPerInch, type PaperInPx } from "./drawing/px-size.js";

// import
export { isDrawingName, DRAWING_EXTENSIONS } from "./import/registry.js";
export { isSheetBegun, parseSheet, type SheetFile } from "./import/sheet/import-sheet.js";
export { encodingOf, textOfBytes } from "./import/text-of-bytes.js";

// settings
export {
  ORDER_MODES,
  type FourMargins,
  HATCH_TABLE,
  LAYER_REPEATS,
  PREPARE_TABLE,
} from "./settings/prepare.js";
export { PAPER_TABLE, type PlacedBox } from "./settings/placement.js";
export {
  DEFAULT_FIT,
  CORNER_RULES,
  MOTION_MODES,
  SHAPERS,
  type Shaper,
  type FitSettings,
  type LayerMotion,
  type MotionLimits,
  type MotionMode,
  DRAW_TABLE,
  AXIS_TABLE,
  EASE_TABLE,
  FIT_TABLE,
  MOTION_TABLE,
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
export { getOrAdd } from "./get-or-add.js";
export { inPageWords } from "./settings/page-words.js";
export { bestMatches, type Searched } from "./settings/matching.js";
export { GIVEN_WHOLE, isSameJson, withGiven } from "./settings/partial.js";
export { aboutOf, wordsOf } from "./settings/texts.js";
export {
  isAllowed,
  rangeInWords,
  SETTING_GROUPS,
  type NumberSetting,
  type Setting,
  type SettingGroup,
} from "./settings/setting.js";
export {
  QUALITY_PATH,
  SETTING_FLAGS,
  SPRINGS_PATH,
  flagInWords,
  valuesInWords,
  type SettingFlag,
} from "./settings/tables.js";
export { QUALITIES, type Quality } from "./settings/motion.js";
export { SPRINGS_TABLE } from "./settings/machine.js";
export { STREAM_TABLE } from "./settings/machine.js";

// prepare
export { boxOfPoints, insideRange, isEmptyBox, uniteBoxes, type Box } from "./geometry/box.js";
export { isReached, unreachedCount } from "./prepare/on-paper.js";
export {
  canBePaper,
  isOnFilesPage,
  onFilesPage,
  quarterTurned,
  quarterTurnedBox,
  turnedOntoPaper,
} from "./prepare/files-page.js";
export { meanScaleOf, sizeInWords, type DrawnSize, type OutsidePaper } from "./prepare/on-paper.js";
export { layOutDrawing, type Layout } from "./prepare/layout.js";
export {
  needsNewPaper,
  orientedPaper,
  paperAndMargins,
  sheetOf,
  sheetSize,
  tileCount,
  tilesOf,
  tileWindows,
} from "./prepare/tiles.js";
export { cutOffLines } from "./prepare/cut-off.js";
export type { PreparedLayer } from "./prepare/assemble.js";
export { parseLayerName, shownLayerName } from "./prepare/layers/layer-codes.js";
export {
  NO_PENS,
  PEN_STOP_MODES,
  penOf,
  penStopsOf,
  prepareSettingsOf,
  type PenSetup,
  type PenStop,
  type PlotPen,
} from "./prepare/layers/pens.js";

// plan
export { PositionTimes } from "./position/on-plan.js";
export { timesByLayer, type LayerTimes, type TimesByKind, type TrajectoryStats } from "./plan/stats.js";
export { lowerAheadMm } from "./plan/pen/pen-flight.js";
export { liftTime, dropTime, penOfLayer, timedPen } from "./plan/pen/pen-times.js";
export { penOfStroke, speedOfCode, withLayerCodes } from "./plan/coded-layers.js";
export {
  motionForSprings,
  motionOfQuality,
  withoutShaperIfUnmeasured,
  qualityOf,
  withQuality,
} from "./plan/quality.js";
export { penError, type PenError } from "./plan/simulate/pen-error.js";
export { swingPen, type PenPoint } from "./plan/simulate/spring-pen.js";
export { comeToRest } from "./plan/rest/come-to-rest.js";
export { movedPosition, pointAt } from "./position/on-drawing.js";
export { isBetween, maxOffDrawingMm, maxOffLineMm, reportedPosition } from "./position/reported.js";

// machines
export type { Springs } from "./machines/profile.js";
export { findMachine, machineNamed, machineOf, type MachineId } from "./machines/profiles.js";
export { freeId, measuredMachine } from "./machines/own-machines.js";
export {
  DIRECTIONS,
  machineTurned,
  scaleMeasured,
  stepsPerMmMeasured,
  type Direction,
} from "./machines/set-up.js";
export { motor1FromXy, motor2FromXy, xFromMotors, yFromMotors } from "./machines/motors.js";
export { pctFromServoPos, servoPosFromPct } from "./drivers/ebb/protocol/servo-height.js";

// job
export { prepareJob, type PreparedJob } from "./job/prepare-job.js";
export { unusedSettings } from "./job/prepare-job.js";

// drivers
export type { BoardState } from "./drivers/ebb/compile/command-stream.js";
export { motionForFirmware } from "./drivers/ebb/protocol/firmware-motion.js";
export { closingCommands, penCommand, penMoveOf } from "./drivers/ebb/protocol/commands.js";
export { compareFirmware } from "./drivers/ebb/protocol/firmware.js";
export type { BoardStatistics, VirtualBoardState } from "./drivers/ebb/virtual/virtual-board.js";
export type { StreamProgress } from "./drivers/ebb/stream/stream-commands.js";
export { Streamer } from "./drivers/ebb/stream/streamer.js";
export type { StreamOptions } from "./drivers/ebb/stream/stream-types.js";
export {
  controllerOf,
  findsHome,
  firmwareAdvice,
  firmwareFor,
  isPlannedAlike,
  allUsbIds,
  hasUsbId,
  usbIdsOf,
  usesSetting,
} from "./drivers/registry.js";
export { allDrivers, driverOf, type KnownDriver } from "./drivers/connecting.js";
export { scaledClock } from "./drivers/transport.js";
export type { EbbController } from "./drivers/ebb/protocol/ebb-controller.js";
export { MIN_RUN } from "./drivers/driver.js";
export type {
  Driver,
  Machine,
  MachineEvents,
  Playback,
  PlaybackGrowth,
  PenBefore,
  SupplyState,
  ControllerDescription,
  UsbId,
  VirtualBench,
  VirtualMachine,
} from "./drivers/driver.js";
export { HEIGHT_AGAIN, homeAgain, powerFailed, powerLost, powerLow } from "./drivers/faults.js";
export type { LivePart, MachineCommands, MachineState, PlannedPlot } from "./drivers/machine-job.js";
export { AHEAD_STEP_MS, type PenMoment, type PlotProgress } from "./drivers/playback-progress.js";

// pen sheet
export {
  PEN_SHEET_HEIGHT_MM,
  PEN_SHEET_MOTION,
  PEN_SHEET_WAITS_MS,
  PEN_SHEET_WIDTH_MM,
  penOfSheet,
  penSheet,
} from "./job/pen-sheet.js";

// ringing sheet
export {
  CHECK_ACCEL,
  NEXT_STAIRS_MM,
  ringingChecks,
  STAIRS_MM,
  stairsPath,
  type RingingCheck,
} from "./job/ringing-checks.js";
export {
  crestsOf,
  DAMPINGS,
  frequenciesOf,
  RINGING_MOTION,
  RINGING_SHEET_MM,
  ringingLine,
  ringingPath,
  ringingSheet,
  STRAIGHT_MM,
  type Axis,
  type Frequencies,
  type RippleReading,
  type RippleReadings,
} from "./job/ringing-sheet.js";

// export
export { codedLayerNames, svgOptionsOf } from "./export/coded-names.js";
export { toJson } from "./export/strokes-to-json.js";
export { trajectoryToSvg } from "./export/trajectory-to-svg.js";
