import { useId } from "react";
import { Icon } from "./icon.js";
import { NumberBox, useTypedNumber, type NumberLimits } from "./number-box.js";
import "./own-number.css";

interface OwnNumberProps extends NumberLimits {
  readonly label: string;
  /** Null: none of its own. */
  readonly value: number | null;
  /** What holds then, shown pale; null: shown as a dash. */
  readonly inherited: number | null;
  readonly resetLabel: string;
  onChange(value: number | null): void;
}

/** A number that may be left to what holds for all: empty then, with that as its placeholder. */
export const OwnNumber = (props: OwnNumberProps) => {
  const { label, value, inherited, resetLabel, onChange } = props;
  const id = useId();
  const typed = useTypedNumber(value, props, onChange, { from: inherited ?? 0, take: () => onChange(null) });
  return (
    <div className="field own-number" data-own={value !== null || undefined}>
      <label htmlFor={id}>{label}</label>
      <NumberBox
        id={id}
        typed={typed}
        placeholder={inherited === null ? "–" : typed.words(inherited)}
        noteId={typed.problem ? `${id}-note` : undefined}
      />
      <button
        type="button"
        className="own-reset"
        aria-label={resetLabel}
        title={resetLabel}
        disabled={value === null}
        onClick={() => {
          typed.forget();
          onChange(null);
        }}
      >
        <Icon name="close" />
      </button>
      {typed.problem && (
        <p id={`${id}-note`} className="note note-error">
          {typed.problem}
        </p>
      )}
    </div>
  );
};
