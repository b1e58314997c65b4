import type { NumberSetting } from "../../../src/internal.js";
import { NumberField } from "./number-field.js";

interface SettingFieldProps {
  readonly setting: NumberSetting;
  readonly value: number;
  readonly hint?: string | undefined;
  /** For a range that depends on other settings. */
  readonly max?: number;
  onChange(value: number): void;
  /** Called in addition while the slider is dragged. */
  onSlide?(value: number): void;
}

/** A field for a number of the settings tables, which have its label, range, unit and step. */
export const SettingField = ({ setting, max, value, hint, onChange, onSlide }: SettingFieldProps) => (
  <NumberField
    label={setting.label}
    value={value}
    unit={setting.unit}
    min={setting.min}
    minExcluded={setting.minExcluded}
    max={max ?? setting.max}
    step={setting.step}
    digits={setting.digits}
    slider={setting.slider}
    hint={hint}
    onSlide={onSlide}
    onChange={(typed) => onChange(setting.isWhole ? Math.round(typed) : typed)}
  />
);
