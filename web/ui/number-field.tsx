import { useId, useState, type KeyboardEvent } from "react";
import { text } from "../text/text.js";
import { formatNumber, parseNumber } from "./format.js";

export interface NumberFieldProps {
  readonly label: string;
  readonly value: number;
  readonly unit: string;
  readonly min: number;
  readonly max: number;
  /** What an arrow key adds; ten times that with Shift. */
  readonly step: number;
  readonly digits?: number;
  readonly hint?: string;
  /** Ends of the slider, where the field has one: the range in everyday use, inside min … max. */
  readonly slider?: readonly [from: number, to: number];
  readonly disabled?: boolean;
  onChange(value: number): void;
}

/** A number with its unit: typed, stepped by arrow keys, or dragged. Only numbers within the limits get out. */
export const NumberField = (props: NumberFieldProps) => {
  const { label, value, unit, min, max, step, digits = 2, hint, slider, onChange } = props;
  const id = useId();
  const [typed, setTyped] = useState<string | null>(null);
  const shown = typed ?? formatNumber(value, digits);
  const problem = typed === null ? null : problemOf(typed, props);

  const take = (words: string): void => {
    setTyped(words);
    const number = parseNumber(words);
    if (number !== null && number >= min && number <= max) onChange(number);
  };
  const onKeyDown = (event: KeyboardEvent): void => {
    const direction = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
    if (event.key === "Enter") setTyped(null);
    if (direction === 0) return;
    event.preventDefault();
    const next = value + direction * step * (event.shiftKey ? 10 : 1);
    setTyped(null);
    onChange(Math.min(max, Math.max(min, Number(next.toFixed(6)))));
  };

  return (
    <div className={slider ? "field field-sliding" : "field"}>
      <label htmlFor={id}>{label}</label>
      {slider && (
        <input
          type="range"
          // The same value as the field beside it, for hands that drag: named and focused once only.
          aria-hidden="true"
          tabIndex={-1}
          min={slider[0]}
          max={slider[1]}
          step={step}
          value={Math.min(slider[1], Math.max(slider[0], value))}
          disabled={props.disabled}
          onChange={(event) => {
            setTyped(null);
            onChange(Number(event.target.value));
          }}
        />
      )}
      <span className="field-box" data-invalid={problem !== null || undefined}>
        <input
          id={id}
          type="text"
          inputMode="decimal"
          autoComplete="off"
          value={shown}
          disabled={props.disabled}
          aria-invalid={problem !== null}
          aria-describedby={problem || hint ? `${id}-note` : undefined}
          onChange={(event) => take(event.target.value)}
          onBlur={() => setTyped(null)}
          onFocus={(event) => event.target.select()}
          onKeyDown={onKeyDown}
        />
        <span className="unit">{unit}</span>
      </span>
      {(problem || hint) && (
        <p id={`${id}-note`} className={problem ? "note note-error" : "note"}>
          {problem ?? hint}
        </p>
      )}
    </div>
  );
};

const problemOf = (typed: string, { min, max, unit }: NumberFieldProps): string | null => {
  const number = parseNumber(typed);
  if (number === null) return text.field.notANumber;
  if (number >= min && number <= max) return null;
  return text.field.between(formatNumber(min, 3), formatNumber(max, 3), unit);
};
