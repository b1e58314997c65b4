import { useMemo, useState, type ReactNode } from "react";
import { findsHome, machineNamed, machineOf, OVERLAP_TABLE, PEN_TABLE } from "../../../src/internal.js";
import { activeJob, currentPlotter, otherOperator, type PageState } from "../../state/store.js";
import { useActions, usePageState } from "../../state/use-store.js";
import { ActionButton } from "../../ui/action-button.js";
import { Button } from "../../ui/button.js";
import { SettingField } from "../../ui/fields/setting-field.js";
import { usePenChange } from "../../ui/use-change.js";
import { HOME, isMovingByHand, MOTORS_OFF, STOP_MOVE, TEST_LINE } from "../plotter-actions.js";
import { ModelSelect } from "../model-select.js";
import { servoFollower } from "./servo-follow.js";
import { penText as words } from "../text.js";
import "./pen-at-hand.css";

const STEPS = ["model", "home", "heights", "mark"] as const;
type Step = (typeof STEPS)[number];

/** Home, heights and a test line, which every plot needs first. Before the first plot they are numbered steps. */
export const PenAtHand = () => {
  const isFirst = usePageState(isFirstPlot);
  return isFirst ? (
    <FirstPlot />
  ) : (
    <div className="pen-at-hand">
      <HomeButtons />
      <Heights hasContact />
      <TestLine />
    </div>
  );
};

/** Only the next step shows its help, and a finished home step folds to one line, so that the queue stays visible. */
const FirstPlot = () => {
  const { changeView } = useActions();
  const [tried, setDone] = useState<readonly Step[]>([]);
  const hasModel = usePageState((state) => currentPlotter(state)?.machine !== null);
  const homesItself = usePageState(({ settings }) => findsHome(machineOf(settings)));
  // The model may be known from another screen.
  const done: readonly Step[] = hasModel ? ["model", ...tried] : tried;
  const [isHomeAgain, setHomeAgain] = useState(false);
  const note = (step: Step): void => setDone([...tried.filter((other) => other !== step), step]);
  const next = STEPS.find((step) => !done.includes(step)) ?? "plot";
  // The test line shows whether the heights are right, so its help stays beside it.
  const helped = done.at(-1) === "mark" ? "mark" : next;
  const isHomeFolded = done.includes("home") && !isHomeAgain;
  const helpOf = (name: Step): string | null => {
    if (name === "model") return null;
    return name === "home" && homesItself ? words.steps.findsHome : words.steps[name];
  };
  const step = (name: Step, content: ReactNode): ReactNode => (
    <li data-done={done.includes(name) || undefined}>
      {helped === name && helpOf(name) && <p className="note">{helpOf(name)}</p>}
      {content}
    </li>
  );
  return (
    <section className="pen-at-hand first-plot" aria-label={words.firstPlot}>
      <header>
        <h3>{words.firstPlot}</h3>
        <Button
          kind="link"
          aria-label={words.hideHint}
          title={words.hideHint}
          onClick={() => changeView({ hidesFirstPlot: true })}
        >
          {words.hide}
        </Button>
      </header>
      <ol>
        {step("model", <ModelChoice />)}
        {step(
          "home",
          isHomeFolded ? (
            <p className="step-line">
              {words.homeDone}
              {/* Takes over the focus of the button that it replaces. */}
              <Button kind="link" autoFocus onClick={() => setHomeAgain(true)}>
                {words.homeAgain}
              </Button>
            </p>
          ) : (
            <HomeButtons
              onHome={() => {
                note("home");
                setHomeAgain(false);
              }}
            />
          ),
        )}
        {step("heights", <Heights onTry={() => note("heights")} />)}
        {step("mark", <TestLine onDraw={() => note("mark")} />)}
        {hasModel && (
          <li>
            <p className="step-line">{words.plotStep}</p>
          </li>
        )}
      </ol>
    </section>
  );
};

