import { currentPlotter, type PageState } from "../../state/store.js";
import { usePageState } from "../../state/use-store.js";
import { ActionButton } from "../../ui/action-button.js";
import { lazyPart } from "../../ui/lazy-part.js";
import { HOME, isMovingByHand, MOTORS_OFF, STOP_MOVE, TEST_LINE } from "../plotter-actions.js";
import { penText as words } from "../text.js";
import { Heights } from "./heights.js";
import "./pen-at-hand.css";

const Guide = lazyPart(async () => (await import("../guide/guide.js")).Guide);

/** Home, heights and a test line, which every plot needs first. Before the first plot they are numbered steps. */
export const PenAtHand = () => {
  const isFirst = usePageState(isFirstPlot);
  return isFirst ? (
    <Guide />
  ) : (
    <div className="pen-at-hand">
      <HomeButtons />
      <Heights hasContact />
      <ActionButton action={TEST_LINE} className="test-line" hint={words.testLineHint} />
    </div>
  );
};

/** Shown while the plotter moves; for a watcher, too. */
export const StopMove = () => {
  const isMoving = usePageState(isMovingByHand);
  return isMoving && <ActionButton action={STOP_MOVE} kind="danger" />;
};

const HomeButtons = () => {
  const isMoving = usePageState(isMovingByHand);
  return (
    <div className="button-grid">
      {isMoving ? <StopMove /> : <ActionButton action={MOTORS_OFF} />}
      <ActionButton action={HOME} />
    </div>
  );
};

/** This plotter has never plotted. */
export const isFirstPlot = (state: PageState): boolean => {
  const id = currentPlotter(state)?.id;
  const hasPlotted = state.jobs.some((job) => job.plotterId === id && job.startedAt !== null);
  return !state.view.hidesFirstPlot && state.link === "connected" && !hasPlotted;
};
