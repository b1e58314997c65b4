import type { MachineProfile } from "../../../src/index.js";
import { controllerOf, type EbbController } from "../../../src/internal.js";
import { profileText as words } from "./text.js";
import { Segments, Select, Switch } from "../../ui/fields/choice.js";
import { MmPair, NumberField } from "../../ui/fields/number-field.js";
import { TextField } from "../../ui/fields/text-field.js";
import { ControllerFields } from "./controller-fields.js";
import { isEbbMachine, withController, type EbbProfile } from "./profile.js";

interface ProfileFormProps {
  readonly profile: MachineProfile;
  onChange(profile: MachineProfile): void;
}

interface EbbFieldsProps {
  readonly profile: EbbProfile;
  onChange(profile: EbbProfile): void;
}

/** Every field of a machine's profile, within the limits of its schema. */
export const ProfileForm = ({ profile, onChange }: ProfileFormProps) => {
  const change = (part: Partial<MachineProfile>): void => onChange({ ...profile, ...part });
  return (
    <div className="profile-form">
      <TextField label={words.name} value={profile.name} onChange={(name) => change({ name })} />
      <ReachFields profile={profile} onChange={onChange} />
      <MotorFields profile={profile} onChange={onChange} />
      {isEbbMachine(profile) ? (
        <>
          <ServoFields profile={profile} onChange={onChange} />
          <HomingFields profile={profile} onChange={onChange} />
        </>
      ) : (
        <ControllerFields profile={profile} onChange={onChange} />
      )}
    </div>
  );
};

/** The carriage's reach from home. */
export const ReachFields = ({ profile, onChange }: ProfileFormProps) => (
  <fieldset className="subgroup">
    <legend>{words.reach}</legend>
    <MmPair
      labels={[words.width, words.height]}
      values={[profile.widthMm, profile.heightMm]}
      min={1}
      step={1}
      onChange={(widthMm, heightMm) => onChange({ ...profile, widthMm, heightMm })}
    />
  </fieldset>
);

const MICROSTEP_MODES = [1, 2, 3, 4, 5] as const;

const MotorFields = ({ profile, onChange }: ProfileFormProps) => {
  const change = (part: Partial<MachineProfile>): void => onChange({ ...profile, ...part });
  return (
    <fieldset className="subgroup">
      <legend>{words.motors}</legend>
      {!controllerOf(profile).scaleSettings && (
        <Segments
          label={words.wiring}
          value={profile.motors}
          options={[
            { value: "mixed", label: words.mixed },
            { value: "direct", label: words.direct },
          ]}
          onChange={(motors) => change({ motors })}
        />
      )}
      <NumberField
        label={words.stepsPerMm}
        value={profile.stepsPerMm}
        unit="1/mm"
        min={0.1}
        max={10_000}
        step={0.1}
        digits={4}
        onChange={(stepsPerMm) => change({ stepsPerMm })}
      />
      {isEbbMachine(profile) && <MicrostepField profile={profile} onChange={onChange} />}
      <Switch label={words.flipX} isOn={profile.flipX ?? false} onChange={(flipX) => change({ flipX })} />
      <Switch label={words.flipY} isOn={profile.flipY ?? false} onChange={(flipY) => change({ flipY })} />
      <Switch
        label={words.swapAxes}
        isOn={profile.swapAxes ?? false}
        onChange={(swapAxes) => change({ swapAxes })}
      />
    </fieldset>
  );
};

const MicrostepField = ({ profile, onChange }: EbbFieldsProps) => (
  <Select
    label={words.microsteps}
    value={String(profile.controller.microstepMode)}
    options={MICROSTEP_MODES.map((mode) => ({ value: String(mode), label: `1/${2 ** (5 - mode)}` }))}
    onChange={(mode) =>
      onChange(
        withController(profile, { microstepMode: MICROSTEP_MODES.find((one) => String(one) === mode) ?? 1 }),
      )
    }
  />
);

