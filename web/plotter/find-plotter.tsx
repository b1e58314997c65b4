import { useState } from "react";
import type { AskedDevice, Plotter } from "../../src/schema/index.js";
import { useSharing } from "../sharing/use-sharing.js";
import { Button } from "../ui/button.js";
import { findText as words } from "./find-text.js";
import "./find-plotter.css";

/** Asks what is on the ports of the server's computer, and lets the user take one. */
export const FindPlotter = ({ plotter }: { plotter: Plotter }) => {
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
