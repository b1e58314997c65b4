import { useId } from "react";
import { Icon } from "../icon.js";
import { NumberBox, useTypedNumber, type NumberLimits } from "./number-box.js";
import "./own-number.css";

interface OwnNumberProps extends NumberLimits {
  readonly label: string;
  /** Null: no custom value. */
  readonly value: number | null;
  /** The value that applies then, shown pale; null: shown as a dash. */
  readonly inherited: number | null;
  readonly resetLabel: string;
  onChange(value: number | null): void;
}

/** An optional custom number. When it is empty, the inherited number applies and is the placeholder. */
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
        placeholder={inherited === null ? "–" : typed.format(inherited)}
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