const SERVO_ENDS = [
  ["servoPosAt0Pct", words.lowest],
  ["servoPosAt100Pct", words.highest],
] as const;

const ServoFields = ({ profile, onChange }: EbbFieldsProps) => (
  <fieldset className="subgroup">
    <legend>{words.servo}</legend>
    <ServoPin profile={profile} onChange={onChange} />
    <div className="field-pair">
      {SERVO_ENDS.map(([key, label]) => (
        <NumberField
          key={key}
          label={label}
          value={profile.controller[key]}
          unit=""
          min={1}
          max={65_535}
          step={100}
          onChange={(pos) => onChange(withController(profile, { [key]: Math.round(pos) }))}
        />
      ))}
    </div>
    <p className="note">{words.servoHint}</p>
  </fieldset>
);

export const ServoPin = ({ profile, onChange }: EbbFieldsProps) => (
  <Segments
    label={words.servoPin}
    value={String(profile.controller.servoPin) as "4" | "5"}
    options={[
      { value: "4", label: words.standardServo },
      { value: "5", label: words.brushlessServo },
    ]}
    onChange={(pin) => onChange(withController(profile, { servoPin: pin === "4" ? 4 : 5 }))}
  />
);

type HomingInput = NonNullable<EbbController["homing"]>["x"];
const PORTS: readonly HomingInput["port"][] = ["A", "B", "C", "D", "E"];
const FIRST_SWITCHES: NonNullable<EbbController["homing"]> = {
  x: { port: "B", pin: 0, pressed: 0 },
  y: { port: "B", pin: 2, pressed: 0 },
};

const CORNER_SWITCH: HomingInput = { port: "B", pin: 1, pressed: 1 };

const HomingFields = ({ profile, onChange }: EbbFieldsProps) => {
  const { homing, cornerSwitch } = profile.controller;
  return (
    <fieldset className="subgroup">
      <legend>{words.homing}</legend>
      <Switch
        label={words.hasSwitches}
        isOn={Boolean(homing)}
        onChange={(isOn) =>
          onChange(withController(profile, { homing: isOn ? FIRST_SWITCHES : null, cornerSwitch: null }))
        }
      />
      <Switch
        label={words.hasCornerSwitch}
        isOn={Boolean(cornerSwitch)}
        onChange={(isOn) =>
          onChange(withController(profile, { cornerSwitch: isOn ? CORNER_SWITCH : null, homing: null }))
        }
      />
      {cornerSwitch && (
        <SwitchFields
          label={words.cornerSwitch}
          input={cornerSwitch}
          onChange={(input) => onChange(withController(profile, { cornerSwitch: input }))}
        />
      )}
      {homing &&
        (["x", "y"] as const).map((axis) => (
          <SwitchFields
            key={axis}
            label={words.switchAt(axis)}
            input={homing[axis]}
            onChange={(input) => onChange(withController(profile, { homing: { ...homing, [axis]: input } }))}
          />
        ))}
    </fieldset>
  );
};

interface SwitchFieldsProps {
  readonly label: string;
  readonly input: HomingInput;
  onChange(input: HomingInput): void;
}

const SwitchFields = ({ label, input, onChange }: SwitchFieldsProps) => (
  <div className="switch-fields" role="group" aria-label={label}>
    <span>{label}</span>
    <Select
      label={words.port}
      value={input.port}
      options={PORTS.map((port) => ({ value: port, label: port }))}
      onChange={(port) => onChange({ ...input, port })}
    />
    <Select
      label={words.pin}
      value={String(input.pin)}
      options={Array.from({ length: 8 }, (_, pin) => ({ value: String(pin), label: String(pin) }))}
      onChange={(pin) => onChange({ ...input, pin: Number(pin) })}
    />
    <Select
      label={words.pressed}
      value={String(input.pressed) as "0" | "1"}
      options={[
        { value: "0", label: "0" },
        { value: "1", label: "1" },
      ]}
      onChange={(pressed) => onChange({ ...input, pressed: pressed === "1" ? 1 : 0 })}
    />
  </div>
);
