import { useMemo, useState, type ReactNode } from "react";
import { OVERLAP_TABLE, PEN_TABLE } from "../../src/internal.js";
import { activeJob, currentPlotter, isReady, otherOperator, type PageState } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { SettingField } from "../ui/setting-field.js";
import { servoFollower } from "./servo-follow.js";
import { penText } from "./text.js";
import { useHand } from "./use-hand.js";
import "./pen-at-hand.css";

const words = penText;

type Step = "home" | "heights" | "mark";

/** Home, heights and a test line: what every plot begins with. Before the first plot they are numbered steps. */
export const PenAtHand = () => {
  const isFirst = usePageState(isFirstPlot);
  const { changeView } = useActions();
  const [done, setDone] = useState<ReadonlySet<Step>>(new Set());
  const note = (step: Step): void => setDone(new Set([...done, step]));
  const part = (step: Step, content: ReactNode): ReactNode =>
    isFirst ? (
      <li key={step} data-done={done.has(step) || undefined}>
        <p className="note">{words.steps[step]}</p>
        {content}
      </li>
    ) : (
      <div key={step}>{content}</div>
    );
  const parts = [
    part("home", <HomeButtons onHome={() => note("home")} />),
    part("heights", <Heights onTry={() => note("heights")} />),
    part("mark", <TestLine onDraw={() => note("mark")} />),
  ];
  if (!isFirst) return <div className="pen-at-hand">{parts}</div>;
  return (
    <section className="pen-at-hand first-plot" aria-label={words.firstPlot}>
      <h3>{words.firstPlot}</h3>
      <ol>
        {parts}
        <li>
          <p className="note">{words.steps.plot}</p>
        </li>
      </ol>
      <button type="button" className="link" onClick={() => changeView({ hidesFirstPlot: true })}>
        {words.hide}
      </button>
    </section>
  );
};

/** This plotter has never plotted. */
const isFirstPlot = (state: PageState): boolean => {
  const id = currentPlotter(state)?.id;
  const hasPlotted = state.jobs.some((job) => job.plotterId === id && job.startedAt !== null);
  return !state.view.hidesFirstPlot && state.link === "connected" && !hasPlotted;
};

const HomeButtons = ({ onHome }: { onHome(): void }) => {
  const isOff = usePageState((state) => !isReady(state));
  const { home, motorsOff } = useActions();
  return (
    <div className="button-grid">
      <button
        type="button"
        className="button"
        disabled={isOff}
        onClick={() => {
          onHome();
          void home();
        }}
      >
        {words.home}
      </button>
      <button type="button" className="button" disabled={isOff} onClick={() => void motorsOff()}>
        {words.motorsOff}
      </button>
    </div>
  );
};

/**
 * Whether the pen can follow the slider. While the pen moves, the plotter is briefly busy, and the slider still
 * works.
 */
const mayFollow = (state: PageState): boolean => {
  const connection = currentPlotter(state)?.connection;
  return (
    state.link === "connected" &&
    activeJob(state) === null &&
    (connection === "idle" || connection === "busy")
  );
};

const Heights = ({ onTry }: { onTry(): void }) => {
  const pen = usePageState((state) => state.settings.pen);
  const isFollowing = usePageState(mayFollow);
  // If another browser is the operator, storing the heights asks to take over first.
  const isOthers = usePageState((state) => otherOperator(state) !== null);
  const { changeSettings, movePen } = useActions();
  const follow = useMemo(
    () =>
      servoFollower(
        ({ isUp, pct }: { isUp: boolean; pct: number }) => movePen(isUp, pct),
        (delayMs, callback) => void setTimeout(callback, delayMs),
      ),
    [movePen],
  );
  const row = (which: "upPct" | "downPct"): ReactNode => (
    <div className="field-with-button">
      <SettingField
        setting={PEN_TABLE[which]}
        value={pen[which]}
        onChange={(pct) =>
          changeSettings(`pen ${which}`, (settings) => ({
            ...settings,
            pen: { ...settings.pen, [which]: pct },
          }))
        }
        onSlide={(pct) => {
          onTry();
          if (isFollowing && !isOthers) follow({ isUp: which === "upPct", pct });
        }}
      />
      <button
        type="button"
        className="button"
        disabled={!isFollowing}
        onClick={() => {
          onTry();
          follow({ isUp: which === "upPct", pct: pen[which] });
        }}
      >
        {which === "upPct" ? words.up : words.down}
      </button>
    </div>
  );
  const touch = (contactPct: number): void => {
    onTry();
    const pct = pen.downPct + ((pen.upPct - pen.downPct) * contactPct) / 100;
    if (isFollowing) follow({ isUp: false, pct });
  };
  return (
    <div className="pen-heights">
      {row("upPct")}
      {row("downPct")}
      {pen.overlap !== "off" && (
        <>
          <div className="field-with-button">
            <SettingField
              setting={OVERLAP_TABLE.contactPct}
              value={pen.contactPct}
              onChange={(contactPct) =>
                changeSettings("pen contactPct", (settings) => ({
                  ...settings,
                  pen: { ...settings.pen, contactPct },
                }))
              }
              onSlide={touch}
            />
            <button
              type="button"
              className="button"
              disabled={!isFollowing}
              onClick={() => touch(pen.contactPct)}
            >
              {words.touch}
            </button>
          </div>
          <p className="note">{words.touchHint}</p>
        </>
      )}
    </div>
  );
};

const TestLine = ({ onDraw }: { onDraw(): void }) => {
  const isOff = usePageState((state) => !isReady(state));
  const hand = useHand();
  return (
    <button
      type="button"
      className="button test-line"
      title={words.testLineHint}
      disabled={isOff}
      onClick={() => {
        onDraw();
        void hand.testLine();
      }}
    >
      {words.testLine}
    </button>
  );
};
