import { useState, type KeyboardEvent } from "react";
import { fieldText } from "./text.js";
import { mmFromLength } from "../../src/internal.js";
import { usePageState } from "../state/use-store.js";
import { formatInUnit, formatNumber, parseNumber, parseTypedLength } from "./format.js";

export interface NumberLimits {
  /** "mm": a length, which is shown and typed in the user's unit. */
  readonly unit: string;
  readonly min: number;
  /** `min` itself is not allowed. */
  readonly minExcluded?: boolean | undefined;
  readonly max: number;
  /** What an arrow key adds; ten times that with Shift. */
  readonly step: number;
  readonly digits?: number;
}

/** A step in mm is that many times smaller in inches: 1 mm becomes 0.05 in. */
const STEPS_PER_INCH = 20;

interface TypedNumber {
  readonly shown: string;
  /** What the number is shown in. */
  readonly unit: string;
  /** Another number as this one is shown. */
  words(value: number): string;
  /** What is wrong with what was typed. */
  readonly problem: string | null;
  type(words: string): void;
  /** Shows the number itself again instead of what was typed. */
  forget(): void;
  onKeyDown(event: KeyboardEvent): void;
}

/**
 * A number as it is typed and stepped by arrow keys; only numbers within the limits get out. `emptyAs`: what an empty
 * field means, where it means something: the number that is stepped from, and what to do.
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
  const parse = (words: string): number | null =>
    unit === "mm" ? parseTypedLength(words, lengthUnit) : parseNumber(words);
  const words = (number: number, most = digits): string =>
    inInches ? formatInUnit(number, "in", most) : formatNumber(number, most);
  const shownUnit = inInches ? "in" : unit;
  const stepBy = inInches ? mmFromLength(step / STEPS_PER_INCH, "in") : step;
  const isRight = (number: number): boolean => (minExcluded ? number > min : number >= min) && number <= max;
  const problemOf = (typedWords: string): string | null => {
    const number = parse(typedWords);
    if (number === null) return emptyAs && typedWords.trim() === "" ? null : fieldText.notANumber;
    return isRight(number) ? null : fieldText.between(words(min, 3), words(max, 3), shownUnit);
  };
  return {
    shown: typed ?? (value === null ? "" : words(value)),
    unit: shownUnit,
    words,
    problem: typed === null ? null : problemOf(typed),
    type: (typedWords) => {
      setTyped(typedWords);
      const number = parse(typedWords);
      if (typedWords.trim() === "") emptyAs?.take();
      else if (number !== null && isRight(number)) onNumber(number);
    },
    forget: () => setTyped(null),
    onKeyDown: (event) => {
      const way = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
      if (event.key === "Enter") setTyped(null);
      if (way === 0) return;
      event.preventDefault();
      setTyped(null);
      const next = (value ?? emptyAs?.from ?? 0) + way * stepBy * (event.shiftKey ? 10 : 1);
      const inRange = Math.min(max, Math.max(min, Number(next.toFixed(6))));
      if (isRight(inRange)) onNumber(inRange);
    },
  };
};

interface NumberBoxProps {
  readonly id: string;
  readonly typed: TypedNumber;
  readonly placeholder?: string;
  /** Id of the words under it. */
  readonly noteId?: string | undefined;
  readonly disabled?: boolean | undefined;
}

/** Where a number is typed, with its unit. */
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
