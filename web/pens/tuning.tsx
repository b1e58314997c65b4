import type { Job } from "../../src/schema/index.js";
import { useSprings } from "../motion/use-springs.js";
import { isFirstPlot } from "../plotter/hand/pen-at-hand.js";
import { RINGING } from "../plotter/plotter-actions.js";
import { currentPlotter, type PageState } from "../state/store.js";
import { useIsUsed } from "../state/used-settings.js";
import { useActions, usePageState } from "../state/use-store.js";
import { ActionButton } from "../ui/action-button.js";
import { Button } from "../ui/button.js";
import { PenSheet, PlotPenSheet } from "./pen-sheet.js";
import { heightsText, tuningText as words } from "./text.js";
import "./tuning.css";

/** The first plot on a real plotter is done. */
const isTuningOffered = (state: PageState): boolean => {
  const plotter = currentPlotter(state);
  const isPlotted = state.jobs.some((job) => job.plotterId === plotter?.id && job.state === "done");
  return isPlotted && plotter?.kind === "serial" && !isFirstPlot(state) && !state.view.hidesTuning;
};

const isPenSheet = ({ name, state }: Job): boolean => name === heightsText.sheet.jobName && state === "done";

/** After the first plot, until the swing is measured: the two sheets that make plots faster. */
export const Tuning = () => {
  const isShown = usePageState(isTuningOffered);
  const hasPenSheet = usePageState(({ jobs }) => jobs.some(isPenSheet));
  const isMeasured = useSprings() !== null;
  const hasRinging = useIsUsed("motion.shaper");
  const { changeView } = useActions();
  if (!isShown || isMeasured) return null;
  return (
    <section className="tuning" aria-label={words.title}>
      <header>
        <h3>{words.title}</h3>
        <Button kind="link" aria-label={words.hideHint} onClick={() => changeView({ hidesTuning: true })}>
          {words.hide}
        </Button>
      </header>
      <ol>
        <li data-done={hasPenSheet || undefined}>
          {hasPenSheet ? (
            <PenSheet />
          ) : (
            <>
              <p className="note">{words.penHint}</p>
              <PlotPenSheet />
            </>
          )}
        </li>
        {hasRinging && (
          <li>
            <p className="note">{words.ringingHint}</p>
            <ActionButton action={RINGING} />
          </li>
        )}
      </ol>
    </section>
  );
};
