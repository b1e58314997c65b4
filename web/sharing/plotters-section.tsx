import { useState } from "react";
import { ENDED_STATES, type Plotter } from "../../src/schema/index.js";
import { usePageState } from "../state/use-store.js";
import { sharingText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { Select } from "../ui/fields/choice.js";
import { TextField } from "../ui/fields/text-field.js";
import { PortSelect, portChoices } from "./port-select.js";
import { useFetched, useSharing } from "./use-sharing.js";

/** The server's plotters: their names and ports, adding and removing them. */
export const PlottersSection = () => {
  const plotters = usePageState((state) => state.plotters);
  return (
    <>
      <ul className="sharing-list">
        {plotters.map((plotter) => (
          <PlotterRow key={plotter.id} plotter={plotter} isLast={plotters.length === 1} />
        ))}
      </ul>
      <NewPlotterForm />
    </>
  );
};

const PlotterRow = ({ plotter, isLast }: { plotter: Plotter; isLast: boolean }) => {
  const sharing = useSharing();
  /** The name while it is being typed. */
  const [typed, setTyped] = useState<string | null>(null);
  const jobs = usePageState((state) => state.jobs);
  const isInUse = jobs.some((job) => job.plotterId === plotter.id && !ENDED_STATES.includes(job.state));
  const rename = (): void => {
    const wanted = typed?.trim() ?? "";
    setTyped(null);
    if (wanted !== "" && wanted !== plotter.name) void sharing.plotters.patch(plotter.id, { name: wanted });
  };
  return (
    <li className="plotter-row">
      <input
        className="text-field"
        type="text"
        maxLength={100}
        aria-label={words.plotterName(plotter.name)}
        value={typed ?? plotter.name}
        onChange={(event) => setTyped(event.target.value)}
        onBlur={rename}
        onKeyDown={(event) => {
          // Leaving the field renames the plotter.
          if (event.key === "Enter") event.currentTarget.blur();
        }}
      />
      <PortSelect plotter={plotter} />
      {plotter.boardName !== null && <span className="note">{words.boardName(plotter.boardName)}</span>}
      <Button
        kind="small"
        aria-label={words.removePlotterNamed(plotter.name)}
        title={isInUse ? words.inUse : undefined}
        disabled={isLast || isInUse}
        onClick={() => void sharing.plotters.remove(plotter.id)}
      >
        {words.removePlotter}
      </Button>
    </li>
  );
};

const NewPlotterForm = () => {
  const sharing = useSharing();
  const machine = usePageState((state) => state.settings.machine);
  const [answer, askAgain] = useFetched(sharing.plotters.devices);
  const [name, setName] = useState("");
  const [device, setDevice] = useState("auto");
  const add = async (): Promise<void> => {
    if (!(await sharing.plotters.add({ name: name.trim(), device, machine }))) return;
    setName("");
    setDevice("auto");
    askAgain();
  };
  return (
    <form
      className="sharing-form"
      onSubmit={(event) => {
        event.preventDefault();
        if (name.trim() !== "") void add();
      }}
    >
      <h3>{words.newPlotter}</h3>
      <TextField label={words.newPlotterName} isLabelInside value={name} onChange={setName} />
      <Select
        label={words.port}
        value={device}
        options={portChoices(answer?.devices ?? [], null)}
        onChange={setDevice}
      />
      <Button type="submit" disabled={name.trim() === ""}>
        {words.addPlotter}
      </Button>
    </form>
  );
};