/** Which plotter this is: the question comes first, with the model that the board's own name tells. */
const ModelChoice = () => {
  const { chooseMachine } = useActions();
  const plotter = usePageState(currentPlotter);
  const name = usePageState(({ settings }) => machineOf(settings).name);
  // Null: not opened or closed yet.
  const [isOpen, setOpen] = useState<boolean | null>(null);
  if (plotter?.machine !== null && !isOpen) {
    return (
      <p className="step-line">
        {name}
        {/* Takes over the focus of the choice that it replaces. */}
        <Button kind="link" autoFocus={isOpen === false} onClick={() => setOpen(true)}>
          {words.otherModel}
        </Button>
      </p>
    );
  }
  const named = machineNamed(plotter?.boardName ?? "");
  return (
    <>
      {named && !isOpen && (
        <Button kind="primary" onClick={() => chooseMachine(named)}>
          {words.modelNamed(named.name)}
        </Button>
      )}
      <ModelSelect
        label={words.whichPlotter}
        {...(isOpen ? {} : { unchosen: words.chooseModel })}
        onChoose={() => setOpen(false)}
      />
    </>
  );
};

/** This plotter has never plotted. */
export const isFirstPlot = (state: PageState): boolean => {
  const id = currentPlotter(state)?.id;
  const hasPlotted = state.jobs.some((job) => job.plotterId === id && job.startedAt !== null);
  return !state.view.hidesFirstPlot && state.link === "connected" && !hasPlotted;
};

const HomeButtons = ({ onHome }: { onHome?(): void }) => {
  const isMoving = usePageState(isMovingByHand);
  return (
    <div className="button-grid">
      <ActionButton action={HOME} onPress={onHome} />
      {isMoving ? <StopMove /> : <ActionButton action={MOTORS_OFF} />}
    </div>
  );
};

/** Shown while the plotter moves; for a watcher, too. */
export const StopMove = () => {
  const isMoving = usePageState(isMovingByHand);
  return isMoving && <ActionButton action={STOP_MOVE} kind="danger" />;
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

interface HeightsProps {
  /** The height at which the tip touches can be set, too. */
  readonly hasContact?: boolean;
  /** The pen was moved. */
  onTry?(): void;
}

const Heights = ({ hasContact, onTry }: HeightsProps) => {
  const pen = usePageState((state) => state.settings.pen);
  const isFollowing = usePageState(mayFollow);
  // If another browser is the operator, storing the heights asks to take over first.
  const isOthers = usePageState((state) => otherOperator(state) !== null);
  const { movePen } = useActions();
  const change = usePenChange();
  const follow = useMemo(
    () => servoFollower(({ isUp, pct }: { isUp: boolean; pct: number }) => movePen(isUp, pct)),
    [movePen],
  );
  const row = (which: "upPct" | "downPct"): ReactNode => (
    <div className="field-with-button">
      <SettingField
        setting={PEN_TABLE[which]}
        value={pen[which]}
        onChange={(pct) => change({ [which]: pct })}
        onSlide={(pct) => {
          onTry?.();
          if (isFollowing && !isOthers) follow({ isUp: which === "upPct", pct });
        }}
      />
      <Button
        disabled={!isFollowing}
        onClick={() => {
          onTry?.();
          follow({ isUp: which === "upPct", pct: pen[which] });
        }}
      >
        {which === "upPct" ? words.up : words.down}
      </Button>
    </div>
  );
  const touch = (contactPct: number): void => {
    onTry?.();
    const pct = pen.downPct + ((pen.upPct - pen.downPct) * contactPct) / 100;
    if (isFollowing) follow({ isUp: false, pct });
  };
  return (
    <div className="pen-heights">
      {row("upPct")}
      {row("downPct")}
      {hasContact && pen.overlap !== "off" && (
        <>
          <div className="field-with-button">
            <SettingField
              setting={OVERLAP_TABLE.contactPct}
              value={pen.contactPct}
              onChange={(contactPct) => change({ contactPct })}
              onSlide={touch}
            />
            <Button disabled={!isFollowing} onClick={() => touch(pen.contactPct)}>
              {words.touch}
            </Button>
          </div>
          <p className="note">{words.touchHint}</p>
        </>
      )}
    </div>
  );
};

const TestLine = ({ onDraw }: { onDraw?(): void }) => (
  <ActionButton action={TEST_LINE} className="test-line" hint={words.testLineHint} onPress={onDraw} />
);
