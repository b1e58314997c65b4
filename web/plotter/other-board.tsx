import { MACHINES } from "../../src/index.js";
import type { Plotter } from "../../src/schema/index.js";
import { useActions, usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { findText as words } from "./find-text.js";
import "./other-board.css";

/** The models that fit the board that answers. One click chooses one, and the plotter connects. */
export const OtherBoard = ({
  board: { answer, controller },
}: {
  board: NonNullable<Plotter["otherBoard"]>;
}) => {
  const { chooseMachine } = useActions();
  const made = usePageState(({ machines }) => machines);
  const own = made.filter(({ builtIn }) => !builtIn);
  const fitting = [...own, ...MACHINES].filter((machine) => machine.controller.kind === controller);
  return (
    <div className="other-board" role="group" aria-label={words.whichModel(answer)}>
      {fitting.map((machine) => (
        <Button key={machine.id} kind="small" onClick={() => chooseMachine(machine)}>
          {machine.name}
        </Button>
      ))}
    </div>
  );
};
