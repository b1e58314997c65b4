import { MACHINES } from "../../src/index.js";
import { Select } from "../ui/fields/choice.js";
import { useActions, usePageState } from "../state/use-store.js";

interface ModelSelectProps {
  readonly label: string;
  /** Shown instead of the current model, which nobody has chosen yet. */
  readonly unchosen?: string;
  onChoose?(): void;
}

/** Chooses among the built-in and the custom machines. */
export const ModelSelect = ({ label, unchosen, onChoose }: ModelSelectProps) => {
  const settings = usePageState((state) => state.settings);
  const made = usePageState((state) => state.machines);
  const { chooseMachine } = useActions();
  const { machine, customMachine } = settings;
  const known = [...MACHINES, ...made.filter(({ builtIn }) => !builtIn)];
  const all = known.some(({ id }) => id === machine) || !customMachine ? known : [...known, customMachine];
  const options = all.map(({ id, name }) => ({ value: id, label: name }));
  return (
    <Select
      label={label}
      value={unchosen === undefined ? machine : ""}
      options={unchosen === undefined ? options : [{ value: "", label: unchosen, isOff: true }, ...options]}
      onChange={(id) => {
        chooseMachine(all.find((one) => one.id === id) ?? null);
        onChoose?.();
      }}
    />
  );
};
