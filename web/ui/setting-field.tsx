import type { NumberSetting } from "../../src/internal.js";
import { NumberField } from "./number-field.js";

interface SettingFieldProps {
  readonly setting: NumberSetting;
  readonly value: number;
  readonly hint?: string;
  /** Where the range depends on other settings. */
  readonly max?: number;
  onChange(value: number): void;
  /** Besides, while the slider is dragged. */
  onSlide?(value: number): void;
}

/** A number of the settings tables: label, range, unit and step come from there. */
export const SettingField = ({ setting, max, value, hint, onChange, onSlide }: SettingFieldProps) => (
  <NumberField
    label={setting.label}
    value={value}
    unit={setting.unit}
    min={setting.min}
    minExcluded={setting.minExcluded}
    max={max ?? setting.max}
    step={setting.step}
    {...(setting.digits === undefined ? {} : { digits: setting.digits })}
    {...(setting.slider === undefined ? {} : { slider: setting.slider })}
    {...(hint === undefined ? {} : { hint })}
    {...(onSlide === undefined ? {} : { onSlide })}
    onChange={(typed) => onChange(setting.isWhole ? Math.round(typed) : typed)}
  />
);
