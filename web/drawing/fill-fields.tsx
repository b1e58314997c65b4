import { HATCH_TABLE, PREPARE_TABLE } from "../../src/internal.js";
import { usePageState } from "../state/use-store.js";
import { fillText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { Switch } from "../ui/fields/choice.js";
import { SettingField } from "../ui/fields/setting-field.js";
import { usePrepareChange } from "../ui/use-change.js";

export const FIRST_SPACING_MM = 0.6;

/** Filled shapes: hatch them, outline them, hide what they cover. */
export const FillFields = () => {
  const { hatch, hatchOutlines, outlineFills, hideCovered } = usePageState((state) => state.settings.prepare);
  const change = usePrepareChange();
  const isOn = hatch.spacingMm > 0;
  return (
    <>
      <Switch
        label={words.switch}
        isOn={isOn}
        onChange={(on) => change("hatch", { hatch: { ...hatch, spacingMm: on ? FIRST_SPACING_MM : 0 } })}
      />
      {isOn && !hatchOutlines && <NothingToFill />}
      {isOn && (
        <>
          <SettingField
            setting={HATCH_TABLE.spacingMm}
            value={hatch.spacingMm}
            hint={words.spacingHint}
            onChange={(spacingMm) => change("hatch spacing", { hatch: { ...hatch, spacingMm } })}
          />
          <SettingField
            setting={HATCH_TABLE.angleDeg}
            value={hatch.angleDeg}
            onChange={(angleDeg) => change("hatch angle", { hatch: { ...hatch, angleDeg } })}
          />
          <Switch
            label={HATCH_TABLE.cross.label}
            isOn={hatch.cross}
            onChange={(cross) => change("hatch cross", { hatch: { ...hatch, cross } })}
          />
          <Switch
            label={PREPARE_TABLE.hatchOutlines.label}
            isOn={hatchOutlines}
            onChange={(on) => change("hatch outlines", { hatchOutlines: on })}
          />
        </>
      )}
      <Switch
        label={PREPARE_TABLE.outlineFills.label}
        isOn={outlineFills}
        onChange={(on) => change("outline", { outlineFills: on })}
      />
      <Switch
        label={PREPARE_TABLE.hideCovered.label}
        isOn={hideCovered}
        onChange={(on) => change("hide", { hideCovered: on })}
      />
    </>
  );
};

/** Shown for a drawing that has only lines. */
const NothingToFill = () => {
  const isEmpty = usePageState((state) => state.planned?.fillCount === 0);
  const change = usePrepareChange();
  if (!isEmpty) return null;
  return (
    <>
      <p className="note note-error" role="status">
        {words.nothingToFill}
      </p>
      <Button onClick={() => change("hatch outlines", { hatchOutlines: true })}>{words.fillOutlines}</Button>
    </>
  );
};
