import { useState } from "react";
import { MACHINES } from "../../src/index.js";
import { plotterWords } from "./machine-words.js";
import { activeJob, currentPlotter } from "../state/store.js";
import { useActions, usePageState, usePageStore } from "../state/use-store.js";
import { PortSelect } from "../studio/port-select.js";
import { wizardText as words } from "./wizard-text.js";
import { Button } from "../ui/button.js";
import { Select } from "../ui/choice.js";
import type { StepProps } from "./wizard-step.js";

/** Asks for the plotter, its port, and the built-in machine that is most like it. */
export const PlotterStep = ({ profile, onNext }: StepProps) => {
  const store = usePageStore();
  const plotters = usePageState((state) => state.plotters);
  const plotter = usePageState(currentPlotter);
  const job = usePageState(activeJob);
  const { choosePlotter } = useActions();
  const [like, setLike] = useState<string>(
    () => MACHINES.find(({ id }) => id === store.getState().settings.machine)?.id ?? MACHINES[0].id,
  );
  const base = MACHINES.find(({ id }) => id === like) ?? profile;
  const isReady = plotter?.connection === "idle";
  return (
    <>
      <p>{words.plotterHint}</p>
      {plotters.length > 1 && plotter && (
        <Select
          label={words.plotter}
          value={plotter.id}
          options={plotters.map(({ id, name }) => ({ value: id, label: name }))}
          onChange={choosePlotter}
        />
      )}
      {plotter && <PortSelect plotter={plotter} />}
      <p className={isReady ? "note" : "note note-error"} role="status">
        {plotter ? `${plotter.name}: ${plotterWords(plotter, job)}. ` : ""}
        {plotter?.message}
      </p>
      <Select
        label={words.like}
        value={like}
        options={MACHINES.map(({ id, name }) => ({ value: id, label: name }))}
        onChange={setLike}
      />
      <p className="note">{words.likeHint}</p>
      <Button
        kind="primary"
        disabled={!isReady}
        onClick={() => onNext({ ...base, id: profile.id, name: profile.name })}
      >
        {words.next}
      </Button>
    </>
  );
};
