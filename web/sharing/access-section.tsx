import { useState } from "react";
import type { AccessEntry, Role } from "../../src/schema/index.js";
import { sharingText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { Select } from "../ui/fields/choice.js";
import { formatWhen } from "../ui/format.js";
import { TextField } from "../ui/fields/text-field.js";
import { useFetched, useSharing } from "./use-sharing.js";

/** Paired browsers, and keys for scripts. Each can be revoked. */
export const AccessSection = () => {
  const sharing = useSharing();
  const [answer, askAgain] = useFetched(sharing.access.list);
  const [secret, setSecret] = useState<string | null>(null);
  const revoke = async (id: string): Promise<void> => {
    if (await sharing.access.revoke(id)) askAgain();
  };
  const add = async (name: string, role: Role): Promise<void> => {
    const made = await sharing.access.addKey({ name, role });
    if (!made) return;
    setSecret(made.secret);
    askAgain();
  };
  return (
    <>
      <p className="note">{words.accessHint}</p>
      <ul className="sharing-list">
        {(answer?.entries ?? []).map((entry) => (
          <EntryRow key={entry.id} entry={entry} onRevoke={() => void revoke(entry.id)} />
        ))}
        {answer?.entries.length === 0 && <li className="note">{words.none}</li>}
      </ul>
      {secret !== null && <Secret label={words.keyOnce} value={secret} />}
      <NewKeyForm onAdd={add} />
    </>
  );
};

const EntryRow = ({ entry, onRevoke }: { entry: AccessEntry; onRevoke(): void }) => (
  <li>
    <span>
      <strong>{entry.name}</strong>
      <span className="note">
        {words.kinds[entry.kind]}, {words.roles[entry.role]}, {words.seen(formatWhen(entry.lastSeenAt))}
      </span>
    </span>
    <Button kind="small" aria-label={words.revokeNamed(entry.name)} onClick={onRevoke}>
      {words.revoke}
    </Button>
  </li>
);

/** Shown only once: the server stores no more than it needs to check the secret. */
export const Secret = ({ label, value }: { label: string; value: string }) => (
  <p className="secret" role="status">
    <span>{label}</span>
    <code>{value}</code>
  </p>
);

const NewKeyForm = ({ onAdd }: { onAdd(name: string, role: Role): Promise<void> }) => {
  const [name, setName] = useState("");
  const [role, setRole] = useState<Role>("operate");
  return (
    <form
      className="sharing-form"
      onSubmit={(event) => {
        event.preventDefault();
        if (name.trim() === "") return;
        void onAdd(name.trim(), role);
        setName("");
      }}
    >
      <h3>{words.newKey}</h3>
      <TextField label={words.keyName} isLabelInside value={name} onChange={setName} />
      <Select<Role>
        label={words.may}
        value={role}
        options={[
          { value: "operate", label: words.roles.operate },
          { value: "submit", label: words.roles.submit },
          { value: "watch", label: words.roles.watch },
        ]}
        onChange={setRole}
      />
      <Button type="submit" disabled={name.trim() === ""}>
        {words.makeKey}
      </Button>
    </form>
  );
};
