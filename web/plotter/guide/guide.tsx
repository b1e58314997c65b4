import { useState, type ReactNode } from "react";
import { findsHome, machineNamed, machineOf } from "../../../src/internal.js";
import type { HandMove } from "../../../src/schema/index.js";
import type { PageAction } from "../../state/page-action.js";
import { currentPlotter } from "../../state/store.js";
import { useActions, usePageState } from "../../state/use-store.js";
import { ActionButton } from "../../ui/action-button.js";
import { Button } from "../../ui/button.js";
import { Heights } from "../hand/heights.js";
import { HOME, isMovingByHand, MOTORS_OFF, STOP_MOVE, TEST_LINE } from "../plotter-actions.js";
import { ModelSelect } from "../model-select.js";
import { penText } from "../text.js";
import { MachinePicture } from "./machine-picture.js";
import { ModelCards } from "./model-cards.js";
import { guideText as words } from "./text.js";
import "./guide.css";

const STEPS = ["model", "home", "heights", "mark"] as const;
type Step = (typeof STEPS)[number];

/** The numbered steps to the first plot. Only the next one shows its help, and a finished home step folds to one line. */
export const Guide = () => {
  const { changeView } = useActions();
  const [tried, setTried] = useState<readonly Step[]>([]);
  const hasModel = usePageState((state) => currentPlotter(state)?.machine !== null);
  const hasDrawing = usePageState((state) => state.drawing !== null);
  const homesItself = usePageState(({ settings }) => findsHome(machineOf(settings)));
  // The model may be known from another screen.
  const done: readonly Step[] = hasModel ? ["model", ...tried] : tried;
  const note = (step: Step): void =>
    setTried((before) => [...before.filter((other) => other !== step), step]);
  const next = STEPS.find((step) => !done.includes(step)) ?? "plot";
  // The test line shows whether the heights are right, so its help stays beside it.
  const helped = done.at(-1) === "mark" ? "mark" : next;
  const step = (name: Step, help: ReactNode, content: ReactNode): ReactNode => (
    <li data-done={done.includes(name) || undefined} data-next={name === next || undefined}>
      {helped === name && help}
      {content}
    </li>
  );
  return (
    <section className="pen-at-hand guide" aria-label={words.firstPlot}>
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
        {step("model", null, <ModelChoice />)}
        {step(
          "home",
          <HomeHelp />,
          // Another model finds home in another way.
          <HomeStep
            key={String(homesItself)}
            homesItself={homesItself}
            isDone={done.includes("home")}
            onDone={() => note("home")}
          />,
        )}
        {step(
          "heights",
          <p className="note">{words.steps.heights}</p>,
          <Heights onTry={() => note("heights")} />,
        )}
        {step(
          "mark",
          <p className="note">{words.steps.mark}</p>,
          <ActionButton
            action={thenNote(TEST_LINE, { kind: "test-line" }, () => note("mark"))}
            className="test-line"
            hint={penText.testLineHint}
          />,
        )}
        {hasModel && (
          <li data-next={next === "plot" || undefined}>
            <p className="step-line">{hasDrawing ? words.plotStep : words.drawingStep}</p>
          </li>
        )}
      </ol>
    </section>
  );
};

/** A move by hand that is noted as done once it has succeeded. */
const thenNote = (action: PageAction, move: HandMove, note: () => void): PageAction => ({
  ...action,
  perform: ({ actions }) =>
    void actions.moveByHand(move).then((plotter) => {
      if (plotter) note();
    }),
});

/** Where home is. The corner is drawn for machines with a beam and an arm. */
const HomeHelp = () => {
  const machine = usePageState(({ settings }) => machineOf(settings));
  if (findsHome(machine)) return <p className="note">{words.steps.findsHome}</p>;
  if (machine.motors !== "mixed") return <p className="note">{words.steps.home}</p>;
  return (
    <div className="with-corner">
      <p className="note">{words.steps.homeOfArm}</p>
      <MachinePicture name="corner" />
    </div>
  );
};

interface HomeStepProps {
  readonly homesItself: boolean;
  readonly isDone: boolean;
  onDone(): void;
}

/** A plotter without a switch is pushed into its corner, and the user says when it is there. */
const HomeStep = ({ homesItself, isDone, onDone }: HomeStepProps) => {
  const [isAgain, setAgain] = useState(false);
  const isMoving = usePageState(isMovingByHand);
  if (isDone && !isAgain) {
    return (
      <p className="step-line">
        {words.homeDone}
        {/* Takes over the focus of the button that it replaces. */}
        <Button kind="link" autoFocus onClick={() => setAgain(true)}>
          {words.homeAgain}
        </Button>
      </p>
    );
  }
  const finish = (): void => {
    onDone();
    setAgain(false);
  };
  const inCorner: PageAction = { ...HOME, id: "in-corner", label: words.inCorner };
  return (
    <div className="home-buttons">
      {isMoving && <ActionButton action={STOP_MOVE} kind="danger" />}
      {!isMoving && !homesItself && <ActionButton action={MOTORS_OFF} />}
      <ActionButton
        action={
          homesItself
            ? thenNote(HOME, { kind: "home" }, finish)
            : thenNote(inCorner, { kind: "set-home" }, finish)
        }
      />
    </div>
  );
};

/** Which plotter this is: the question comes first, with the model that the board's own name tells. */
const ModelChoice = () => {
  const { chooseMachine } = useActions();
  const plotter = usePageState(currentPlotter);
  const name = usePageState(({ settings }) => machineOf(settings).name);
  // Null: not opened or closed yet.
  const [isOpen, setOpen] = useState<boolean | null>(null);
  const another = (
    <Button kind="link" autoFocus={isOpen === false} onClick={() => setOpen(true)}>
      {words.otherModel}
    </Button>
  );
  if (plotter?.machine !== null && !isOpen) {
    return (
      <p className="step-line">
        {name}
        {/* Takes over the focus of the choice that it replaces. */}
        {another}
      </p>
    );
  }
  const named = machineNamed(plotter?.boardName ?? "");
  return (
    <div className="model-choice" role="group" aria-label={words.whichPlotter}>
      <p className="step-line">
        {words.whichPlotter}
        {named && !isOpen && another}
      </p>
      {named && !isOpen ? (
        <Button kind="primary" onClick={() => chooseMachine(named)}>
          {words.modelNamed(named.name)}
        </Button>
      ) : (
        <>
          <ModelCards onChoose={() => setOpen(false)} />
          <ModelSelect
            label={words.allModels}
            {...(isOpen ? {} : { unchosen: words.chooseModel })}
            onChoose={() => setOpen(false)}
          />
        </>
      )}
    </div>
  );
};
