import { useId } from "react";
import { STRAIGHT_MM, type Axis, type RippleReading, type Springs } from "../../src/internal.js";
import { ringingText as words } from "./ringing-text.js";
import { formatNumber } from "../ui/format.js";
import { NumberBox, useTypedNumber, type NumberLimits } from "../ui/fields/number-box.js";
import { RipplePicture } from "./ripple-picture.js";

const RIPPLES: NumberLimits = { unit: "", min: 1, max: 30, step: 1, digits: 0 };
const LENGTH: NumberLimits = {
  unit: "mm",
  min: 0,
  minExcluded: true,
  max: Math.floor(STRAIGHT_MM),
  step: 0.5,
  digits: 2,
};
/** What the arrow keys step from in an empty field. */
const FIRST = { ripples: 2, lengthMm: 10 };

/** What the user has read off the sheet for one axis; null: not yet. */
export type Reading = { readonly [Field in keyof RippleReading]: number | null };

export const NO_READING: Reading = { ripples: null, lengthMm: null };

/** Null until both numbers are there. */
export const readingOf = ({ ripples, lengthMm }: Reading): RippleReading | null =>
  ripples === null || lengthMm === null ? null : { ripples: Math.round(ripples), lengthMm };

interface CountAxisProps {
  readonly axis: Axis;
  readonly reading: Reading;
  /** For the picture: as far as the springs are known. */
  readonly springs: Springs;
  readonly hz: number | null;
  /** Why the reading is impossible. */
  readonly fault: string | null;
  onChange(reading: Reading): void;
}

/** One axis: a picture of its line, the two numbers to read, and the resulting frequency. */
export const CountAxis = ({ axis, reading, springs, hz, fault, onChange }: CountAxisProps) => {
  const { legend, hint } = words.axes[axis];
  return (
    <fieldset className="count-axis" data-axis={axis}>
      <legend>{legend}</legend>
      <RipplePicture axis={axis} springs={springs} ripples={reading.ripples} />
      <div className="count-fields">
        <p className="note">{hint}</p>
        <ReadingField axis={axis} field="ripples" reading={reading} onChange={onChange} />
        <ReadingField axis={axis} field="lengthMm" reading={reading} onChange={onChange} />
        <output className={fault === null ? "count-result" : "note note-error"}>
          {fault ?? (hz === null ? words.noResult : words.result(formatNumber(hz, 1)))}
        </output>
      </div>
    </fieldset>
  );
};

interface ReadingFieldProps extends Pick<CountAxisProps, "axis" | "reading" | "onChange"> {
  readonly field: keyof Reading;
}

const ReadingField = ({ axis, field, reading, onChange }: ReadingFieldProps) => {
  const id = useId();
  const typed = useTypedNumber(
    reading[field],
    field === "ripples" ? RIPPLES : LENGTH,
    (value) => onChange({ ...reading, [field]: value }),
    { from: FIRST[field], take: () => onChange({ ...reading, [field]: null }) },
  );
  return (
    <div className="field">
      <label htmlFor={id}>
        {words.fields[field]}
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
