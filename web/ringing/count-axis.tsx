import { useId } from "react";
import { frequencyOfRipples, RINGING_SPEEDS } from "../../src/internal.js";
import { ringingText as words } from "./ringing-text.js";
import { Segments } from "../ui/fields/choice.js";
import { formatNumber } from "../ui/format.js";
import { NumberBox, useTypedNumber, type NumberLimits } from "../ui/fields/number-box.js";
import { RipplePicture, type Axis } from "./ripple-picture.js";

const COUNTED_MM = 10;
const COUNT: NumberLimits = { unit: "", min: 0, minExcluded: true, max: 100, step: 0.5, digits: 1 };
const LENGTH: NumberLimits = { unit: "mm", min: 0, minExcluded: true, max: 100, step: 0.1, digits: 2 };

type Measure = "count" | "length";

/** What the user has read off the sheet for one axis. */
export interface Reading {
  readonly measure: Measure;
  /** Ripples in 10 mm, or the length of one, mm. Null: not read yet. */
  readonly value: number | null;
}

export const NO_READING: Reading = { measure: "count", value: null };

/** The frequency, Hz; null: not read yet. Throws if no machine swings like that. */
export const frequencyOf = ({ measure, value }: Reading, speedMmPerS: number): number | null => {
  if (value === null) return null;
  return measure === "count"
    ? frequencyOfRipples(speedMmPerS, value, COUNTED_MM)
    : frequencyOfRipples(speedMmPerS, 1, value);
};

interface CountAxisProps {
  readonly axis: Axis;
  readonly reading: Reading;
  /** Index in RINGING_SPEEDS. */
  readonly line: number;
  onChange(reading: Reading): void;
}

/** One axis: where to look on the sheet, a number, and the resulting frequency. */
export const CountAxis = ({ axis, reading, line, onChange }: CountAxisProps) => {
  const { legend, hint } = words.axes[axis];
  const result = resultOf(reading, RINGING_SPEEDS[line]);
  return (
    <fieldset className="count-axis">
      <legend>{legend}</legend>
      <RipplePicture axis={axis} />
      <div className="count-fields">
        <p className="note">{hint}</p>
        <Segments<Measure>
          label={words.fieldFor(words.measure, axis)}
          isLabelHidden
          value={reading.measure}
          options={(["count", "length"] as const).map((value) => ({ value, label: words.measures[value] }))}
          onChange={(measure) => onChange({ measure, value: null })}
        />
        <ReadingField key={reading.measure} axis={axis} reading={reading} onChange={onChange} />
        <output className={result.isFault ? "note note-error" : "count-result"}>{result.words}</output>
      </div>
    </fieldset>
  );
};

type ReadingFieldProps = Omit<CountAxisProps, "line">;

const ReadingField = ({ axis, reading, onChange }: ReadingFieldProps) => {
  const id = useId();
  const from = reading.measure === "count" ? 3 : 3.3;
  const typed = useTypedNumber(
    reading.value,
    reading.measure === "count" ? COUNT : LENGTH,
    (value) => onChange({ ...reading, value }),
    { from, take: () => onChange({ ...reading, value: null }) },
  );
  const label = reading.measure === "count" ? words.ripples : words.length;
  return (
    <div className="field">
      <label htmlFor={id}>
        {label}
        <span className="visually-hidden">{`, ${axis}`}</span>
      </label>
      <NumberBox id={id} typed={typed} noteId={typed.problem ? `${id}-note` : undefined} />
      {typed.problem && (
        <p id={`${id}-note`} className="note note-error">
          {typed.problem}
        </p>
      )}
    </div>
  );
};

const resultOf = (reading: Reading, speedMmPerS: number): { words: string; isFault: boolean } => {
  try {
    const hz = frequencyOf(reading, speedMmPerS);
    return { words: hz === null ? words.noResult : words.result(formatNumber(hz, 1)), isFault: false };
  } catch (error) {
    return { words: error instanceof Error ? error.message : String(error), isFault: true };
  }
};
