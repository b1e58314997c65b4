import { useState } from "react";
import { MACHINES } from "../../src/index.js";
import type { AskedDevice, Plotter } from "../../src/schema/index.js";
import { useSharing } from "../sharing/use-sharing.js";
import { useActions, useBackend, usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { findText as words } from "./find-text.js";
import "./find-plotter.css";

/** What was found in place of the plotter, and what can be found. */
export const FindPlotter = ({ plotter }: { plotter: Plotter }) => {
  const { features } = useBackend();
  return (
    <>
      {plotter.otherBoard && <OtherBoard board={plotter.otherBoard} />}
      {features.sharing && <Ports plotter={plotter} />}
    </>
  );
};

/** Asks what is on the ports of the server's computer, and lets the user take one. */
const Ports = ({ plotter }: { plotter: Plotter }) => {
  const sharing = useSharing();
  const [isAsking, setAsking] = useState(false);
  /** Null: nothing was asked yet. */
  const [found, setFound] = useState<readonly AskedDevice[] | null>(null);
  const ask = async (): Promise<void> => {
    setAsking(true);
    setFound((await sharing.plotters.ask())?.devices ?? null);
    setAsking(false);
  };
  const free = found?.filter(({ inUseBy }) => inUseBy === null || inUseBy === plotter.id);
  return (
    <div className="find-plotter">
      <Button kind="link" disabled={isAsking} onClick={() => void ask()}>
        {isAsking ? words.asking : words.find}
      </Button>
      <div role="status">
        {free?.length === 0 && <p className="note">{words.nothing}</p>}
        {free && free.length > 0 && (
          <ul aria-label={words.ports}>
            {free.map(({ path, answer, fault }) => (
              <li key={path}>
                <strong>{answer ?? words.noAnswer}</strong>
                <span className="note">{fault ?? path}</span>
                {answer !== null && (
                  <Button
                    kind="small"
                    aria-label={words.useNamed(answer, path)}
                    onClick={() => void sharing.plotters.patch(plotter.id, { device: path })}
                  >
                    {words.use}
                  </Button>
                )}
              </li>
            ))}
          </ul>
        )}
      </div>
    </div>
  );
};

/** The models that fit the board that answers. One click chooses one, and the plotter connects. */
const OtherBoard = ({ board: { answer, controller } }: { board: NonNullable<Plotter["otherBoard"]> }) => {
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
