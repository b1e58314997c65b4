import { DROP_RATE, HOP_TABLE, PEN_TABLE } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { useActions, usePageState } from "../state/use-store.js";
import { heightsText } from "./text.js";
import { Switch } from "../ui/choice.js";
import { SettingField } from "../ui/setting-field.js";

const words = heightsText;
type PenSettings = PlotSettings["pen"];

/** A hop is lifted by this share of the full lift when it is switched on. */
const FIRST_HOP_SHARE = 0.4;

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
