import { useState } from "react";
import type { MachineProfile } from "../../../src/index.js";
import { controllerOf, DIRECTIONS, machineTurned, type Direction } from "../../../src/internal.js";
import { useActions } from "../../state/use-store.js";
import { wizardText as words } from "./text.js";
import type { StepProps } from "./wizard-step.js";
import { Button } from "../../ui/button.js";

const MOVE_MM = 20;

type Question = "middle" | "x" | "y" | "check" | "home";

/** Makes two short moves and asks which way the carriage went, to find out how the motors are wired. */
export const DirectionStep = ({ profile, onNext }: StepProps) => {
  const [asked, setAsked] = useState<Question>("middle");
  const [draft, setDraft] = useState(profile);
  const [xWent, setXWent] = useState<Direction>("right");
  const [fault, setFault] = useState<string | null>(null);
  const { moveByHand } = useActions();
  const [isMoving, setMoving] = useState(false);
  // Uses the profile of the moves: with another controller, the next move would reconnect and lose this home.
  const setHome = async (): Promise<boolean> => (await moveByHand({ kind: "set-home" }, draft)) !== null;
  // Sets home before each move: with a wrong profile, the carriage may be on the wrong side of the last home.
  const jog = async (x: number, y: number): Promise<void> => {
    setMoving(true);
    if (await setHome()) {
      await moveByHand({ kind: "jog", dxMm: x, dyMm: y }, draft);
    }
    setMoving(false);
  };

  const answer = (went: Direction): void => {
    if (asked === "x") {
      setXWent(went);
      setAsked("y");
      return;
    }
    try {
      setDraft(machineTurned(draft, xWent, went));
      setFault(null);
      setAsked("check");
    } catch (error) {
      setFault(error instanceof Error ? error.message : String(error));
      setAsked("x");
    }
  };
  const slanted = (): void => {
    setDraft(withOtherMotors(draft));
    setFault(null);
    setAsked("x");
  };

  if (asked === "middle") {
    const begin = async (): Promise<void> => {
      if (await setHome()) setAsked("x");
    };
    return <PushByHand hint={words.middleHint} done={words.inTheMiddle} onDone={() => void begin()} />;
  }
  if (asked === "check") {
    return (
      <>
        <p>{words.checkHint}</p>
        <div className="button-row">
          <Button disabled={isMoving} onClick={() => void jog(MOVE_MM, 0)}>
            {words.moveRight}
          </Button>
          <Button disabled={isMoving} onClick={() => void jog(0, MOVE_MM)}>
            {words.moveNearer}
          </Button>
        </div>
        <div className="button-row">
          <Button kind="primary" onClick={() => setAsked("home")}>
            {words.itDoes}
          </Button>
          <Button onClick={() => setAsked("x")}>{words.askAgain}</Button>
        </div>
      </>
    );
  }
  if (asked === "home") {
    // Home is still where the last move began. From there a plot could run into the end.
    const finish = async (): Promise<void> => {
      if (await setHome()) onNext(draft);
    };
    return <PushByHand hint={words.homeHint} done={words.setHome} onDone={() => void finish()} />;
  }
  return (
    <>
      {fault !== null && (
        <p className="note note-error" role="alert">
          {fault}
        </p>
      )}
      <Button
        kind="primary"
        disabled={isMoving}
        onClick={() => void (asked === "x" ? jog(MOVE_MM, 0) : jog(0, MOVE_MM))}
      >
        {asked === "x" ? words.moveFirst : words.moveSecond}
      </Button>
      <Answers onAnswer={answer} onSlanted={controllerOf(profile).scaleSettings ? null : slanted} />
    </>
  );
};

interface PushByHandProps {
  readonly hint: string;
  readonly done: string;
  onDone(): void;
}

/** Asks the user to push the carriage, with the motors off. */
const PushByHand = ({ hint, done, onDone }: PushByHandProps) => {
  const { motorsOff } = useActions();
  return (
    <>
      <p>{hint}</p>
      <div className="button-row">
        <Button onClick={() => void motorsOff()}>{words.motorsOff}</Button>
        <Button kind="primary" onClick={onDone}>
          {done}
        </Button>
      </div>
    </>
  );
};

const withOtherMotors = (profile: MachineProfile): MachineProfile => ({
  ...profile,
  motors: profile.motors === "mixed" ? "direct" : "mixed",
});

interface AnswersProps {
  onAnswer(went: Direction): void;
  /** Null: the controller mixes the motors by itself. */
  readonly onSlanted: (() => void) | null;
}

const Answers = ({ onAnswer, onSlanted }: AnswersProps) => (
  <fieldset className="subgroup">
    <legend>{words.whichWay}</legend>
    <div className="button-grid">
      {DIRECTIONS.map((direction) => (
        <Button key={direction} onClick={() => onAnswer(direction)}>
          {words.directions[direction]}
        </Button>
      ))}
    </div>
    {onSlanted ? (
      <Button kind="link" onClick={onSlanted}>
        {words.slanted}
      </Button>
    ) : (
      <p className="note">{words.slantedByController}</p>
    )}
    <p className="note">{words.notAtAll}</p>
  </fieldset>
);
