/** What server and web use besides the public library. No promise is made to anybody else. */
export { followedSettings, OLDEST_PLANNED_FIRMWARE } from "./job/plan-job.js";
export { planWalk } from "./job/plan-walk.js";
export {
  isAllowed,
  rangeInWords,
  type NumberSetting,
  type Setting,
  type SwitchSetting,
} from "./settings/setting.js";
export { SETTING_FLAGS, flagInWords, valuesInWords, type SettingFlag } from "./settings/tables.js";
export { DRAW_TABLE, EASE_TABLE, FIT_TABLE, TRAVEL_TABLE } from "./settings/motion.js";
export { DROP_RATE, HOP_TABLE, LAYER_WAIT, PEN_TABLE, PLOT_PEN_TABLE } from "./settings/pen.js";
export { HATCH_TABLE, LAYER_REPEATS, PAPER_TABLE, PREPARE_TABLE } from "./settings/prepare.js";
export type { EbbController } from "./machines/profile.js";
export { isPenUpBefore, penMovesOf } from "./plan/pen-moves.js";
export { STREAM_TABLE } from "./settings/stream.js";
export { reseatWaitS } from "./plan/pen-times.js";
export { mostAheadS } from "./drivers/ebb/stream/streamer.js";
export type { PollTime, RefusedCommand } from "./drivers/ebb/stream/stream-types.js";
export { nextPlace, placeAt } from "./plan/place-on-plan.js";
export { movedPlace, pointOfPlace, snappedPlace, strokeLengthMm } from "./plan/place-on-drawing.js";
export { placeBehindSent, stoppedPlace } from "./plan/stopped-place.js";
export { placeFromMotors } from "./machines/motors.js";
export {
  boardStateBefore,
  commandAfter,
  restingStream,
  withoutDrop,
} from "./drivers/ebb/stream/cut-streams.js";
