import { useMemo, useState } from "react";
import type { HandMove } from "../../src/schema/index.js";
import { activeJob, currentPlotter } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { movesText as words } from "./hand-text.js";
import { Button } from "../ui/button.js";
import { MmPair } from "../ui/mm-pair.js";
import { NudgeSettings } from "./pen-nudge.js";
import { JogPad } from "./jog-pad.js";
import { boxOfDrawn } from "./drawn-box.js";
import "./hand-moves.css";

/** Jog pad, moves to a position, and small moves that prepare a plot. Disabled during a plot. */
export const HandMoves = () => {
  const { moveByHand } = useActions();
  const hasJob = usePageState((state) => activeJob(state) !== null);
  const connection = usePageState((state) => currentPlotter(state)?.connection ?? "absent");
  const isOff = hasJob || (connection !== "idle" && connection !== "busy");
  return (
    <div className="hand-moves">
      {hasJob && <p className="note">{words.heldOff}</p>}
      <JogPad isOff={isOff} move={moveByHand} />
      <Walk isOff={isOff} />
      <Moves isOff={isOff} />
      <NudgeSettings isOff={isOff} />
    </div>
  );
};

const Walk = ({ isOff }: { isOff: boolean }) => {
  const { moveByHand } = useActions();
  const [[xMm, yMm], setPlace] = useState<readonly [number, number]>([0, 0]);
  return (
    <form
      className="walk"
      onSubmit={(event) => {
        event.preventDefault();
        void moveByHand({ kind: "walk", xMm, yMm });
      }}
    >
      <MmPair
        labels={[words.walkX, words.walkY]}
        values={[xMm, yMm]}
        min={0}
        step={1}
        onChange={(x, y) => setPlace([x, y])}
      />
      <Button type="submit" disabled={isOff}>
        {words.walk}
      </Button>
    </form>
  );
};

const Moves = ({ isOff }: { isOff: boolean }) => {
  const { moveByHand } = useActions();
  const trajectory = usePageState((state) => state.planned?.trajectory ?? null);
  const boxMm = useMemo(() => trajectory && boxOfDrawn(trajectory), [trajectory]);
  const moves: readonly (readonly [label: string, hint: string, move: HandMove | null])[] = [
    [words.setHome, words.setHomeHint, { kind: "set-home" }],
    [words.cyclePen, words.cyclePenHint, { kind: "cycle-pen" }],
    [words.frame, words.frameHint, boxMm && { kind: "frame", boxMm }],
    [words.testPatch, words.testPatchHint, { kind: "test-patch" }],
  ];
  return (
    <div className="button-grid">
      {moves.map(([label, hint, move]) => (
        <Button
          key={label}
          title={hint}
          disabled={isOff || move === null}
          onClick={() => move && void moveByHand(move)}
        >
          {label}
        </Button>
      ))}
    </div>
  );
};
