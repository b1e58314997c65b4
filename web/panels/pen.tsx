import type { PenSettings } from "../../src/index.js";
import { currentPlotter } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { text } from "../text/text.js";
import { formatNumber } from "../ui/format.js";
import { NumberField } from "../ui/number-field.js";
import { SettingsGroup } from "./settings-group.js";

const words = text.pen;

export const PenPanel = () => {
  const pen = usePageState((state) => state.settings.pen);
  const { changeSettings } = useActions();
  const change = (part: Partial<PenSettings>): void =>
    changeSettings(`pen ${Object.keys(part).join()}`, (settings) => ({
      ...settings,
      pen: { ...settings.pen, ...part },
    }));
  return (
    <SettingsGroup
      id="pen"
      title={words.title}
      summary={`${formatNumber(pen.upPct)} / ${formatNumber(pen.downPct)} %`}
    >
      <HeightField
        label={words.up}
        tryLabel={words.tryUp}
        value={pen.upPct}
        isUp
        onChange={(upPct) => change({ upPct })}
      />
      <HeightField
        label={words.down}
        tryLabel={words.tryDown}
        value={pen.downPct}
        isUp={false}
        onChange={(downPct) => change({ downPct })}
      />
      <p className="note">{words.heightHint}</p>
      <div className="field-pair">
        <NumberField
          label={words.lift}
          value={pen.liftMs}
          unit="ms"
          min={0}
          max={10_000}
          step={10}
          onChange={(liftMs) => change({ liftMs })}
        />
        <NumberField
          label={words.drop}
          value={pen.dropMs}
          unit="ms"
          min={0}
          max={10_000}
          step={10}
          onChange={(dropMs) => change({ dropMs })}
        />
      </div>
    </SettingsGroup>
  );
};

interface HeightFieldProps {
  readonly label: string;
  readonly tryLabel: string;
  readonly value: number;
  readonly isUp: boolean;
  onChange(value: number): void;
}

const HeightField = ({ label, tryLabel, value, isUp, onChange }: HeightFieldProps) => {
  const isIdle = usePageState((state) => currentPlotter(state)?.connection === "idle");
  const { movePen } = useActions();
  return (
    <div className="field-with-button">
      <NumberField
        label={label}
        value={value}
        unit="%"
        min={0}
        max={100}
        step={1}
        slider={[0, 100]}
        onChange={onChange}
      />
      <button
        type="button"
        className="button"
        aria-label={tryLabel}
        disabled={!isIdle}
        onClick={() => void movePen(isUp, value)}
      >
        {words.try}
      </button>
    </div>
  );
};
