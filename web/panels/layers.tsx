import { layerColor } from "../preview/color-map.js";
import { usePageState } from "../state/use-store.js";
import { text } from "../text/text.js";
import { Segments } from "../ui/choice.js";
import { formatCount } from "../ui/format.js";
import { SettingsGroup } from "./settings-group.js";
import { usePrepareChange } from "./paper.js";

const words = text.layers;

export const LayersPanel = () => {
  const planned = usePageState((state) => state.planned);
  const { layers: mode, hiddenLayers } = usePageState((state) => state.settings.prepare);
  const change = usePrepareChange();
  const rows = planned?.layers ?? [];
  const toggle = (id: string, isOn: boolean): void =>
    change(`layer ${id}`, {
      hiddenLayers: isOn ? hiddenLayers.filter((other) => other !== id) : [...hiddenLayers, id],
    });
  const solo = (id: string): void =>
    change(`solo ${id}`, { hiddenLayers: rows.map((row) => row.id).filter((other) => other !== id) });

  return (
    <SettingsGroup id="layers" title={words.title} summary={rows.length > 0 ? String(rows.length) : ""}>
      <Segments
        label={words.by}
        value={mode}
        options={[
          { value: "group", label: words.group },
          { value: "stroke", label: words.stroke },
          { value: "all", label: words.all },
        ]}
        onChange={(layers) => change("layers from", { layers, hiddenLayers: [] })}
      />
      {planned && rows.length === 0 && <p className="note">{words.none}</p>}
      <ul className="layer-list">
        {rows.map((row, index) => (
          <li key={row.id}>
            <label className="layer">
              <input
                type="checkbox"
                checked={!hiddenLayers.includes(row.id)}
                aria-label={words.show(row.name)}
                onChange={(event) => toggle(row.id, event.target.checked)}
              />
              <span className="swatch" style={{ backgroundColor: row.color ?? layerColor(index) }} />
              <span className="layer-name" title={row.name}>
                {row.name}
              </span>
              <span className="layer-count">
                {words.strokes(formatCount(row.strokeCount), row.strokeCount === 1)}
              </span>
            </label>
            {rows.length > 1 && (
              <button type="button" className="link" onClick={() => solo(row.id)}>
                {words.onlyThis}
              </button>
            )}
          </li>
        ))}
      </ul>
      {hiddenLayers.length > 0 && (
        <button type="button" className="link" onClick={() => change("all layers", { hiddenLayers: [] })}>
          {words.everything}
        </button>
      )}
    </SettingsGroup>
  );
};
