import { useState, type KeyboardEvent } from "react";
import { fieldText } from "../text.js";
import { mmFromLength } from "../../../src/internal.js";
import { usePageState } from "../../state/use-store.js";
import { formatInUnit, formatNumber, parseNumber, parseTypedLength } from "../format.js";

export interface NumberLimits {
  /** "mm": a length, shown and typed in the user's unit. */
  readonly unit: string;
  readonly min: number;
  /** `min` itself is excluded. */
  readonly minExcluded?: boolean | undefined;
  readonly max: number;
  /** Added by an arrow key; ten times as much with Shift. */
  readonly step: number;
  readonly digits?: number | undefined;
}

/** In inches, the arrow keys use the step in mm divided by this: 1 mm becomes 0.05 in. */
const STEPS_PER_INCH = 20;

interface TypedNumber {
  readonly shown: string;
  /** The unit in which the number is shown. */
  readonly unit: string;
  /** Formats another number the same way. */
  format(value: number): string;
  /** Why the typed text is not accepted. */
  readonly problem: string | null;
  type(text: string): void;
  /** Shows the number itself again instead of the typed text. */
  forget(): void;
  onKeyDown(event: KeyboardEvent): void;
}

/**
 * A number that is typed, or stepped by the arrow keys. Only numbers within the limits reach `onNumber`. `emptyAs` is
 * for fields that may be empty: the number to step from, and what to call when the field is emptied.
 */
export const useTypedNumber = (
  value: number | null,
  { unit, min, minExcluded = false, max, step, digits = 2 }: NumberLimits,
  onNumber: (value: number) => void,
  emptyAs?: { readonly from: number; take(): void },
): TypedNumber => {
  const [typed, setTyped] = useState<string | null>(null);
  const lengthUnit = usePageState((state) => state.view.lengthUnit);
  const inInches = unit === "mm" && lengthUnit === "in";
  const parse = (text: string): number | null =>
    unit === "mm" ? parseTypedLength(text, lengthUnit) : parseNumber(text);
  const format = (number: number, maxDigits = digits): string =>
    inInches ? formatInUnit(number, "in", maxDigits) : formatNumber(number, maxDigits);
  const shownUnit = inInches ? "in" : unit;
  const stepBy = inInches ? mmFromLength(step / STEPS_PER_INCH, "in") : step;
  const isInRange = (number: number): boolean =>
    (minExcluded ? number > min : number >= min) && number <= max;
  const problemOf = (text: string): string | null => {
    const number = parse(text);
    if (number === null) return emptyAs && text.trim() === "" ? null : fieldText.notANumber;
    return isInRange(number) ? null : fieldText.between(format(min, 3), format(max, 3), shownUnit);
  };
  return {
    shown: typed ?? (value === null ? "" : format(value)),
    unit: shownUnit,
    format,
    problem: typed === null ? null : problemOf(typed),
    type: (text) => {
      setTyped(text);
      const number = parse(text);
      if (text.trim() === "") emptyAs?.take();
      else if (number !== null && isInRange(number)) onNumber(number);
    },
    forget: () => setTyped(null),
    onKeyDown: (event) => {
      const direction = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
      if (event.key === "Enter") setTyped(null);
      if (direction === 0) return;
      event.preventDefault();
      setTyped(null);
      const next = (value ?? emptyAs?.from ?? 0) + direction * stepBy * (event.shiftKey ? 10 : 1);
      const clamped = Math.min(max, Math.max(min, Number(next.toFixed(6))));
      if (isInRange(clamped)) onNumber(clamped);
    },
  };
};

interface NumberBoxProps {
  readonly id: string;
  readonly typed: TypedNumber;
  readonly placeholder?: string;
  /** Id of the note under it. */
  readonly noteId?: string | undefined;
  readonly disabled?: boolean | undefined;
}

/** The input box of a number, with its unit. */
export const NumberBox = ({ id, typed, placeholder, noteId, disabled }: NumberBoxProps) => (
  <span className="field-box" data-invalid={typed.problem !== null || undefined}>
    <input
      id={id}
      type="text"
      inputMode="decimal"
      autoComplete="off"
      value={typed.shown}
      placeholder={placeholder}
      disabled={disabled}
      aria-invalid={typed.problem !== null}
      aria-describedby={noteId}
      onChange={(event) => typed.type(event.target.value)}
      onBlur={typed.forget}
      onFocus={(event) => event.target.select()}
      onKeyDown={typed.onKeyDown}
    />
    <span className="unit">{typed.unit}</span>
  </span>
);
