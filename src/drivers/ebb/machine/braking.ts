/** The settings for the braking and the lift of a stop. */
import { settingsIdOf, type StrokeSet } from "../../../drawing/stroke-set.js";
import { withLayerCodes } from "../../../plan/coded-layers.js";
import { accelEverywhere, drawLimitsOf } from "../../../plan/limits.js";
import { penOfLayer, timedPen, type TimedPen } from "../../../plan/pen/pen-times.js";
import type { StrokePosition } from "../../../plan/trajectory.js";
import { machineOf } from "../../../machines/profiles.js";
import type { MachineSettings } from "../../machine-job.js";
import { motionForFirmware } from "../protocol/firmware-motion.js";

/** The settings of the layer at `place`; null while travelling. */
export function brakingAt(
  settings: MachineSettings,
  { layer, layers }: StrokeSet,
  place: StrokePosition | null,
  firmware: string,
): { limits: { drawAccel: number; travelAccel: number }; pen: TimedPen } {
  const { motion: coded, pen: codedPen } = withLayerCodes(settings, layers);
  const pen = timedPen(codedPen, machineOf(settings));
  const motion = motionForFirmware(coded, firmware);
  const own = place ? layers[layer[place.stroke]] : undefined;
  const draw = own ? drawLimitsOf(motion, settingsIdOf(own)) : motion.draw;
  const limits = {
    drawAccel: accelEverywhere(motion, draw.accelMmPerS2),
    travelAccel: accelEverywhere(motion, motion.travel.accelMmPerS2),
  };
  return { limits, pen: own ? penOfLayer(pen, settingsIdOf(own)) : pen };
}
