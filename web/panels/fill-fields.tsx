import { usePageState } from "../state/use-store.js";
import { setup } from "../text/setup.js";
import { Switch } from "../ui/choice.js";
import { NumberField } from "../ui/number-field.js";
import { usePrepareChange } from "./paper.js";

const words = setup.fill;
const FIRST_SPACING_MM = 0.6;

/** Filled shapes: shaded with lines, outlined, covering what lies under them. */
export const FillFields = () => {
  const { hatch, outlineFills, hideCovered } = usePageState((state) => state.settings.prepare);
  const change = usePrepareChange();
  const isOn = hatch.spacingMm > 0;
  return (
    <>
      <Switch
        label={words.switch}
        isOn={isOn}
        onChange={(on) => change("hatch", { hatch: { ...hatch, spacingMm: on ? FIRST_SPACING_MM : 0 } })}
      />
      {isOn && (
        <>
          <NumberField
            label={words.spacing}
            value={hatch.spacingMm}
            unit="mm"
            min={0.05}
            max={100}
            step={0.05}
            slider={[0.1, 5]}
            hint={words.spacingHint}
            onChange={(spacingMm) => change("hatch spacing", { hatch: { ...hatch, spacingMm } })}
          />
          <NumberField
            label={words.angle}
            value={hatch.angleDeg}
            unit="°"
            min={-360}
            max={360}
            step={5}
            slider={[0, 180]}
            onChange={(angleDeg) => change("hatch angle", { hatch: { ...hatch, angleDeg } })}
          />
          <Switch
            label={words.cross}
            isOn={hatch.cross}
            onChange={(cross) => change("hatch cross", { hatch: { ...hatch, cross } })}
          />
        </>
      )}
      <Switch
        label={words.outline}
        isOn={outlineFills}
        onChange={(on) => change("outline", { outlineFills: on })}
      />
      <Switch label={words.hide} isOn={hideCovered} onChange={(on) => change("hide", { hideCovered: on })} />
    </>
  );
};
