import { useEffect, useState } from "react";
import type { Job } from "../../../src/schema/index.js";
import type { SheetKind } from "../../preview/sheet.js";
import { hasHoldCard, HoldCard } from "../../queue/hold-card.js";
import { JobButtons } from "../../queue/job-buttons.js";
import { StateBadge } from "../../queue/job-head.js";
import { jobText, queueText } from "../../queue/text.js";
import type { Page } from "../../state/page-action.js";
import { ACTIVE_STATES, type HandDrawingState, type HandPen } from "../../state/store.js";
import { useActions, usePage, usePageState } from "../../state/use-store.js";
import { ActionButton } from "../../ui/action-button.js";
import { Button } from "../../ui/button.js";
import { NumberField } from "../../ui/fields/number-field.js";
import { Icon } from "../../ui/icon.js";
import { Notices } from "../../ui/notices.js";
import { watchText } from "../text.js";
import { FINISH_DRAWING, listenForUndo, UNDO_STROKE } from "./hand-actions.js";
import { BEHIND_S, HandDrawing, handDrawingOf } from "./hand-drawing.js";
import { HandSheet, sheetOf } from "./hand-sheet.js";
import { drawText as words } from "./text.js";
import "./draw-mode.css";

/** Drawing by hand: its status, its buttons, and the sheet that is drawn on. Nothing in it moves the sheet while a line is drawn. */
export const DrawMode = () => {
  const kind = useSheet();
  const state = usePageState(handDrawingOf);
  const job = usePageState(({ jobs }) => jobs.find(({ id }) => id === state?.jobId) ?? null);
  const isHeld = usePageState((page) => job !== null && hasHoldCard(page, job));
  if (!state) return null;
  return (
    <section className="watch" aria-label={watchText.status} data-mode="draw" data-phase={state.phase}>
      <div id="plot-status" tabIndex={-1} className="status-words">
        <p className="status-name">
          <strong>{words.title}</strong>
          {job && <StateBadge job={job} />}
        </p>
        <p className="status-figures">{figures(state)}</p>
      </div>
      <div className="status-actions">
        {state.phase === "broken" ? <BrokenButtons pen={state.pen} /> : <Buttons job={job} />}
      </div>
      {isHeld && job && (
        <div className="status-below">
          <HoldCard job={job} />
        </div>
      )}
      <div className="watch-area">
        <HandSheet kind={kind} foot={<Smoothing />}>
          {state.phase === "ready" && state.jobId === null && state.waitingMm === 0 && <How />}
          <Message state={state} />
        </HandSheet>
        <Notices />
      </div>
    </section>
  );
};

/** A drawing outlives this view: the user may look at Prepare while the pen draws. */
const sheets = new WeakMap<HandPen, SheetKind>();

const useSheet = (): SheetKind => {
  const page = usePage();
  const [{ drawing, kind }] = useState(() => openSheet(page));
  useEffect(() => drawing?.open(), [drawing]);
  useEffect(() => listenForUndo(page), [page]);
  return kind;
};

/** `drawing`: a new one, not shown yet. */
const openSheet = (page: Page): { readonly drawing: HandDrawing | null; readonly kind: SheetKind } => {
  const pen = handDrawingOf(page.store.getState())?.pen;
  const known = pen && sheets.get(pen);
  if (known) return { drawing: null, kind: known };
  const drawing = new HandDrawing(page);
  const kind = sheetOf(drawing);
  sheets.set(drawing, kind);
  return { drawing, kind };
};

const figures = ({ phase, jobId, lagS, waitingMm }: HandDrawingState): string => {
  if (phase === "broken") return words.brokenTitle;
  if (waitingMm === 0) return jobId === null ? words.nothingYet : words.upToDate;
  return lagS === 0 ? words.waits(waitingMm) : words.behind(lagS, waitingMm);
};

const Buttons = ({ job }: { job: Job | null }) => (
  <div className="draw-buttons">
    <div className="button-row">
      <ActionButton action={UNDO_STROKE} icon="undo" hasText />
      <ActionButton action={FINISH_DRAWING} kind="primary" />
    </div>
    {job && ACTIVE_STATES.includes(job.state) ? <JobButtons job={job} /> : <ButtonsToCome />}
  </div>
);

/** In the place of the job's buttons, so that nothing moves when the first line begins. */
const ButtonsToCome = () => (
  <div className="button-row job-buttons">
    <Button disabled>
      <Icon name="pause" />
      {jobText.pause}
    </Button>
    <Button disabled>{queueText.cancel}</Button>
    <Button kind="danger" disabled>
      {jobText.stopNow}
    </Button>
  </div>
);

const BrokenButtons = ({ pen }: { pen: HandPen }) => (
  <div className="button-row">
    <Button kind="primary" onClick={() => pen.keep()}>
      {words.keep}
    </Button>
    <Button onClick={() => pen.leave()}>{words.close}</Button>
  </div>
);

const Smoothing = () => {
  const pct = usePageState(({ view }) => view.smoothingPct);
  const { changeView } = useActions();
  return (
    <div className="draw-smoothing">
      <NumberField
        label={words.smoothing}
        unit="%"
        min={0}
        max={100}
        step={5}
        slider={[0, 100]}
        value={pct}
        onChange={(smoothingPct) => changeView({ smoothingPct })}
      />
    </div>
  );
};

const How = () => (
  <div className="paper-message draw-how">
    <strong>{words.howTitle}</strong>
    <p>{words.how}</p>
  </div>
);

/** Said by a screen reader when it changes, which is seldom: not the figures. */
const Message = ({ state }: { state: HandDrawingState }) => (
  <p className="draw-message" aria-live="polite">
    {messageOf(state)}
  </p>
);

const messageOf = ({ phase, fault, isBehind, hasRefused, hasLeftPaper }: HandDrawingState): string => {
  if (phase === "broken") return fault ?? "";
  if (phase === "finishing") return words.finishing;
  if (isBehind) {
    const wait = words.isBehind(BEHIND_S.most, BEHIND_S.again);
    return hasRefused ? `${words.refused} ${wait}` : wait;
  }
  return hasLeftPaper ? words.hasLeftPaper : "";
};
