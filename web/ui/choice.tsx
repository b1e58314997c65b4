import { useId, type ReactNode } from "react";

export interface ChoiceOption<T extends string> {
  readonly value: T;
  readonly label: string;
  readonly icon?: ReactNode;
  /** It cannot be chosen now. */
  readonly isOff?: boolean;
}

interface ChoiceProps<T extends string> {
  readonly label: string;
  readonly value: T;
  readonly options: readonly ChoiceOption<T>[];
  readonly isLabelHidden?: boolean;
  onChange(value: T): void;
}

/** One of a few, all in sight: a row of radio buttons that looks like one control. */
export const Segments = <T extends string>({
  label,
  value,
  options,
  isLabelHidden,
  onChange,
}: ChoiceProps<T>) => {
  const name = useId();
  return (
    <fieldset className="field segments-field">
      <legend className={isLabelHidden ? "visually-hidden" : undefined}>{label}</legend>
      <div className="segments">
        {options.map((option) => (
          <label key={option.value} className="segment">
            <input
              type="radio"
              name={name}
              checked={option.value === value}
              disabled={option.isOff}
              onChange={() => onChange(option.value)}
            />
            <span>
              {option.icon}
              {option.label}
            </span>
          </label>
        ))}
      </div>
    </fieldset>
  );
};

/** One of many: the system's own list. */
export const Select = <T extends string>({ label, value, options, onChange }: ChoiceProps<T>) => {
  const id = useId();
  return (
    <div className="field">
      <label htmlFor={id}>{label}</label>
      <select id={id} value={value} onChange={(event) => onChange(event.target.value as T)}>
        {options.map((option) => (
          <option key={option.value} value={option.value}>
            {option.label}
          </option>
        ))}
      </select>
    </div>
  );
};

interface SwitchProps {
  readonly label: string;
  readonly isOn: boolean;
  onChange(isOn: boolean): void;
}

export const Switch = ({ label, isOn, onChange }: SwitchProps) => (
  <label className="switch">
    <input
      type="checkbox"
      role="switch"
      checked={isOn}
      onChange={(event) => onChange(event.target.checked)}
    />
    <span className="switch-track" aria-hidden="true" />
    <span className="switch-label">{label}</span>
  </label>
);
