import type { MotionLimits, MotionMode } from "../../src/index.js";
import { useActions, usePageState } from "../state/use-store.js";
import { text } from "../text/text.js";
import { formatNumber } from "../ui/format.js";
import { NumberField } from "../ui/number-field.js";
import { SettingsGroup } from "./settings-group.js";

const words = text.motion;

type Limits = "draw" | "travel";

/** Ranges in everyday use, for the sliders; the fields take everything that the schema takes. */
const EVERYDAY = {
  draw: { speed: [5, 200], accel: [50, 3_000] },
  travel: { speed: [10, 400], accel: [50, 5_000] },
} as const;

export const MotionPanel = () => {
  const motion = usePageState((state) => state.settings.motion);
  return (
    <SettingsGroup id="motion" title={words.title} summary={`${formatNumber(motion.draw.speedMmPerS)} mm/s`}>
      <LimitFields which="draw" title={words.drawing} limits={motion.draw} mode={motion.mode} />
      <LimitFields which="travel" title={words.travelling} limits={motion.travel} mode={motion.mode} />
    </SettingsGroup>
  );
};

interface LimitFieldsProps {
  readonly which: Limits;
  readonly title: string;
  readonly limits: MotionLimits;
  readonly mode: MotionMode;
}

const LimitFields = ({ which, title, limits }: LimitFieldsProps) => {
  const { changeSettings } = useActions();
  const change = (part: Partial<MotionLimits>): void =>
    changeSettings(`${which} ${Object.keys(part).join()}`, (settings) => ({
      ...settings,
      motion: { ...settings.motion, [which]: { ...settings.motion[which], ...part } },
    }));
  return (
    <fieldset className="subgroup">
      <legend>{title}</legend>
      <NumberField
        label={words.speed}
        value={limits.speedMmPerS}
        unit="mm/s"
        min={0.1}
        max={1_000}
        step={1}
        slider={EVERYDAY[which].speed}
        onChange={(speedMmPerS) => change({ speedMmPerS })}
      />
      <NumberField
        label={words.accel}
        value={limits.accelMmPerS2}
        unit="mm/s²"
        min={1}
        max={50_000}
        step={10}
        slider={EVERYDAY[which].accel}
        onChange={(accelMmPerS2) => change({ accelMmPerS2 })}
      />
      {which === "draw" && (
        <NumberField
          label={words.corner}
          value={limits.cornerMm}
          unit="mm"
          min={0.001}
          max={10}
          step={0.01}
          digits={3}
          slider={[0.01, 0.5]}
          hint={words.cornerHint}
          onChange={(cornerMm) => change({ cornerMm })}
        />
      )}
    </fieldset>
  );
};
