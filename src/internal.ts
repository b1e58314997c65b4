/** What server and web use besides the public library. No promise is made to anybody else. */
export { prepareJob, type PreparedJob } from "./job/prepare-job.js";
export {
  isAllowed,
  rangeInWords,
  type NumberSetting,
  type Setting,
  type SwitchSetting,
} from "./settings/setting.js";
export { SETTING_FLAGS, flagInWords, valuesInWords, type SettingFlag } from "./settings/tables.js";
export { DRAW_TABLE, EASE_TABLE, FIT_TABLE, TRAVEL_TABLE } from "./settings/motion.js";
export { DROP_RATE, LAYER_WAIT, OVERLAP_TABLE, PEN_TABLE, PLOT_PEN_TABLE } from "./settings/pen.js";
export { HATCH_TABLE, LAYER_REPEATS, PAPER_TABLE, PREPARE_TABLE } from "./settings/prepare.js";
export type { EbbController } from "./machines/profile.js";
export { STREAM_TABLE } from "./settings/stream.js";
export { isDrawingName, DRAWING_EXTENSIONS } from "./import/registry.js";
export { encodingOf, textOfBytes } from "./import/text-of-bytes.js";
export { movedPlace, pointOfPlace } from "./plan/place-on-drawing.js";
export { placeBehindSent, stoppedPlace } from "./plan/stopped-place.js";
export { driverOf } from "./drivers/registry.js";
export type {
  Driver,
  Machine,
  MachineEvents,
  MachineRun,
  PlaceAhead,
  VirtualMachine,
} from "./drivers/driver.js";
export { powerLost, powerLow } from "./drivers/faults.js";
export type { MachineState, PlannedPlot } from "./drivers/machine-job.js";
export type { PlotProgress } from "./drivers/run-progress.js";
