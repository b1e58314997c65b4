import { useId } from "react";
import { useHint } from "../hint.js";
import { useShownAgain } from "./choice.js";
import { NumberBox, useTypedNumber, type NumberLimits } from "./number-box.js";

interface NumberFieldProps extends NumberLimits {
  readonly label: string;
  readonly value: number;
  /** Help on demand. */
  readonly hint?: string | undefined;
  /** Range of the slider, if the field has one: the values in everyday use, within min … max. */
  readonly slider?: readonly [from: number, to: number] | undefined;
  readonly disabled?: boolean;
  onChange(value: number): void;
  /** Called in addition while the slider is dragged. */
  readonly onSlide?: ((value: number) => void) | undefined;
}

/** A number with its unit: typed, stepped by the arrow keys, or dragged. */
export const NumberField = (props: NumberFieldProps) => {
  const { label, value, step, hint, slider, disabled, onChange, onSlide } = props;
  const id = useId();
  const typed = useTypedNumber(value, props, onChange);
  const noteId = `${id}-note`;
  const help = useHint(label, noteId, hint);
  const slide = useShownAgain((to: number) => {
    typed.forget();
    onChange(to);
    onSlide?.(to);
  });
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
          onChange={(event) => slide(Number(event.target.value))}
        />
      )}
      <NumberBox
        id={id}
        typed={typed}
        noteId={(typed.problem ?? hint) ? noteId : undefined}
        disabled={disabled}
      />
      {typed.problem ? (
        <p id={noteId} className="note note-error">
          {typed.problem}
        </p>
      ) : (
        help.note
      )}
    </div>
  );
};

const MAX_MM = 5_000;

interface MmPairProps {
  readonly labels: readonly [x: string, y: string];
  readonly values: readonly [xMm: number, yMm: number];
  readonly min: number;
  readonly step: number;
  onChange(xMm: number, yMm: number): void;
}

/** Two lengths beside each other, across and down. */
export const MmPair = ({ labels, values: [xMm, yMm], min, step, onChange }: MmPairProps) => {
  const limits = { unit: "mm", min, max: MAX_MM, step };
  return (
    <div className="field-pair">
      <NumberField label={labels[0]} value={xMm} {...limits} onChange={(mm) => onChange(mm, yMm)} />
      <NumberField label={labels[1]} value={yMm} {...limits} onChange={(mm) => onChange(xMm, mm)} />
    </div>
  );
};
