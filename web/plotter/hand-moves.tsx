import { useState } from "react";
import { activeJob, currentPlotter } from "../state/store.js";
import { useActions, usePageState, usePageStore } from "../state/use-store.js";
import { movesText } from "./hand-text.js";
import { Button } from "../ui/button.js";
import { NumberField } from "../ui/number-field.js";
import { NudgeSettings } from "./pen-nudge.js";
import { JogPad } from "./jog-pad.js";
import { drawnBoxMm } from "./drawn-box.js";
import { useHand } from "./use-hand.js";
import "./hand-moves.css";

const words = movesText;
const MAX_MM = 5_000;

/** Jog pad, moves to a position, and small moves that prepare a plot. Disabled during a plot. */
export const HandMoves = () => {
  const hand = useHand();
  const { home } = useActions();
  const hasJob = usePageState((state) => activeJob(state) !== null);
  const connection = usePageState((state) => currentPlotter(state)?.connection ?? "absent");
  const isOff = hasJob || (connection !== "idle" && connection !== "busy");
  return (
    <div className="hand-moves">
      {hasJob && <p className="note">{words.heldOff}</p>}
      <JogPad isOff={isOff} jog={hand.jog} home={home} />
      <Walk isOff={isOff} />
      <Moves isOff={isOff} />
      <NudgeSettings isOff={isOff} />
    </div>
  );
};

const Walk = ({ isOff }: { isOff: boolean }) => {
  const hand = useHand();
  const [xMm, setX] = useState(0);
  const [yMm, setY] = useState(0);
  return (
    <form
      className="walk"
      onSubmit={(event) => {
        event.preventDefault();
        void hand.walk(xMm, yMm);
      }}
    >
      <div className="field-pair">
        <NumberField
          label={words.walkX}
          value={xMm}
          unit="mm"
          min={0}
          max={MAX_MM}
          step={1}
          onChange={setX}
        />
        <NumberField
          label={words.walkY}
          value={yMm}
          unit="mm"
          min={0}
          max={MAX_MM}
          step={1}
          onChange={setY}
        />
      </div>
      <Button type="submit" disabled={isOff}>
        {words.walk}
      </Button>
    </form>
  );
};

const Moves = ({ isOff }: { isOff: boolean }) => {
  const hand = useHand();
  const store = usePageStore();
  const box = usePageState(drawnBoxMm);
  const moves = [
    [words.setHome, words.setHomeHint, () => hand.setHome()],
    [words.cyclePen, words.cyclePenHint, () => hand.cyclePen()],
    [
      words.frame,
      words.frameHint,
      () => {
        const now = drawnBoxMm(store.getState());
        return now ? hand.frameBox(now) : Promise.resolve(null);
      },
    ],
    [words.testPatch, words.testPatchHint, () => hand.testPatch()],
  ] as const;
  return (
    <div className="button-grid">
      {moves.map(([label, hint, run]) => (
        <Button
          key={label}
          title={hint}
          disabled={isOff || (label === words.frame && box === null)}
          onClick={() => void run()}
        >
          {label}
        </Button>
      ))}
    </div>
  );
};
