import { useId, useReducer } from "react";
import { useHint } from "../hint.js";

/**
 * Calls `onChange`, then shows the page's own value again. A field would otherwise keep what was chosen when the page
 * did not take it over, because nothing is rendered then.
 */
export const useShownAgain = <T extends string | number | boolean>(
  onChange: (value: T) => void,
): ((value: T) => void) => {
  const [, render] = useReducer((count: number) => count + 1, 0);
  return (value) => {
    onChange(value);
    render();
  };
};

interface ChoiceOption<T extends string> {
  readonly value: T;
  readonly label: string;
  /** Can't be chosen now. */
  readonly isOff?: boolean;
}

interface ChoiceProps<T extends string> {
  readonly label: string;
  readonly value: T;
  readonly options: readonly ChoiceOption<T>[];
  /** Help on demand. */
  readonly hint?: string;
  onChange(value: T): void;
}

interface SegmentsProps<T extends string> extends ChoiceProps<T> {
  readonly isLabelHidden?: boolean;
  /** Puts the label beside the choices; for two short ones. */
  readonly isInline?: boolean;
}

/** One of a few choices, all visible: a row of radio buttons that looks like one control. */
export const Segments = <T extends string>({
  label,
  value,
  options,
  isLabelHidden,
  isInline,
  hint,
  onChange,
}: SegmentsProps<T>) => {
  const name = useId();
  const help = useHint(label, `${name}-note`, hint);
  const choose = useShownAgain(onChange);
  return (
    <div
      role="group"
      aria-labelledby={`${name}-label`}
      className="field segments-field"
      data-inline={isInline || undefined}
    >
      <span className={isLabelHidden ? "visually-hidden" : "field-label"}>
        <span id={`${name}-label`}>{label}</span>
        {help.button}
      </span>
      <div className="segments">
        {options.map((option) => (
          <label key={option.value} className="segment">
            <input
              type="radio"
              name={name}
              checked={option.value === value}
              disabled={option.isOff}
              onChange={() => choose(option.value)}
            />
            <span>{option.label}</span>
          </label>
        ))}
      </div>
      {help.note}
    </div>
  );
};

/** One of many choices: the system's own list. */
interface SelectProps<T extends string> extends ChoiceProps<T> {
  /** The options are long: they are below the label, not beside it. */
  readonly isBelow?: boolean;
}

export const Select = <T extends string>({
  label,
  value,
  options,
  hint,
  isBelow,
  onChange,
}: SelectProps<T>) => {
  const id = useId();
  const help = useHint(label, `${id}-note`, hint);
  const choose = useShownAgain(onChange);
  return (
    <div className="field" data-below={isBelow}>
      <span className="field-label">
        <label htmlFor={id}>{label}</label>
        {help.button}
      </span>
      <select id={id} value={value} onChange={(event) => choose(event.target.value as T)}>
        {options.map((option) => (
          <option key={option.value} value={option.value} disabled={option.isOff}>
            {option.label}
          </option>
        ))}
      </select>
      {help.note}
    </div>
  );
};

interface SwitchProps {
  readonly label: string;
  readonly isOn: boolean;
  onChange(isOn: boolean): void;
}

export const Switch = ({ label, isOn, onChange }: SwitchProps) => {
  const turn = useShownAgain(onChange);
  return (
    <label className="switch">
      <input type="checkbox" role="switch" checked={isOn} onChange={(event) => turn(event.target.checked)} />
      <span className="switch-track" aria-hidden="true" />
      <span className="switch-label">{label}</span>
    </label>
  );
};
