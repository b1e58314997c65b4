import { useId } from "react";
import { DEFAULT_FIT, MOTION_MODES, type MotionLimits, type MotionMode } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { useActions, usePageState } from "../state/use-store.js";
import { text } from "../text/text.js";
import { Switch } from "../ui/choice.js";
import { formatNumber } from "../ui/format.js";
import { NumberField } from "../ui/number-field.js";
import { CornerPicture } from "./corner-picture.js";
import { SettingsGroup } from "./settings-group.js";

const words = text.motion;
type MotionSettings = PlotSettings["motion"];

/** Ranges in everyday use, for the sliders; the fields take everything that the schema takes. */
const EVERYDAY = {
  draw: { speed: [5, 200], accel: [50, 3_000] },
  travel: { speed: [10, 400], accel: [50, 5_000] },
} as const;
/** Where slow-in begins when it is switched on. */
const FIRST_EASE = { lengthMm: 1.5, speedMmPerS: 10 };

const useMotionChange = () => {
  const { changeSettings } = useActions();
  return (what: string, change: Partial<MotionSettings>): void =>
    changeSettings(`motion ${what}`, (settings) => ({
      ...settings,
      motion: { ...settings.motion, ...change },
    }));
};

export const MotionPanel = () => {
  const motion = usePageState((state) => state.settings.motion);
  return (
    <SettingsGroup id="motion" title={words.title} summary={`${formatNumber(motion.draw.speedMmPerS)} mm/s`}>
      <LimitFields which="draw" title={words.drawing} limits={motion.draw} mode={motion.mode} />
      <ModeChoice mode={motion.mode} />
      <LimitFields which="travel" title={words.travelling} limits={motion.travel} mode={motion.mode} />
      <Refinements motion={motion} />
      <SendAhead />
    </SettingsGroup>
  );
};

const ModeChoice = ({ mode }: { mode: MotionMode }) => {
  const name = useId();
  const change = useMotionChange();
  return (
    <fieldset className="subgroup">
      <legend>{words.mode}</legend>
      <div className="mode-choice">
        {MOTION_MODES.map((value) => (
          <label key={value} className="mode-option">
            <input
              type="radio"
              name={name}
              checked={value === mode}
              onChange={() => change("mode", { mode: value })}
            />
            <span>
              <CornerPicture mode={value} />
              {words.modes[value].name}
            </span>
          </label>
        ))}
      </div>
      <p className="note">{words.modes[mode].hint}</p>
    </fieldset>
  );
};

interface LimitFieldsProps {
  readonly which: "draw" | "travel";
  readonly title: string;
  readonly limits: MotionLimits;
  readonly mode: MotionMode;
}

const LimitFields = ({ which, title, limits, mode }: LimitFieldsProps) => {
  const changeMotion = useMotionChange();
  const change = (part: Partial<MotionLimits>): void =>
    changeMotion(`${which} ${Object.keys(part).join()}`, { [which]: { ...limits, ...part } });
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
      {mode === "scurve" && (
        <NumberField
          label={words.jerk}
          value={limits.jerkMmPerS3}
          unit="mm/s³"
          min={1}
          max={10_000_000}
          step={500}
          slider={[1_000, 100_000]}
          hint={words.jerkHint}
          onChange={(jerkMmPerS3) => change({ jerkMmPerS3 })}
        />
      )}
    </fieldset>
  );
};

const SendAhead = () => {
  const sendAheadMs = usePageState((state) => state.settings.sendAheadMs);
  const { changeSettings } = useActions();
  return (
    <NumberField
      label={words.sendAhead}
      value={sendAheadMs}
      unit="ms"
      min={100}
      max={1_000}
      step={50}
      hint={words.sendAheadHint}
      onChange={(value) =>
        changeSettings("send ahead", (settings) => ({ ...settings, sendAheadMs: Math.round(value) }))
      }
    />
  );
};

const Refinements = ({ motion }: { motion: MotionSettings }) => {
  const change = useMotionChange();
  const { ease, fit } = motion;
  return (
    <div className="subgroup refinements">
      <Switch
        label={words.ease}
        isOn={Boolean(ease)}
        onChange={(isOn) => change("ease", { ease: isOn ? FIRST_EASE : null })}
      />
      {ease && (
        <div className="field-pair">
          <NumberField
            label={words.easeLength}
            value={ease.lengthMm}
            unit="mm"
            min={0.1}
            max={100}
            step={0.5}
            onChange={(lengthMm) => change("ease length", { ease: { ...ease, lengthMm } })}
          />
          <NumberField
            label={words.easeSpeed}
            value={ease.speedMmPerS}
            unit="mm/s"
            min={0.1}
            max={1_000}
            step={1}
            onChange={(speedMmPerS) => change("ease speed", { ease: { ...ease, speedMmPerS } })}
          />
        </div>
      )}
      <Switch
        label={words.fit}
        isOn={Boolean(fit)}
        onChange={(isOn) => change("fit", { fit: isOn ? DEFAULT_FIT : null })}
      />
      {fit && (
        <NumberField
          label={words.fitTolerance}
          value={fit.toleranceMm}
          unit="mm"
          min={0.001}
          max={1}
          step={0.005}
          digits={3}
          hint={words.fitHint}
          onChange={(toleranceMm) => change("fit tolerance", { fit: { ...fit, toleranceMm } })}
        />
      )}
    </div>
  );
};
