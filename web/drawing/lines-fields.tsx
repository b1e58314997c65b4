import { PREPARE_TABLE, type Setting } from "../../src/internal.js";
import { usePageState } from "../state/use-store.js";
import { linesText as words } from "./text.js";
import { Segments, Switch } from "../ui/fields/choice.js";
import { SettingField } from "../ui/fields/setting-field.js";
import { usePrepareChange } from "../ui/use-change.js";

type Key = keyof typeof PREPARE_TABLE;
/** The numbers and switches that the settings table lists for this panel, in its order. */
const ROWS = (Object.entries(PREPARE_TABLE) as [Key, Setting][]).filter(([, { panel }]) => panel === "lines");

/** Settings for ordering, joining and cleaning strokes. */
export const LinesFields = () => {
  const prepare = usePageState((state) => state.settings.prepare);
  const change = usePrepareChange();
  return (
    <>
      <Segments
        label={PREPARE_TABLE.order.label}
        hint={words.orderHint}
        value={prepare.order}
        options={PREPARE_TABLE.order.choices.map((value) => ({ value, label: words.orders[value] }))}
        onChange={(order) => change("order", { order })}
      />
      {prepare.order === "best" && (
        <SettingField
          setting={PREPARE_TABLE.orderS}
          value={prepare.orderS}
          onChange={(orderS) => change("order time", { orderS })}
        />
      )}
      <Segments
        label={PREPARE_TABLE.spread.label}
        hint={words.spreadHint}
        value={prepare.spread}
        options={PREPARE_TABLE.spread.choices.map((value) => ({ value, label: words.spreads[value] }))}
        onChange={(spread) => change("spread", { spread })}
      />
      {ROWS.map(([key, setting]) =>
        setting.kind === "number" ? (
          <SettingField
            key={key}
            setting={setting}
            value={prepare[key] as number}
            onChange={(value) => change(key, { [key]: value })}
          />
        ) : (
          <Switch
            key={key}
            label={setting.label}
            isOn={prepare[key] as boolean}
            onChange={(value) => change(key, { [key]: value })}
          />
        ),
      )}
    </>
  );
};
