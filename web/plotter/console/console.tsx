import { useEffect, useRef, useState, type FormEvent, type KeyboardEvent } from "react";
import { controllerOf, machineOf } from "../../../src/internal.js";
import { activeJob, currentPlotter } from "../../state/store.js";
import { useBackend, usePageState, usePageStore } from "../../state/use-store.js";
import { Button } from "../../ui/button.js";
import { Sheet } from "../../ui/dialog.js";
import { consoleText as words } from "../machines/text.js";
import "./console.css";

const MAX_LINES = 500;

interface Line {
  readonly id: number;
  readonly kind: "sent" | "reply" | "note" | "error";
  readonly text: string;
}

/** Sends commands to the board and shows its replies. Disabled during a plot. */
export const Console = () => {
  const hasJob = usePageState((state) => activeJob(state) !== null);
  const name = usePageState((state) => currentPlotter(state)?.name ?? "");
  const examples = usePageState(({ settings }) => controllerOf(machineOf(settings)).consoleExamples);
  const { lines, send } = useConversation();
  const end = useRef<HTMLDivElement>(null);
  useEffect(() => {
    // `void`, because newer browsers return a promise, which React would take for a clean-up function.
    void end.current?.scrollIntoView({ block: "end" });
  }, [lines]);
  return (
    <Sheet title={words.title(name)}>
      <div className="console" role="log" aria-label={words.log} tabIndex={0}>
        {lines.map(({ id, kind, text: content }) => (
          <p key={id} data-kind={kind}>
            {content}
          </p>
        ))}
        <div ref={end} aria-hidden="true" />
      </div>
      {hasJob ? <p className="note">{words.refused}</p> : <CommandLine example={examples[0]} onSend={send} />}
      <p className="note">{words.hint(examples.join(", "))}</p>
    </Sheet>
  );
};

const useConversation = () => {
  const backend = useBackend();
  const store = usePageStore();
  const [lines, setLines] = useState<readonly Line[]>([]);
  const nextId = useRef(0);
  const add = (kind: Line["kind"], contents: readonly string[]): void => {
    const added = contents.map((content) => ({ id: nextId.current++, kind, text: content }));
    setLines((before) => [...before, ...added].slice(-MAX_LINES));
  };
  const send = async (line: string): Promise<void> => {
    add("sent", [line]);
    try {
      const { replies, note } = await backend.console.command(currentPlotter(store.getState())?.id ?? "", {
        line,
      });
      add("reply", replies.length > 0 ? replies : [words.noReply]);
      if (note !== null) add("note", [note]);
    } catch (error) {
      add("error", [error instanceof Error ? error.message : String(error)]);
    }
  };
  return { lines, send };
};

interface CommandLineProps {
  readonly example: string;
  onSend(line: string): Promise<void>;
}

const CommandLine = ({ example, onSend }: CommandLineProps) => {
  const [line, setLine] = useState("");
  const [past, setPast] = useState<readonly string[]>([]);
  /** How far back in `past` the shown line is; 0: it is being typed. */
  const [backCount, setBackCount] = useState(0);
  const submit = (event: FormEvent): void => {
    event.preventDefault();
    const wanted = line.trim();
    if (wanted === "") return;
    setPast([...past.filter((one) => one !== wanted), wanted].slice(-50));
    setLine("");
    setBackCount(0);
    void onSend(wanted);
  };
  const onKeyDown = (event: KeyboardEvent): void => {
    const step = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
    if (step === 0) return;
    event.preventDefault();
    const next = Math.min(past.length, Math.max(0, backCount + step));
    setBackCount(next);
    setLine(next === 0 ? "" : (past[past.length - next] ?? ""));
  };
  return (
    <form className="field-with-button" onSubmit={submit}>
      <input
        className="text-field console-line"
        type="text"
        maxLength={255}
        autoFocus
        autoComplete="off"
        autoCapitalize="characters"
        spellCheck="false"
        aria-label={words.command}
        placeholder={example}
        value={line}
        onChange={(event) => setLine(event.target.value)}
        onKeyDown={onKeyDown}
      />
      <Button type="submit">{words.send}</Button>
    </form>
  );
};
