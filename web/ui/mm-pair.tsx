import { NumberField } from "./number-field.js";

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
