import { DROP_RATE, OVERLAP_TABLE, PEN_TABLE } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { useIsUsed } from "../state/used-settings.js";
import { usePageState } from "../state/use-store.js";
import { PenSheet } from "./pen-sheet.js";
import { heightsText as words } from "./text.js";
import { Segments, Switch } from "../ui/fields/choice.js";
import { SettingField } from "../ui/fields/setting-field.js";
import { usePenChange } from "../ui/use-change.js";

type PenSettings = PlotSettings["pen"];

/** Settings for lifting and lowering the pen. Its heights are in the plotter's panel. */
export const PenFields = () => {
  const pen = usePageState((state) => state.settings.pen);
  const change = usePenChange();
  const isGentleUsed = useIsUsed("pen.dropPctPerS");
  const isOverlapUsed = useIsUsed("pen.overlap");
  return (
    <>
      <div className="field-pair">
        <SettingField
          setting={PEN_TABLE.extraLiftMs}
          value={pen.extraLiftMs}
          onChange={(extraLiftMs) => change({ extraLiftMs })}
        />
        <SettingField
          setting={PEN_TABLE.extraDropMs}
          value={pen.extraDropMs}
          onChange={(extraDropMs) => change({ extraDropMs })}
        />
      </div>
      <PenSheet />
      {isGentleUsed && <Gentle pen={pen} />}
      {isOverlapUsed && <Overlap pen={pen} />}
    </>
  );
};

const Gentle = ({ pen: { dropPctPerS } }: { pen: PenSettings }) => {
  const change = usePenChange();
  return (
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
};

const Overlap = ({ pen: { overlap, fullHeightMm } }: { pen: PenSettings }) => {
  const change = usePenChange();
  const [, hint] = words.overlaps[overlap];
  return (
    <>
      <Segments
        label={OVERLAP_TABLE.overlap.label}
        value={overlap}
        options={OVERLAP_TABLE.overlap.choices.map((value) => ({ value, label: words.overlaps[value][0] }))}
        onChange={(value) => change({ overlap: value })}
      />
      <p className="note">{overlap === "off" ? hint : `${hint} ${words.whereTouches}`}</p>
      {overlap !== "off" && (
        <SettingField
          setting={OVERLAP_TABLE.fullHeightMm}
          value={fullHeightMm}
          onChange={(value) => change({ fullHeightMm: value })}
        />
      )}
    </>
  );
};
