import type { Job } from "../../src/schema/index.js";
import { useSprings } from "../motion/use-springs.js";
import { isFirstPlot } from "../plotter/guide/first-plot.js";
import { RINGING } from "../plotter/plotter-actions.js";
import { currentPlotter, type PageState } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { ActionButton } from "../ui/action-button.js";
import { Button } from "../ui/button.js";
import { PenSheet } from "./pen-sheet.js";
import { heightsText, tuningText as words } from "./text.js";
import "./tuning.css";

/** The first plot is done, but the plotter's swing is not measured. */
const isUntuned = (state: PageState): boolean => {
  const id = currentPlotter(state)?.id;
  const isPlotted = state.jobs.some((job) => job.plotterId === id && job.state === "done");
  return isPlotted && !isFirstPlot(state) && !state.view.hidesTuning;
};

const isPenSheet = ({ name, state }: Job): boolean => name === heightsText.sheet.jobName && state === "done";

/** After the first plot: the two sheets that make plots faster. */
export const Tuning = () => {
  const isShown = usePageState(isUntuned);
  const hasPenSheet = usePageState(({ jobs }) => jobs.some(isPenSheet));
  const isMeasured = useSprings() !== null;
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
          <strong>{words.pen}</strong>
          <PenSheet />
        </li>
        <li>
          <strong>{words.ringing}</strong>
          <p className="note">{words.ringingHint}</p>
          <ActionButton action={RINGING} />
        </li>
      </ol>
    </section>
  );
};
