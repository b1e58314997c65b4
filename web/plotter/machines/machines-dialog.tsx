import { useState } from "react";
import { MACHINES, type MachineProfile } from "../../../src/index.js";
import { freeId } from "../../../src/internal.js";
import { useActions, usePageState } from "../../state/use-store.js";
import { Button } from "../../ui/button.js";
import { ChooseFile } from "../../ui/files/choose-file.js";
import { Sheet } from "../../ui/dialog.js";
import { machinesText as words } from "./text.js";
import { saveFile } from "../../ui/files/save-file.js";
import { copyOf, fileOf, parseMachineFile, problemsOf } from "./profile.js";
import { ProfileForm } from "./profile-form.js";
import "./machines.css";

/** Built-in and custom machines. A custom one is made from a copy or loaded from a file; it can be edited and saved. */
export const MachinesDialog = () => {
  const [edited, setEdited] = useState<MachineProfile | null>(null);
  return (
    <Sheet title={words.title}>
      {edited ? (
        <Editor key={edited.id} first={edited} onDone={() => setEdited(null)} />
      ) : (
        <MachineList onEdit={setEdited} />
      )}
    </Sheet>
  );
};

const MachineList = ({ onEdit }: { onEdit(profile: MachineProfile): void }) => {
  const chosen = usePageState((state) => state.settings.machine);
  const made = usePageState((state) => state.machines).filter(({ builtIn }) => !builtIn);
  const { chooseMachine, removeMachine } = useActions();
  return (
    <>
      <ul className="machine-list">
        {[...MACHINES, ...made].map((machine) => (
          <li key={machine.id} data-chosen={machine.id === chosen || undefined}>
            <button
              type="button"
              className="machine-name"
              aria-pressed={machine.id === chosen}
              onClick={() => chooseMachine(machine)}
            >
              <strong>{machine.name}</strong>
              <span className="note">{words.size(machine.widthMm, machine.heightMm)}</span>
            </button>
            <RowButtons
              machine={machine}
              isOwn={made.some(({ id }) => id === machine.id)}
              onEdit={() => onEdit(machine)}
              onCopy={() => onEdit(copyOf(machine, words.copyName(machine.name), made))}
              onRemove={() => void removeMachine(machine)}
            />
          </li>
        ))}
      </ul>
      <ImportButton onRead={(profile) => onEdit({ ...profile, id: idOf(profile, made) })} />
    </>
  );
};

/** A file's own id if it is free, or if it belongs to a custom machine, which the file then replaces. */
const idOf = ({ id, name }: MachineProfile, made: readonly MachineProfile[]): string =>
  MACHINES.some((machine) => machine.id === id) ? freeId(name, made) : id;

interface RowButtonsProps {
  readonly machine: MachineProfile;
  readonly isOwn: boolean;
  onEdit(): void;
  onCopy(): void;
  onRemove(): void;
}

const RowButtons = ({ machine, isOwn, onEdit, onCopy, onRemove }: RowButtonsProps) => (
  <span className="row-links">
    {isOwn && (
      <Button kind="link" aria-label={words.editNamed(machine.name)} onClick={onEdit}>
        {words.edit}
      </Button>
    )}
    <Button kind="link" aria-label={words.copyNamed(machine.name)} onClick={onCopy}>
      {words.copy}
    </Button>
    <Button
      kind="link"
      aria-label={words.saveNamed(machine.name)}
      onClick={() => saveFile(`${machine.id}.json`, fileOf(machine), "application/json")}
    >
      {words.save}
    </Button>
    {isOwn && (
      <Button kind="link" aria-label={words.removeNamed(machine.name)} onClick={onRemove}>
        {words.remove}
      </Button>
    )}
  </span>
);

const ImportButton = ({ onRead }: { onRead(profile: MachineProfile): void }) => {
  const { notify } = useActions();
  const read = async (file: File): Promise<void> => {
    try {
      onRead(parseMachineFile(await file.text()));
    } catch (error) {
      notify("error", words.badFile(file.name, error instanceof Error ? error.message : String(error)));
    }
  };
  return (
    <ChooseFile label={words.import} accept=".json,application/json" onFiles={([file]) => void read(file)} />
  );
};

const Editor = ({ first, onDone }: { first: MachineProfile; onDone(): void }) => {
  const [profile, setProfile] = useState(first);
  const { saveMachine } = useActions();
  const problems = problemsOf(profile);
  const save = async (): Promise<void> => {
    if (await saveMachine(profile)) onDone();
  };
  return (
    <>
      <ProfileForm profile={profile} onChange={setProfile} />
      {problems.length > 0 && (
        <ul className="note note-error" role="alert">
          {problems.map((problem) => (
            <li key={problem}>{problem}</li>
          ))}
        </ul>
      )}
      <div className="button-row dialog-foot">
        <Button kind="primary" disabled={problems.length > 0} onClick={() => void save()}>
          {words.saveMachine}
        </Button>
        <Button onClick={onDone}>{words.back}</Button>
      </div>
    </>
  );
};
