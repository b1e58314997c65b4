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
export const ControllerFields = (props: Props) => {
  const { fields } = controllerOf(props.profile);
  const { choosable } = choiceOf(props.profile);
  const rows = Object.entries(fields).filter(([key]) => !choosable.has(key));
  const field = ([name, row]: readonly [string, FieldRow]) => (
    <ProfileField key={name} {...props} name={name} row={row} isChosen={false} />
  );
  return (
    <fieldset className="subgroup">
      <legend>{words.controller}</legend>
      {rows.filter(([, row]) => row.isOptional !== true).map(field)}
      <ChoiceFields {...props} />
      {rows.filter(([, row]) => row.isOptional === true).map(field)}
    </fieldset>
  );
};

/** The option that a profile has, and the fields of any option. */
const choiceOf = (profile: MachineProfile) => {
  const options = controllerOf(profile).choice?.options ?? [];
  const chosen = options.findIndex((option) => isGiven(profile.controller[option.fields[0]]));
  return { chosen, choosable: new Set(options.flatMap((option) => option.fields)) };
};

/** One of the groups of fields that exclude each other, such as the ways to lift the pen. */
export const ChoiceFields = (props: Props) => {
  const { profile, onChange } = props;
  const { fields, choice } = controllerOf(profile);
  if (!choice) return null;
  const { chosen, choosable } = choiceOf(profile);
  const choose = (at: string): void => {
    const none = [...choosable].map((key) => [key, null] as const);
    const begun = choice.options[Number(at)].fields.map((key) => [key, startOf(fields[key])] as const);
    onChange({
      ...profile,
      controller: { ...profile.controller, ...Object.fromEntries([...none, ...begun]) },
    });
  };
  return (
    <>
      <Segments
        label={choice.label}
        value={String(chosen)}
        options={choice.options.map(({ label }, i) => ({ value: String(i), label }))}
        onChange={choose}
      />
      {choice.options[chosen]?.fields.map((name) => (
        <ProfileField key={name} {...props} name={name} row={fields[name]} isChosen />
      ))}
    </>
  );
};

interface ProfileFieldProps extends Props {
  readonly name: string;
  readonly row: FieldRow;
  readonly isChosen: boolean;
}

const ProfileField = ({ profile, onChange, name, row, isChosen }: ProfileFieldProps) => {
  const { controller } = profile;
  return (
    <Field
      row={row}
      isChosen={isChosen}
      value={controller[name]}
      onChange={(value) => onChange({ ...profile, controller: { ...controller, [name]: value } })}
    />
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
