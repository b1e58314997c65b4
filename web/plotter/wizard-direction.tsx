import { useState } from "react";
import type { MachineProfile } from "../../src/index.js";
import { DIRECTIONS, machineTurned, type Direction } from "../../src/internal.js";
import { useActions } from "../state/use-store.js";
import { wizardText } from "./wizard-text.js";
import { useHand } from "./use-hand.js";
import type { StepProps } from "./wizard-step.js";

const words = wizardText;
const MOVE_MM = 20;

type Asked = "middle" | "x" | "y" | "check";

/** Two short moves. Their real directions show how the motors are wired. */
export const DirectionStep = ({ profile, settingsWith, onNext }: StepProps) => {
  const [asked, setAsked] = useState<Asked>("middle");
  const [draft, setDraft] = useState(profile);
  const [xWent, setXWent] = useState<Direction>("right");
  const [fault, setFault] = useState<string | null>(null);
  const hand = useHand();
  const { motorsOff } = useActions();
  const [isMoving, setMoving] = useState(false);
  // Sets home before each move: with a wrong profile, the carriage may be on the wrong side of the last home.
  const jog = async (x: number, y: number): Promise<void> => {
    setMoving(true);
    if (await hand.setHome()) await hand.jog(x, y, settingsWith(draft));
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
    setAsked("x");
  };

  if (asked === "middle") {
    const begin = async (): Promise<void> => {
      if (await hand.setHome()) setAsked("x");
    };
    return (
      <>
        <p>{words.middleHint}</p>
        <div className="button-row">
          <button type="button" className="button" onClick={() => void motorsOff()}>
            {words.motorsOff}
          </button>
          <button type="button" className="button button-primary" onClick={() => void begin()}>
            {words.inTheMiddle}
          </button>
        </div>
      </>
    );
  }
  if (asked === "check") {
    return (
      <>
        <p>{words.checkHint}</p>
        <div className="button-row">
          <button type="button" className="button" disabled={isMoving} onClick={() => void jog(MOVE_MM, 0)}>
            {words.moveRight}
          </button>
          <button type="button" className="button" disabled={isMoving} onClick={() => void jog(0, MOVE_MM)}>
            {words.moveNearer}
          </button>
        </div>
        <div className="button-row">
          <button type="button" className="button button-primary" onClick={() => onNext(draft)}>
            {words.itDoes}
          </button>
          <button type="button" className="button" onClick={() => setAsked("x")}>
            {words.askAgain}
          </button>
        </div>
      </>
    );
  }
  return (
    <>
      {fault !== null && (
        <p className="note note-error" role="alert">
          {fault}
        </p>
      )}
      <button
        type="button"
        className="button button-primary"
        disabled={isMoving}
        onClick={() => void (asked === "x" ? jog(MOVE_MM, 0) : jog(0, MOVE_MM))}
      >
        {asked === "x" ? words.moveFirst : words.moveSecond}
      </button>
      <Answers question={words.whichWay} onAnswer={answer} onSlanted={slanted} />
    </>
  );
};

const withOtherMotors = (profile: MachineProfile): MachineProfile => ({
  ...profile,
  motors: profile.motors === "mixed" ? "direct" : "mixed",
});

interface AnswersProps {
  readonly question: string;
  onAnswer(went: Direction): void;
  onSlanted(): void;
}

const Answers = ({ question, onAnswer, onSlanted }: AnswersProps) => (
  <fieldset className="subgroup">
    <legend>{question}</legend>
    <div className="button-grid">
      {DIRECTIONS.map((direction) => (
        <button key={direction} type="button" className="button" onClick={() => onAnswer(direction)}>
          {words.directions[direction]}
        </button>
      ))}
    </div>
    <button type="button" className="link" onClick={onSlanted}>
      {words.slanted}
    </button>
    <p className="note">{words.notAtAll}</p>
  </fieldset>
);
