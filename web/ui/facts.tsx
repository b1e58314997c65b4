interface FactsProps {
  readonly rows: readonly (readonly [label: string, value: string])[];
  readonly className?: string;
}

/** A list of labels with their values. */
export const Facts = ({ rows, className }: FactsProps) => (
  <dl className={className}>
    {rows.map(([label, value]) => (
      <div key={label}>
        <dt>{label}</dt>
        <dd>{value}</dd>
      </div>
    ))}
  </dl>
);
