import { useState } from "react";
import type { MachineProfile } from "../../src/index.js";
import { useActions, usePageState } from "../state/use-store.js";
import { wizardText as words } from "./wizard-text.js";
import { Button } from "../ui/button.js";
import { saveFile } from "../ui/save-file.js";
import { TextField } from "../ui/text-field.js";
import { fileOf, freeId, problemsOf } from "./profile.js";
import { ReachFields } from "./profile-form.js";
import type { StepProps } from "./wizard-step.js";

/** Asks for reach and name, then saves the machine and chooses it. */
export const NameStep = ({ profile, onNext }: StepProps) => {
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
