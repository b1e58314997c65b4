import { useState } from "react";
import { activeJob } from "../../state/store.js";
import { useActions, usePageState } from "../../state/use-store.js";
import { movesText as words } from "./text.js";
import { ActionButton } from "../../ui/action-button.js";
import { Button } from "../../ui/button.js";
import { MmPair } from "../../ui/fields/number-field.js";
import { NudgeSettings } from "./pen-nudge.js";
import { JogPad } from "./jog-pad.js";
import { START_HERE } from "../../preview/preview-actions.js";
import { previewText } from "../../preview/text.js";
import { areMovesOff, CYCLE_PEN, SET_HOME, TEST_PATCH } from "../plotter-actions.js";
import "./hand-moves.css";

/** Jog pad, moves to a position, and small moves that prepare a plot. Disabled during a plot. */
export const HandMoves = () => {
  const { moveByHand } = useActions();
  const hasJob = usePageState((state) => activeJob(state) !== null);
  const isOff = usePageState(areMovesOff);
  return (
    <div className="hand-moves">
      {hasJob && <p className="note">{words.heldOff}</p>}
      <JogPad isOff={isOff} move={moveByHand} />
      <MoveTo isOff={isOff} />
      <Moves />
      <NudgeSettings isOff={isOff} />
    </div>
  );
};

const MoveTo = ({ isOff }: { isOff: boolean }) => {
  const { moveByHand } = useActions();
  const [[xMm, yMm], setPlace] = useState<readonly [number, number]>([0, 0]);
  return (
    <form
      className="move-to"
      onSubmit={(event) => {
        event.preventDefault();
        void moveByHand({ kind: "move-to", xMm, yMm });
      }}
    >
      <MmPair
        labels={[words.moveToX, words.moveToY]}
        values={[xMm, yMm]}
        min={0}
        step={1}
        onChange={(x, y) => setPlace([x, y])}
      />
      <Button type="submit" disabled={isOff}>
        {words.moveTo}
      </Button>
    </form>
  );
};

const Moves = () => (
  <div className="button-grid">
    <ActionButton action={SET_HOME} hint={words.setHomeHint} />
    <ActionButton action={START_HERE} hint={previewText.startHereHint} />
    <ActionButton action={CYCLE_PEN} hint={words.cyclePenHint} />
    <ActionButton action={TEST_PATCH} hint={words.testPatchHint} />
  </div>
);
