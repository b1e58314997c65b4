import { DROP_RATE, HOP_TABLE, PEN_TABLE, type NumberSetting } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { isReady } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { heightsText } from "./text.js";
import { Switch } from "../ui/choice.js";
import { SettingField } from "../ui/setting-field.js";

const words = heightsText;
type PenSettings = PlotSettings["pen"];

/** A hop is lifted by this share of the full lift when it is switched on. */
const FIRST_HOP_SHARE = 0.4;

/** Heights, waits and refinements of the pen. */
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
      <HeightField
        setting={PEN_TABLE.upPct}
        tryLabel={words.tryUp}
        value={pen.upPct}
        isUp
        onChange={(upPct) => change({ upPct })}
      />
      <HeightField
        setting={PEN_TABLE.downPct}
        tryLabel={words.tryDown}
        value={pen.downPct}
        isUp={false}
        onChange={(downPct) => change({ downPct })}
      />
      <p className="note">{words.heightHint}</p>
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
      <Hop pen={pen} change={change} />
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

const Hop = ({ pen: { hop, upPct, downPct }, change }: RefinementProps) => (
  <>
    <Switch
      label={words.hop}
      isOn={Boolean(hop)}
      onChange={(isOn) => {
        const firstPct = Math.round(downPct + (upPct - downPct) * FIRST_HOP_SHARE);
        change({ hop: isOn ? { longestMm: HOP_TABLE.longestMm.default, upPct: firstPct } : null });
      }}
    />
    {hop && (
      <div className="field-pair">
        <SettingField
          setting={HOP_TABLE.longestMm}
          value={hop.longestMm}
          onChange={(longestMm) => change({ hop: { ...hop, longestMm } })}
        />
        <SettingField
          setting={HOP_TABLE.upPct}
          value={hop.upPct}
          onChange={(hopPct) => change({ hop: { ...hop, upPct: hopPct } })}
        />
      </div>
    )}
  </>
);

interface HeightFieldProps {
  readonly setting: NumberSetting;
  readonly tryLabel: string;
  readonly value: number;
  readonly isUp: boolean;
  onChange(value: number): void;
}

const HeightField = ({ setting, tryLabel, value, isUp, onChange }: HeightFieldProps) => {
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
        onClick={() => void movePen(isUp, value)}
      >
        {words.try}
      </button>
    </div>
  );
};
