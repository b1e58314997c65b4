import { useState } from "react";
import type { Job, PlotSettings } from "../../src/schema/index.js";
import { KeepHeights } from "../plotter/hand/pen-nudge.js";
import { mayOperate } from "../state/store.js";
import { useActions, useBackend, useIsConnected, usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { formatCount, formatDuration, formatLength } from "../ui/format.js";
import { useMotionChange } from "../ui/use-change.js";
import { EndedButtons } from "./ended-buttons.js";
import type { PictureFormat } from "./plotted-picture.js";
import { expectedSOf } from "./queue-time.js";
import { doneText as words } from "./axis-text.js";
import "./done.css";

/** Of a finished plot: how long it took, compared with what was expected, and what it drew. */
export const DoneFigures = ({ job }: { job: Job }) => {
  const { stats } = job;
  return (
    <div className="done-figures">
      <p className="status-figures">
        <span className="status-large">{formatDuration(plottedSOf(job))}</span>
        <span>{againstEstimate(job)}</span>
      </p>
      {stats && (
        <p className="note">
          {words.drawn(formatLength(stats.drawMm), stats.strokeCount, formatCount(stats.strokeCount))}
        </p>
      )}
    </div>
  );
};

export const plottedSOf = ({ plottedS, elapsedS }: Job): number => plottedS ?? elapsedS;

/** A difference that nobody would notice on a clock is none. */
const SAME_S = 2;
const SAME_SHARE = 0.01;

/** "3 % longer than expected"; empty if nothing was expected. */
export const againstEstimate = (job: Job): string => {
  const expectedS = expectedSOf(job);
  if (expectedS === null) return "";
  const moreS = plottedSOf(job) - expectedS;
  if (Math.abs(moreS) <= Math.max(SAME_S, SAME_SHARE * expectedS)) return words.asExpected;
  return moreS > 0
    ? words.longer(formatDuration(moreS), formatDuration(expectedS))
    : words.shorter(formatDuration(-moreS), formatDuration(expectedS));
};

/** Plot it again, or save its picture. */
export const DoneButtons = ({ job }: { job: Job }) => (
  <div className="button-row done-buttons">
    <EndedButtons job={job} />
    <SavePicture job={job} format="png" />
    <SavePicture job={job} format="svg" />
  </div>
);

const SavePicture = ({ job, format }: { job: Job; format: PictureFormat }) => {
  const save = useSavePicture(job);
  const [isBusy, setBusy] = useState(false);
  const isOff = !useIsConnected();
  const run = async (): Promise<void> => {
    setBusy(true);
    await save(format);
    setBusy(false);
  };
  return (
    <Button disabled={isOff || isBusy} aria-label={words.saveNamed(format)} onClick={() => void run()}>
      {words.save(format)}
    </Button>
  );
};

/** Saves the picture of a finished plot, or says why it can't. */
export const useSavePicture = (job: Job): ((format: PictureFormat) => Promise<void>) => {
  const backend = useBackend();
  const { notify } = useActions();
  return async (format) => {
    try {
      const { savePicture } = await import("./plotted-picture.js");
      await savePicture(backend, job, format);
    } catch (error) {
      notify("error", words.notSaved(error instanceof Error ? error.message : String(error)));
    }
  };
};

/** Offers to keep what was changed while it plotted. */
export const KeepChanges = ({ job }: { job: Job }) => (
  <>
    <KeepHeights job={job} />
    <KeepSpeed job={job} />
  </>
);

type Motion = PlotSettings["motion"];
const scaled = <T extends { readonly speedMmPerS: number }>(limits: T, share: number): T => ({
  ...limits,
  speedMmPerS: Math.round(limits.speedMmPerS * share * 10) / 10,
});

/** The speeds at which the plot ran at last. */
export const speedsOf = ({ settings: { motion }, speedPct }: Job): Pick<Motion, "draw" | "travel"> => ({
  draw: scaled(motion.draw, speedPct / 100),
  travel: scaled(motion.travel, speedPct / 100),
});

/** Not offered for other settings than those of the job: the share of its speeds would mean something else. */
const KeepSpeed = ({ job }: { job: Job }) => {
  const { motion } = job.settings;
  const isOffered = usePageState(
    (state) =>
      mayOperate(state) &&
      job.speedPct !== 100 &&
      state.settings.motion.draw.speedMmPerS === motion.draw.speedMmPerS &&
      state.settings.motion.travel.speedMmPerS === motion.travel.speedMmPerS,
  );
  const change = useMotionChange();
  if (!isOffered) return null;
  return (
    <p className="keep-height">
      {words.keepSpeed(job.speedPct)}
      <Button kind="small" onClick={() => change("speeds", speedsOf(job))}>
        {words.keep}
      </Button>
    </p>
  );
};
