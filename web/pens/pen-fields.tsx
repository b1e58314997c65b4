import { DROP_RATE, OVERLAP_TABLE, PEN_TABLE, type NumberSetting } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { isReady } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { heightsText } from "./text.js";
import { Segments, Switch } from "../ui/choice.js";
import { SettingField } from "../ui/setting-field.js";

const words = heightsText;
type PenSettings = PlotSettings["pen"];

/** Waits and refinements of the pen; its heights are in the plotter's panel. */
export const PenFields = () => {
  const pen = usePageState((state) => state.settings.pen);
  const { changeSettings } = useActions();
  const change = (part: Partial<PenSettings>): void =>
    changeSettings(`pen ${Object.keys(part).join()}`, (settings) => ({
      ...settings,
      pen: { ...settings.pen, ...part },
    }));
  return (
    <>
      <div className="field-pair">
        <SettingField
          setting={PEN_TABLE.liftMs}
          value={pen.liftMs}
          onChange={(liftMs) => change({ liftMs })}
        />
        <SettingField
          setting={PEN_TABLE.dropMs}
          value={pen.dropMs}
          onChange={(dropMs) => change({ dropMs })}
        />
      </div>
      <Gentle pen={pen} change={change} />
      <Overlap pen={pen} change={change} />
    </>
  );
};

interface RefinementProps {
  readonly pen: PenSettings;
  change(part: Partial<PenSettings>): void;
}

const Gentle = ({ pen: { dropPctPerS }, change }: RefinementProps) => (
  <>
    <Switch
      label={words.gentle}
      isOn={Boolean(dropPctPerS)}
      onChange={(isOn) => change({ dropPctPerS: isOn ? DROP_RATE.default : null })}
    />
    {dropPctPerS && (
      <SettingField
        setting={DROP_RATE}
        value={dropPctPerS}
        onChange={(rate) => change({ dropPctPerS: rate })}
      />
    )}
  </>
);

const Overlap = ({ pen, change }: RefinementProps) => {
  const { overlap, contactPct, fullHeightMm, upPct, downPct } = pen;
  return (
    <>
      <Segments
        label={OVERLAP_TABLE.overlap.label}
        value={overlap}
        options={OVERLAP_TABLE.overlap.choices.map((value) => ({ value, label: words.overlaps[value] }))}
        onChange={(value) => change({ overlap: value })}
      />
      {overlap !== "off" && (
        <>
          <HeightField
            setting={OVERLAP_TABLE.contactPct}
            tryLabel={words.tryContact}
            value={contactPct}
            heightPct={downPct + ((upPct - downPct) * contactPct) / 100}
            isUp={false}
            onChange={(value) => change({ contactPct: value })}
          />
          <p className="note">{words.contactHint}</p>
          <SettingField
            setting={OVERLAP_TABLE.fullHeightMm}
            value={fullHeightMm}
            onChange={(value) => change({ fullHeightMm: value })}
          />
        </>
      )}
    </>
  );
};

interface HeightFieldProps {
  readonly setting: NumberSetting;
  readonly tryLabel: string;
  readonly value: number;
  readonly isUp: boolean;
  /** The height to try, if it is not the value itself. */
  readonly heightPct?: number;
  onChange(value: number): void;
}

const HeightField = ({ setting, tryLabel, value, heightPct = value, isUp, onChange }: HeightFieldProps) => {
  const isIdle = usePageState(isReady);
  const { movePen } = useActions();
  return (
    <div className="field-with-button">
      <SettingField setting={setting} value={value} onChange={onChange} />
      <button
        type="button"
        className="button"
        aria-label={tryLabel}
        disabled={!isIdle}
        onClick={() => void movePen(isUp, heightPct)}
      >
        {words.try}
      </button>
    </div>
  );
};
