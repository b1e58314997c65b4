import type { PlotSettings } from "../../src/schema/index.js";
import { isReady } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { setup } from "../text/setup.js";
import { Switch } from "../ui/choice.js";
import { NumberField } from "../ui/number-field.js";

const words = setup.pen;
type PenSettings = PlotSettings["pen"];

/** What the refinements begin with when they are switched on. */
const FIRST_DROP_PCT_PER_S = 60;
const FIRST_HOP = { longestMm: 3, heightShare: 0.4 };

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
      onChange={(isOn) => change({ dropPctPerS: isOn ? FIRST_DROP_PCT_PER_S : null })}
    />
    {dropPctPerS && (
      <NumberField
        label={words.gentleRate}
        value={dropPctPerS}
        unit="%/s"
        min={1}
        max={10_000}
        step={5}
        slider={[10, 400]}
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
        const firstPct = Math.round(downPct + (upPct - downPct) * FIRST_HOP.heightShare);
        change({ hop: isOn ? { longestMm: FIRST_HOP.longestMm, upPct: firstPct } : null });
      }}
    />
    {hop && (
      <div className="field-pair">
        <NumberField
          label={words.hopLongest}
          value={hop.longestMm}
          unit="mm"
          min={0.1}
          max={1_000}
          step={0.5}
          onChange={(longestMm) => change({ hop: { ...hop, longestMm } })}
        />
        <NumberField
          label={words.hopHeight}
          value={hop.upPct}
          unit="%"
          min={0}
          max={100}
          step={1}
          onChange={(hopPct) => change({ hop: { ...hop, upPct: hopPct } })}
        />
      </div>
    )}
  </>
);

interface HeightFieldProps {
  readonly label: string;
  readonly tryLabel: string;
  readonly value: number;
  readonly isUp: boolean;
  onChange(value: number): void;
}

const HeightField = ({ label, tryLabel, value, isUp, onChange }: HeightFieldProps) => {
  const isIdle = usePageState(isReady);
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
