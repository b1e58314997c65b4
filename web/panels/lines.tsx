import { usePageState } from "../state/use-store.js";
import { text } from "../text/text.js";
import { Segments } from "../ui/choice.js";
import { NumberField } from "../ui/number-field.js";
import { usePrepareChange } from "./paper.js";
import { SettingsGroup } from "./settings-group.js";

const words = text.lines;

export const LinesPanel = () => {
  const prepare = usePageState((state) => state.settings.prepare);
  const change = usePrepareChange();
  return (
    <SettingsGroup id="lines" title={words.title}>
      <Segments
        label={words.order}
        value={prepare.order}
        options={[
          { value: "none", label: words.orderNone },
          { value: "fast", label: words.orderFast },
          { value: "best", label: words.orderBest },
        ]}
        onChange={(order) => change("order", { order })}
      />
      <NumberField
        label={words.join}
        value={prepare.joinMm}
        unit="mm"
        min={0}
        max={50}
        step={0.05}
        digits={3}
        onChange={(joinMm) => change("join", { joinMm })}
      />
      <NumberField
        label={words.drop}
        value={prepare.dropShorterMm}
        unit="mm"
        min={0}
        max={1_000}
        step={0.1}
        digits={3}
        onChange={(dropShorterMm) => change("drop", { dropShorterMm })}
      />
      <NumberField
        label={words.simplify}
        value={prepare.simplifyMm}
        unit="mm"
        min={0}
        max={5}
        step={0.01}
        digits={3}
        onChange={(simplifyMm) => change("simplify", { simplifyMm })}
      />
      <NumberField
        label={words.flatten}
        value={prepare.flattenMm}
        unit="mm"
        min={0.001}
        max={5}
        step={0.01}
        digits={3}
        onChange={(flattenMm) => change("flatten", { flattenMm })}
      />
    </SettingsGroup>
  );
};
