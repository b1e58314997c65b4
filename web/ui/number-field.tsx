import { useId } from "react";
import { useHint } from "./hint.js";
import { NumberBox, useTypedNumber, type NumberLimits } from "./number-box.js";

interface NumberFieldProps extends NumberLimits {
  readonly label: string;
  readonly value: number;
  /** Help on demand. */
  readonly hint?: string;
  /** Range of the slider, if the field has one: the values in everyday use, within min … max. */
  readonly slider?: readonly [from: number, to: number];
  readonly disabled?: boolean;
  onChange(value: number): void;
  /** Called in addition while the slider is dragged. */
  onSlide?(value: number): void;
}

/** A number with its unit: typed, stepped by the arrow keys, or dragged. */
export const NumberField = (props: NumberFieldProps) => {
  const { label, value, step, hint, slider, disabled, onChange, onSlide } = props;
  const id = useId();
  const typed = useTypedNumber(value, props, onChange);
  const noteId = `${id}-note`;
  const help = useHint(label, noteId, hint !== undefined);
  const note = typed.problem ?? hint;
  return (
    <div className={slider ? "field field-sliding" : "field"}>
      <span className="field-label">
        <label htmlFor={id}>{label}</label>
        {help.button}
      </span>
      {slider && (
        <input
          type="range"
          // Only for dragging. Keyboard and screen reader use the field beside it, which has the same value.
          aria-hidden="true"
          tabIndex={-1}
          min={slider[0]}
          max={slider[1]}
          step={step}
          value={Math.min(slider[1], Math.max(slider[0], value))}
          disabled={disabled}
          onChange={(event) => {
            typed.forget();
            onChange(Number(event.target.value));
            onSlide?.(Number(event.target.value));
          }}
        />
      )}
      <NumberBox id={id} typed={typed} noteId={note ? noteId : undefined} disabled={disabled} />
      {note && (
        <p
          id={noteId}
          className={typed.problem ? "note note-error" : "note"}
          hidden={typed.problem === null && !help.isShown}
        >
          {note}
        </p>
      )}
    </div>
  );
};
