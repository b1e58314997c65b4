interface TextFieldProps {
  readonly label: string;
  readonly value: string;
  readonly maxLength?: number;
  /** The label is the field's placeholder. */
  readonly isLabelInside?: boolean;
  onChange(value: string): void;
}

/** A line of text, such as a name. */
export const TextField = ({
  label,
  value,
  maxLength = 100,
  isLabelInside = false,
  onChange,
}: TextFieldProps) => {
  const input = (
    <input
      className="text-field"
      type="text"
      maxLength={maxLength}
      aria-label={isLabelInside ? label : undefined}
      placeholder={isLabelInside ? label : undefined}
      value={value}
      onChange={(event) => onChange(event.target.value)}
    />
  );
  if (isLabelInside) return input;
  return (
    <label className="field">
      <span>{label}</span>
      {input}
    </label>
  );
};
