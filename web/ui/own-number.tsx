import { useId, useState, type KeyboardEvent } from "react";
import { text } from "../text/text.js";
import { formatNumber, parseNumber } from "./format.js";
import { Icon } from "./icon.js";

interface OwnNumberProps {
  readonly label: string;
  /** Null: none of its own. */
  readonly value: number | null;
  /** What holds then, shown pale; null: shown as a dash. */
  readonly inherited: number | null;
  readonly unit: string;
  readonly min: number;
  readonly max: number;
  readonly step: number;
  readonly resetLabel: string;
  onChange(value: number | null): void;
}

/** A number that may be left to what holds for all: empty then, with that as its placeholder. */
export const OwnNumber = (props: OwnNumberProps) => {
  const { label, value, inherited, unit, min, max, step, resetLabel, onChange } = props;
  const id = useId();
  const [typed, setTyped] = useState<string | null>(null);
  const number = typed === null ? value : parseNumber(typed);
  const isEmpty = typed !== null && typed.trim() === "";
  const isWrong = typed !== null && !isEmpty && (number === null || number < min || number > max);

  const take = (words: string): void => {
    setTyped(words);
    const next = parseNumber(words);
    if (words.trim() === "") onChange(null);
    else if (next !== null && next >= min && next <= max) onChange(next);
  };
  const onKeyDown = (event: KeyboardEvent): void => {
    const way = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
    if (event.key === "Enter") setTyped(null);
    if (way === 0) return;
    event.preventDefault();
    const next = (value ?? inherited ?? 0) + way * step * (event.shiftKey ? 10 : 1);
    setTyped(null);
    onChange(Math.min(max, Math.max(min, Number(next.toFixed(6)))));
  };

  return (
    <div className="field own-number" data-own={value !== null || undefined}>
      <label htmlFor={id}>{label}</label>
      <span className="field-box" data-invalid={isWrong || undefined}>
        <input
          id={id}
          type="text"
          inputMode="decimal"
          autoComplete="off"
          value={typed ?? (value === null ? "" : formatNumber(value))}
          placeholder={inherited === null ? "–" : formatNumber(inherited)}
          aria-invalid={isWrong}
          aria-describedby={isWrong ? `${id}-note` : undefined}
          onChange={(event) => take(event.target.value)}
          onBlur={() => setTyped(null)}
          onFocus={(event) => event.target.select()}
          onKeyDown={onKeyDown}
        />
        <span className="unit">{unit}</span>
      </span>
      <button
        type="button"
        className="own-reset"
        aria-label={resetLabel}
        title={resetLabel}
        disabled={value === null}
        onClick={() => {
          setTyped(null);
          onChange(null);
        }}
      >
        <Icon name="close" />
      </button>
      {isWrong && (
        <p id={`${id}-note`} className="note note-error">
          {number === null
            ? text.field.notANumber
            : text.field.between(formatNumber(min, 3), formatNumber(max, 3), unit)}
        </p>
      )}
    </div>
  );
};
