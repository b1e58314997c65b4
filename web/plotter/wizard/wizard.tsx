import { useState } from "react";
import { MACHINES, type MachineProfile } from "../../../src/index.js";
import { findMachine, freeId } from "../../../src/internal.js";
import { Button } from "../../ui/button.js";
import { Sheet } from "../../ui/dialog.js";
import { useActions, usePageState, usePageStore } from "../../state/use-store.js";
import { wizardText as words } from "./text.js";
import { copyOf, fileOf, problemsOf } from "../machines/profile.js";
import { DirectionStep } from "./wizard-direction.js";
import { ServoStep } from "./wizard-servo.js";
import { SquareStep } from "./wizard-square.js";
import { saveFile } from "../../ui/files/save-file.js";
import { TextField } from "../../ui/fields/text-field.js";
import { ReachFields } from "../machines/profile-form.js";
import type { StepProps } from "./wizard-step.js";
import { plotterWords } from "../machine-words.js";
import { activeJob, currentPlotter } from "../../state/store.js";
import { PortSelect } from "../../sharing/port-select.js";
import { Select } from "../../ui/fields/choice.js";
import "../machines/machines.css";

/** Asks for reach and name, then saves the machine and chooses it. */
const NameStep = ({ profile, onNext }: StepProps) => {
  const made = usePageState((state) => state.machines);
  const { saveMachine } = useActions();
  const [draft, setDraft] = useState(profile);
  const named: MachineProfile = { ...draft, id: freeId(draft.name, made) };
  const problems = problemsOf(named);
  const save = async (): Promise<void> => {
    const saved = await saveMachine(named);
    if (saved) onNext(saved);
  };
  return (
    <form
      className="wizard-step"
      onSubmit={(event) => {
        event.preventDefault();
        void save();
      }}
    >
      <TextField label={words.name} value={draft.name} onChange={(name) => setDraft({ ...draft, name })} />
      <ReachFields profile={draft} onChange={setDraft} />
      <p className="note">{words.reachHint}</p>
      {problems.length > 0 && (
        <p className="note note-error" role="alert">
          {problems.join("; ")}
        </p>
      )}
      <div className="button-row">
        <Button type="submit" kind="primary" disabled={problems.length > 0}>
          {words.save}
        </Button>
        <Button
          disabled={problems.length > 0}
          onClick={() => saveFile(`${named.id}.json`, fileOf(named), "application/json")}
        >
          {words.saveFile}
        </Button>
      </div>
    </form>
  );
};

/** Asks for the plotter, its port, and the built-in machine that is most like it. */
const PlotterStep = ({ profile, onNext }: StepProps) => {
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

const STEPS = [PlotterStep, DirectionStep, SquareStep, ServoStep, NameStep] as const;

/** Makes a profile for an unknown plotter from what the user sees it do. */
export const Wizard = () => {
  const store = usePageStore();
  const { closeDialog } = useActions();
  const made = usePageState((state) => state.machines);
  const [index, setIndex] = useState(0);
  const [profile, setProfile] = useState<MachineProfile>(() =>
    copyOf(findMachine(store.getState().settings) ?? MACHINES[0], words.firstName, made),
  );
  const Step = STEPS[index];
  const onNext = (next: MachineProfile): void => {
    setProfile(next);
    if (index === STEPS.length - 1) closeDialog();
    else setIndex(index + 1);
  };
  return (
    <Sheet title={words.title}>
      <ol className="wizard-steps" aria-label={words.steps}>
        {words.stepNames.map((name, at) => (
          <li key={name} aria-current={at === index ? "step" : undefined} data-done={at < index || undefined}>
            {name}
          </li>
        ))}
      </ol>
      <div className="wizard-step">
        <Step key={index} profile={profile} onNext={onNext} />
      </div>
      {index > 0 && (
        <Button kind="link" onClick={() => setIndex(index - 1)}>
          {words.back}
        </Button>
      )}
    </Sheet>
  );
};
