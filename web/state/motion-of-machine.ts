/** Motion settings that depend on how the machine swings: the qualities, and what changes with another machine. */
import { motionOfQuality, qualityOf, type Quality, type Springs } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { isSame } from "./is-same.js";

type Motion = PlotSettings["motion"];

/** @throws PlotwrightError "bad-setting" for fine or fast on a machine that was not measured */
export const withQuality = (motion: Motion, quality: Quality, springs: Springs | null): Motion => {
  const step = motionOfQuality(quality, springs);
  // A motion has only one filter: the shaper excludes scurve.
  const mode = step.shaper !== "none" && motion.mode === "scurve" ? "blend" : motion.mode;
  return { ...motion, ...step, mode };
};

/** The same quality for another machine, or for one that was measured since. Custom numbers stay. */
export const motionForSprings = (motion: Motion, before: Springs | null, now: Springs | null): Motion => {
  if (isSame(before, now)) return plannable(motion, now);
  const quality = qualityOf(motion, before);
  if (quality === null) return plannable(motion, now);
  return withQuality(motion, now === null ? "normal" : quality, now);
};

/** Shaping needs a measured machine. */
export const plannable = (motion: Motion, springs: Springs | null): Motion =>
  springs === null && (motion.shaper ?? "none") !== "none" ? { ...motion, shaper: "none" } : motion;
