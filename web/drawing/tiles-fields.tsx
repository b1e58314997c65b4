import { PREPARE_TABLE, sheetSize, tileCount } from "../../src/internal.js";
import { usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { Select, Switch } from "../ui/fields/choice.js";
import { SettingField } from "../ui/fields/setting-field.js";
import { formatSize } from "../ui/format.js";
import { usePrepareChange } from "../ui/use-change.js";
import { tilesText as words } from "./text.js";

/** A drawing that is larger than the paper, spread over several sheets. */
export const TilesFields = () => {
  const prepare = usePageState((state) => state.settings.prepare);
  const unit = usePageState((state) => state.view.lengthUnit);
  const isSheet = usePageState(({ drawing }) => Boolean(drawing?.sheet));
  const change = usePrepareChange();
  const { tileColumns, tileRows, tileOverlapMm, tileMarks, tile } = prepare;
  const count = tileCount(prepare);
  const spread = (columns: number, rows: number): void => {
    const isFirst = count === 1 && columns * rows > 1;
    // A drawing is spread because it shall become larger. One that was placed, or is a sheet, keeps its size.
    const fits = isFirst && !isSheet && prepare.layout === null ? { fit: true } : {};
    change("tiles", { tileColumns: columns, tileRows: rows, tile: 0, ...fits });
  };
  return (
    <>
      <div className="field-pair">
        <SettingField
          setting={PREPARE_TABLE.tileColumns}
          value={tileColumns}
          onChange={(columns) => spread(columns, tileRows)}
        />
        <SettingField
          setting={PREPARE_TABLE.tileRows}
          value={tileRows}
          onChange={(rows) => spread(tileColumns, rows)}
        />
      </div>
      {count > 1 && (
        <>
          <p className="note">{words.together(count, sizeInWords(prepare, unit))}</p>
          <SettingField
            setting={PREPARE_TABLE.tileOverlapMm}
            value={tileOverlapMm}
            onChange={(mm) => change("tile overlap", { tileOverlapMm: mm })}
          />
          <Switch
            label={PREPARE_TABLE.tileMarks.label}
            isOn={tileMarks}
            onChange={(isOn) => change("tile marks", { tileMarks: isOn })}
          />
          <Select
            label={words.which}
            value={String(tile)}
            options={Array.from({ length: count + 1 }, (_, k) => ({
              value: String(k),
              label: k === 0 ? words.all : words.one(k, count),
            }))}
            onChange={(value) => change("tile", { tile: Number(value) })}
          />
          <p className="note">{words.hint}</p>
          <Button kind="small" onClick={() => spread(1, 1)}>
            {words.off}
          </Button>
        </>
      )}
    </>
  );
};

/** An overlap that is too large has no size: the planner says so. */
const sizeInWords = (
  prepare: Parameters<typeof sheetSize>[0],
  unit: Parameters<typeof formatSize>[2],
): string => {
  try {
    const { widthMm, heightMm } = sheetSize(prepare);
    return formatSize(widthMm, heightMm, unit);
  } catch {
    return "–";
  }
};
