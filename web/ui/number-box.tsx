import { useState, type KeyboardEvent } from "react";
import { fieldText } from "./text.js";
import { formatNumber, parseNumber } from "./format.js";

export interface NumberLimits {
  readonly unit: string;
  readonly min: number;
  /** `min` itself is not allowed. */
  readonly minExcluded?: boolean | undefined;
  readonly max: number;
  /** What an arrow key adds; ten times that with Shift. */
  readonly step: number;
  readonly digits?: number;
}

interface TypedNumber {
  readonly shown: string;
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
  const isRight = (number: number): boolean => (minExcluded ? number > min : number >= min) && number <= max;
  const problemOf = (words: string): string | null => {
    const number = parseNumber(words);
    if (number === null) return emptyAs && words.trim() === "" ? null : fieldText.notANumber;
    return isRight(number) ? null : fieldText.between(formatNumber(min, 3), formatNumber(max, 3), unit);
  };
  return {
    shown: typed ?? (value === null ? "" : formatNumber(value, digits)),
    problem: typed === null ? null : problemOf(typed),
    type: (words) => {
      setTyped(words);
      const number = parseNumber(words);
      if (words.trim() === "") emptyAs?.take();
      else if (number !== null && isRight(number)) onNumber(number);
    },
    forget: () => setTyped(null),
    onKeyDown: (event) => {
      const way = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
      if (event.key === "Enter") setTyped(null);
      if (way === 0) return;
      event.preventDefault();
      setTyped(null);
      const next = (value ?? emptyAs?.from ?? 0) + way * step * (event.shiftKey ? 10 : 1);
      const inRange = Math.min(max, Math.max(min, Number(next.toFixed(6))));
      if (isRight(inRange)) onNumber(inRange);
    },
  };
};

interface NumberBoxProps {
  readonly id: string;
  readonly typed: TypedNumber;
  readonly unit: string;
  readonly placeholder?: string;
  /** Id of the words under it. */
  readonly noteId?: string | undefined;
  readonly disabled?: boolean | undefined;
}

/** Where a number is typed, with its unit. */
export const NumberBox = ({ id, typed, unit, placeholder, noteId, disabled }: NumberBoxProps) => (
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
    <span className="unit">{unit}</span>
  </span>
);
