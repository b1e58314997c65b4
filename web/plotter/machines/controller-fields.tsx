import type { MachineProfile } from "../../../src/index.js";
import { controllerOf } from "../../../src/internal.js";
import { Segments, Switch } from "../../ui/fields/choice.js";
import { NumberField } from "../../ui/fields/number-field.js";
import { profileText as words } from "./text.js";

type FieldRow = ReturnType<typeof controllerOf>["fields"][string];

interface Props {
  readonly profile: MachineProfile;
  onChange(profile: MachineProfile): void;
}

const isGiven = (value: unknown): boolean => value !== null && value !== undefined;

/** What a field begins with. */
const startOf = (row: FieldRow): number | string =>
  row.kind === "number" && typeof row.default === "number" ? row.default : "";

/** The fields of a controller that has no form of its own, from its description. */
export const ControllerFields = ({ profile, onChange }: Props) => {
  const { fields, choice } = controllerOf(profile);
  const { controller } = profile;
  const change = (part: Readonly<Record<string, unknown>>): void =>
    onChange({ ...profile, controller: { ...controller, ...part } });
  const options = choice?.options ?? [];
  const chosen = options.findIndex((option) => isGiven(controller[option.fields[0]]));
  const excluded = new Set(options.flatMap((option, i) => (i === chosen ? [] : option.fields)));
  const own = new Set(options[chosen]?.fields);
  const rows = Object.entries(fields).filter(([key]) => own.has(key) || !excluded.has(key));
  const field = ([key, row]: readonly [string, FieldRow]) => (
    <Field
      key={key}
      row={row}
      isChosen={own.has(key)}
      value={controller[key]}
      onChange={(value) => change({ [key]: value })}
    />
  );
  return (
    <fieldset className="subgroup">
      <legend>{words.controller}</legend>
      {rows.filter(([, row]) => row.isOptional !== true).map(field)}
      {choice && (
        <Segments
          label={choice.label}
          value={String(chosen)}
          options={options.map(({ label }, i) => ({ value: String(i), label }))}
          onChange={(at) => {
            const none = [...own, ...excluded].map((key) => [key, null] as const);
            const begun = options[Number(at)].fields.map((key) => [key, startOf(fields[key])] as const);
            change(Object.fromEntries([...none, ...begun]));
          }}
        />
      )}
      {rows.filter(([key]) => own.has(key)).map(field)}
      {rows.filter(([key, row]) => row.isOptional === true && !own.has(key)).map(field)}
    </fieldset>
  );
};

interface FieldProps {
  readonly row: FieldRow;
  /** It belongs to the chosen option, so it is not left out. */
  readonly isChosen: boolean;
  readonly value: unknown;
  onChange(value: number | string | boolean | null): void;
}

const Field = ({ row, isChosen, value, onChange }: FieldProps) => {
  switch (row.kind) {
    case "switch":
      return <Switch label={row.label} isOn={value === true} onChange={onChange} />;
    case "text":
      return (
        <label className="field">
          <span>{row.label}</span>
          <textarea
            rows={2}
            maxLength={row.maxLength}
            value={typeof value === "string" ? value : ""}
            onChange={(event) => onChange(event.target.value)}
          />
        </label>
      );
    case "number": {
      const isUsed = isGiven(value);
      const isLeftOut = row.isOptional === true && !isChosen;
      return (
        <>
          {isLeftOut && (
            <Switch
              label={words.useField(row.label)}
              isOn={isUsed}
              onChange={(isOn) => onChange(isOn ? startOf(row) : null)}
            />
          )}
          {(isUsed || !isLeftOut) && (
            <NumberField
              label={row.label}
              hint={row.about}
              value={typeof value === "number" ? value : row.min}
              unit={row.unit}
              min={row.min}
              max={row.max}
              step={row.step}
              digits={row.digits}
              onChange={onChange}
            />
          )}
        </>
      );
    }
    default:
      return null;
  }
};
