import { useEffect, useId, useMemo, useRef, useState, type KeyboardEvent } from "react";
import { bestMatches, type Searched } from "../../src/internal.js";
import { isOffered, labelOf, whyOff, type Page, type PageAction } from "../state/page-action.js";
import { maySubmit } from "../state/store.js";
import { usePage, usePageState } from "../state/use-store.js";
import { Dialog } from "../ui/dialog.js";
import { Icon } from "../ui/icon.js";
import { fieldsFor } from "./fields.js";
import { goToField } from "./focus-field.js";
import { DRAW } from "../watch/draw-action.js";
import { searchText as words } from "./text.js";
import "./search.css";

interface Entry extends Searched {
  readonly id: string;
  readonly key?: string | undefined;
  /** Why it can't be chosen now; null: it can. */
  readonly whyOff: string | null;
  choose(page: Page): void;
}

const actionEntries = (actions: readonly PageAction[], page: Page): readonly Entry[] => {
  const state = page.store.getState();
  return actions
    .filter((action) => action.id !== "search" && isOffered(action, page))
    .map((action) => ({
      id: action.id,
      label: labelOf(action, state),
      words: action.words ?? "",
      where: words.action,
      key: action.key,
      whyOff: whyOff(action, state),
      choose: (to) => {
        if (action.isForDrawing) to.actions.showView("prepare");
        action.perform(to);
      },
    }));
};

/** A watcher has no settings. */
const fieldEntries = (page: Page): readonly Entry[] => {
  const state = page.store.getState();
  if (!maySubmit(state)) return [];
  return fieldsFor(state).map((field) => {
    const { panel, legend, control } = field.place;
    const titles = control === null ? panel.titles.slice(0, -1) : panel.titles;
    return {
      id: field.id,
      label: field.label,
      words: field.words,
      where: [...titles, ...(legend ? [legend] : [])].join(" › ") || words.panel,
      whyOff: field.whyOff?.(state) ?? null,
      choose: (to) => goToField(to, field),
    };
  });
};

/** Finds actions, settings and panels by name, and by other words for them. */
export const Search = ({ actions }: { actions: readonly PageAction[] }) => {
  const page = usePage();
  const state = usePageState((whole) => whole);
  const [typed, setTyped] = useState("");
  const [chosen, setChosen] = useState(0);
  const id = useId();
  const found = useMemo(
    () => bestMatches(typed, [...actionEntries([...actions, DRAW], page), ...fieldEntries(page)]),
    // The entries depend on the whole state.
    // eslint-disable-next-line react-hooks/exhaustive-deps
    [typed, actions, page, state],
  );
  const at = Math.min(chosen, found.length - 1);

  const choose = (entry: Entry | undefined, from: HTMLElement): void => {
    if (!entry || entry.whyOff !== null) return;
    // Gives the focus back now, so that it can move on to the field.
    from.closest("dialog")?.close();
    page.actions.closeDialog();
    entry.choose(page);
  };
  const onKeyDown = (event: KeyboardEvent<HTMLInputElement>): void => {
    if (event.nativeEvent.isComposing) return;
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step !== undefined && found.length > 0) setChosen((at + step + found.length) % found.length);
    else if (event.key === "Enter") choose(found[at], event.currentTarget);
    else return;
    event.preventDefault();
  };

  return (
    <Dialog title={words.title} className="search" isBare onClose={page.actions.closeDialog}>
      <div className="search-field">
        <Icon name="search" />
        <input
          type="text"
          role="combobox"
          autoFocus
          autoComplete="off"
          spellCheck="false"
          aria-label={words.title}
          aria-expanded={found.length > 0}
          aria-controls={`${id}-list`}
          aria-autocomplete="list"
          aria-activedescendant={found.length > 0 ? `${id}-${at}` : undefined}
          placeholder={words.placeholder}
          value={typed}
          onChange={(event) => {
            setTyped(event.target.value);
            setChosen(0);
          }}
          onKeyDown={onKeyDown}
        />
      </div>
      <ul id={`${id}-list`} className="search-list" role="listbox" aria-label={words.results}>
        {found.map((entry, index) => (
          <Option
            key={entry.id}
            id={`${id}-${index}`}
            entry={entry}
            isChosen={index === at}
            onPoint={() => setChosen(index)}
            onChoose={(from) => choose(entry, from)}
          />
        ))}
      </ul>
      <p className={found.length === 0 ? "note" : "visually-hidden"} role="status">
        {found.length === 0 ? words.none(typed) : words.found(found.length)}
      </p>
      <p className="note search-hint">{words.hint}</p>
    </Dialog>
  );
};

interface OptionProps {
  readonly id: string;
  readonly entry: Entry;
  readonly isChosen: boolean;
  onPoint(): void;
  onChoose(from: HTMLElement): void;
}

const Option = ({ id, entry, isChosen, onPoint, onChoose }: OptionProps) => {
  const option = useRef<HTMLLIElement>(null);
  useEffect(() => {
    if (isChosen) option.current?.scrollIntoView({ block: "nearest" });
  }, [isChosen]);
  return (
    // The focus stays in the text field, which handles the keys.
    <li
      ref={option}
      id={id}
      role="option"
      aria-selected={isChosen}
      aria-disabled={entry.whyOff !== null}
      onPointerMove={() => {
        if (!isChosen) onPoint();
      }}
      onPointerDown={(event) => event.preventDefault()}
      onClick={(event) => onChoose(event.currentTarget)}
    >
      <span className="search-name">{entry.label}</span>
      <span className="search-where">{entry.whyOff ?? entry.where}</span>
      {entry.key !== undefined && <kbd>{entry.key}</kbd>}
    </li>
  );
};
