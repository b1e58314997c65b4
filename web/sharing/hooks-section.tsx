import { useState } from "react";
import { WEBHOOK_EVENTS, type Webhook, type WebhookEvent } from "../../src/schema/index.js";
import { sharingText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { formatWhen } from "../ui/format.js";
import { TextField } from "../ui/fields/text-field.js";
import { Secret } from "./access-section.js";
import { useFetched, useSharing } from "./use-sharing.js";

/** Addresses that are notified of plots. */
export const HooksSection = () => {
  const sharing = useSharing();
  const [answer, askAgain] = useFetched(sharing.webhooks.list);
  const [secret, setSecret] = useState<string | null>(null);
  const remove = async (id: string): Promise<void> => {
    if (await sharing.webhooks.remove(id)) askAgain();
  };
  return (
    <>
      <p className="note">{words.hooksHint}</p>
      <ul className="sharing-list">
        {(answer?.webhooks ?? []).map((hook) => (
          <HookRow key={hook.id} hook={hook} onRemove={() => void remove(hook.id)} />
        ))}
        {answer?.webhooks.length === 0 && <li className="note">{words.noHooks}</li>}
      </ul>
      {secret !== null && <Secret label={words.hookSecretOnce} value={secret} />}
      <NewHookForm
        onAdded={(made) => {
          setSecret(made);
          askAgain();
        }}
      />
    </>
  );
};

const HookRow = ({ hook, onRemove }: { hook: Webhook; onRemove(): void }) => (
  <li>
    <span>
      <strong>{hook.name}</strong>
      <span className="note">
        {hook.url}: {hook.events.map((event) => words.events[event]).join(", ")}
      </span>
      {hook.last && (
        <span className={hook.last.isDelivered ? "note" : "note note-error"}>
          {formatWhen(hook.last.at)}: {hook.last.message}
        </span>
      )}
      {hook.pendingCount > 0 && <span className="note">{words.pending(hook.pendingCount)}</span>}
    </span>
    <Button kind="small" aria-label={words.removeHookNamed(hook.name)} onClick={onRemove}>
      {words.removePlotter}
    </Button>
  </li>
);

const CHOSEN_AT_FIRST: readonly WebhookEvent[] = ["waiting", "done", "failed"];

const NewHookForm = ({ onAdded }: { onAdded(secret: string): void }) => {
  const sharing = useSharing();
  const [name, setName] = useState("");
  const [url, setUrl] = useState("");
  const [events, setEvents] = useState<readonly WebhookEvent[]>(CHOSEN_AT_FIRST);
  const isWhole = name.trim() !== "" && /^https?:\/\/./.test(url.trim()) && events.length > 0;
  const add = async (): Promise<void> => {
    const made = await sharing.webhooks.add({ name: name.trim(), url: url.trim(), events: [...events] });
    if (!made) return;
    setName("");
    setUrl("");
    onAdded(made.secret);
  };
  return (
    <form
      className="sharing-form"
      onSubmit={(event) => {
        event.preventDefault();
        if (isWhole) void add();
      }}
    >
      <h3>{words.newHook}</h3>
      <TextField label={words.hookName} isLabelInside value={name} onChange={setName} />
      <input
        className="text-field"
        type="url"
        maxLength={2_000}
        aria-label={words.hookUrl}
        placeholder="https://"
        value={url}
        onChange={(event) => setUrl(event.target.value)}
      />
      <fieldset className="check-row">
        <legend className="visually-hidden">{words.when}</legend>
        {WEBHOOK_EVENTS.map((name) => (
          <label key={name}>
            <input
              type="checkbox"
              checked={events.includes(name)}
              onChange={({ target }) =>
                setEvents(target.checked ? [...events, name] : events.filter((other) => other !== name))
              }
            />
            {words.events[name]}
          </label>
        ))}
      </fieldset>
      <Button type="submit" disabled={!isWhole}>
        {words.addHook}
      </Button>
    </form>
  );
};
