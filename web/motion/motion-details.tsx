import { useId } from "react";
import {
  AXIS_TABLE,
  CORNER_RULES,
  DRAW_TABLE,
  EASE_TABLE,
  FIT_TABLE,
  STREAM_TABLE,
  TRAVEL_TABLE,
  DEFAULT_FIT,
  MOTION_MODES,
  SHAPERS,
  type MotionLimits,
  type MotionMode,
  type Shaper,
} from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { useIsUsed } from "../state/used-settings.js";
import { useActions, usePageState } from "../state/use-store.js";
import { detailsText as words } from "./details-text.js";
import { Select, Switch } from "../ui/fields/choice.js";
import { OwnNumber } from "../ui/fields/own-number.js";
import { SettingField } from "../ui/fields/setting-field.js";
import { useMotionChange } from "../ui/use-change.js";
import { CornerPicture } from "./corner-picture.js";
import { useSprings } from "./use-springs.js";
import "./motion-details.css";

type MotionSettings = PlotSettings["motion"];

/** The first values when this is switched on. */
const FIRST_EASE = { lengthMm: EASE_TABLE.lengthMm.default, speedMmPerS: EASE_TABLE.speedMmPerS.default };

/** The numbers that a quality sets, and those that it does not change. */
export const MotionDetails = () => {
  const motion = usePageState((state) => state.settings.motion);
  const isPlannedHere = useIsUsed("motion.mode");
  return (
    <>
      {!isPlannedHere && <p className="note">{words.plannedByController}</p>}
      <LimitFields which="draw" title={words.drawing} limits={motion.draw} mode={motion.mode} />
      <LimitFields which="travel" title={words.travelling} limits={motion.travel} mode={motion.mode} />
      <AxisLimitFields motion={motion} />
      {isPlannedHere && (
        <>
          <ShaperSelect motion={motion} />
          <ModeChoice mode={motion.mode} />
        </>
      )}
      <Refinements motion={motion} />
      <SendAhead />
    </>
  );
};

/** Only shown for a measured machine, because shaping needs its frequencies. */
const ShaperSelect = ({ motion }: { motion: MotionSettings }) => {
  const springs = useSprings();
  const change = useMotionChange();
  if (springs === null) return null;
  const choose = (chosen: Shaper): void => {
    const mode = chosen !== "none" && motion.mode === "scurve" ? "blend" : motion.mode;
    change("shaper", { shaper: chosen, mode });
  };
  return (
    <Select
      label={words.shaper}
      value={motion.shaper ?? "none"}
      options={SHAPERS.map((value) => ({ value, label: words.shapers[value] }))}
      onChange={choose}
    />
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
              // The scurve mode is a filter too, and a motion has only one.
              onChange={() =>
                change("mode", value === "scurve" ? { mode: value, shaper: "none" } : { mode: value })
              }
            />
            <span>
              <CornerPicture mode={value} />
              {CORNER_RULES[value].label}
            </span>
          </label>
        ))}
      </div>
      <p className="note">{CORNER_RULES[mode].hint}</p>
    </fieldset>
  );
};

const LIMIT_HINTS: { readonly [K in keyof MotionLimits]?: string } = {
  cornerMm: words.cornerHint,
  jerkMmPerS3: words.jerkHint,
};

interface LimitFieldsProps {
  readonly which: "draw" | "travel";
  readonly title: string;
  readonly limits: MotionLimits;
  readonly mode: MotionMode;
}

const LimitFields = ({ which, title, limits, mode }: LimitFieldsProps) => {
  const changeMotion = useMotionChange();
  const table = which === "draw" ? DRAW_TABLE : TRAVEL_TABLE;
  const isPlannedHere = useIsUsed("motion.mode");
  const own: readonly (keyof MotionLimits)[] = [
    "accelMmPerS2",
    ...(which === "draw" ? (["cornerMm"] as const) : []),
    ...(mode === "scurve" ? (["jerkMmPerS3"] as const) : []),
  ];
  const keys: readonly (keyof MotionLimits)[] = ["speedMmPerS", ...(isPlannedHere ? own : [])];
  return (
    <fieldset className="subgroup">
      <legend>{title}</legend>
      {keys.map((key) => (
        <SettingField
          key={key}
          setting={table[key]}
          value={limits[key]}
          hint={LIMIT_HINTS[key]}
          onChange={(value) => changeMotion(`${which} ${key}`, { [which]: { ...limits, [key]: value } })}
        />
      ))}
    </fieldset>
  );
};

const AXIS_KEYS = Object.keys(AXIS_TABLE) as (keyof typeof AXIS_TABLE)[];

/** For a machine that is heavier along one axis; an empty field is no limit besides those above. */
const AxisLimitFields = ({ motion }: { motion: MotionSettings }) => (
  <fieldset className="subgroup">
    <legend>{words.axes}</legend>
    {AXIS_KEYS.map((key) => (
      <AxisLimitField key={key} which={key} value={motion[key] ?? null} />
    ))}
    <p className="note">{words.axesHint}</p>
  </fieldset>
);

interface AxisLimitFieldProps {
  readonly which: (typeof AXIS_KEYS)[number];
  readonly value: number | null;
}

const AxisLimitField = ({ which, value }: AxisLimitFieldProps) => {
  const isAxisUsed = useIsUsed(`motion.${which}`);
  const change = useMotionChange();
  if (!isAxisUsed) return null;
  return (
    <OwnNumber
      {...AXIS_TABLE[which]}
      value={value}
      inherited={null}
      resetLabel={words.noLimit(AXIS_TABLE[which].label)}
      onChange={(next) => change(which, { [which]: next })}
    />
  );
};

const SendAhead = () => {
  const sendAheadMs = usePageState((state) => state.settings.sendAheadMs);
  const { changeSettings } = useActions();
  if (!useIsUsed("sendAheadMs")) return null;
  return (
    <SettingField
      setting={STREAM_TABLE.sendAheadMs}
      value={sendAheadMs}
      hint={words.sendAheadHint}
      onChange={(value) => changeSettings("send ahead", (settings) => ({ ...settings, sendAheadMs: value }))}
    />
  );
};

const Refinements = ({ motion }: { motion: MotionSettings }) => {
  const change = useMotionChange();
  const isFitUsed = useIsUsed("motion.fit.toleranceMm");
  const { ease, fit } = motion;
  return (
    <div className="subgroup">
      <Switch
        label={words.ease}
        isOn={Boolean(ease)}
        onChange={(isOn) => change("ease", { ease: isOn ? FIRST_EASE : null })}
      />
      {ease && (
        <div className="field-pair">
          <SettingField
            setting={EASE_TABLE.lengthMm}
            value={ease.lengthMm}
            onChange={(lengthMm) => change("ease length", { ease: { ...ease, lengthMm } })}
          />
          <SettingField
            setting={EASE_TABLE.speedMmPerS}
            value={ease.speedMmPerS}
            onChange={(speedMmPerS) => change("ease speed", { ease: { ...ease, speedMmPerS } })}
          />
        </div>
      )}
      {isFitUsed && (
        <Switch
          label={words.fit}
          isOn={Boolean(fit)}
          onChange={(isOn) => change("fit", { fit: isOn ? DEFAULT_FIT : null })}
        />
      )}
      {isFitUsed && fit && (
        <SettingField
          setting={FIT_TABLE.toleranceMm}
          value={fit.toleranceMm}
          hint={words.fitHint}
          onChange={(toleranceMm) => change("fit tolerance", { fit: { ...fit, toleranceMm } })}
        />
      )}
    </div>
  );
};
