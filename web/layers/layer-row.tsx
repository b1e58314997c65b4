import type { RefObject } from "react";
import { listColor, parseLayerName, penOf, shownLayerName, type PreparedLayer } from "../../src/internal.js";
import { isLayerShown, setLayerPen, showLayer } from "./layer-settings.js";
import { useActions, usePageState } from "../state/use-store.js";
import { layersText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { formatCount } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { LayerDetails } from "./layer-details.js";
import { useRowDrag } from "../ui/rows/row-drag.js";

interface LayerRowProps {
  readonly row: PreparedLayer;
  readonly index: number;
  readonly rows: readonly PreparedLayer[];
  readonly list: RefObject<HTMLUListElement | null>;
  readonly isOpen: boolean;
  onToggle(): void;
  /** `place`: the new index, which is clamped to the list. */
  onMove(place: number): void;
}

export const LayerRow = (props: LayerRowProps) => {
  const { row, index, rows, isOpen } = props;
  const { changeSettings } = useActions();
  const name = shownLayerName(row.name);
  const isShown = usePageState(({ settings }) => isLayerShown(settings, row));
  return (
    <div className="layer-card" data-off={!isShown || undefined} data-open={isOpen || undefined}>
      <div className="layer-head">
        {rows.length > 1 && <DragHandle {...props} name={name} />}
        <label className="layer">
          <input
            type="checkbox"
            checked={isShown}
            aria-label={words.show(name)}
            onChange={(event) => {
              const isOn = event.target.checked;
              changeSettings(`layer ${row.id}`, (settings) => showLayer(settings, row, isOn));
            }}
          />
        </label>
        <PenPicker row={row} name={name} index={index} />
        <button
          type="button"
          className="layer-open"
          title={row.name}
          aria-expanded={isOpen}
          onClick={props.onToggle}
        >
          <span className="layer-words">
            <span className="layer-title">
              <span className="layer-name">
                <span className="visually-hidden">{words.detailsOf} </span>
                {name}
              </span>
              {row.colorCount > 1 && (
                <strong className="layer-mixed">{words.colors(formatCount(row.colorCount))}</strong>
              )}
            </span>
            <Facts row={row} isShown={isShown} />
          </span>
          <Icon name="chevron" />
        </button>
      </div>
      {isOpen && <LayerDetails row={row} rows={rows} index={index} onMove={props.onMove} />}
    </div>
  );
};

const DragHandle = ({ row, index, list, onMove, name }: LayerRowProps & { readonly name: string }) => {
  const drag = useRowDrag(list, row.id, index, onMove);
  return (
    <Button kind="tool" className="layer-grip" aria-label={words.drag(name)} title={words.dragHint} {...drag}>
      <Icon name="grip" />
    </Button>
  );
};

/** The number of strokes, and what differs from the other layers. */
const Facts = ({ row, isShown }: { readonly row: PreparedLayer; readonly isShown: boolean }) => {
  const times = usePageState(({ settings }) => settings.prepare.layerRepeats[row.id] ?? 1);
  const hasOwn = usePageState(
    ({ settings }) =>
      settings.motion.layers?.[row.id] !== undefined ||
      settings.pen.layers?.[row.id] !== undefined ||
      settings.prepare.layerHatches.some(({ layer }) => layer === row.id),
  );
  const pen = usePageState(({ settings }) => penOf(settings, row)?.name);
  const { penDownPct, drawSpeedPct, delayMs, skip } = parseLayerName(row.name);
  const isCoded = penDownPct !== null || drawSpeedPct !== null || delayMs !== null;
  const facts =
    skip && !isShown
      ? [words.offByName]
      : [
          ...(pen === undefined ? [] : [pen]),
          words.strokes(formatCount(row.strokeCount), row.strokeCount === 1),
          ...(times > 1 ? [words.times(times)] : []),
          ...(hasOwn || isCoded ? [words.own] : []),
        ];
  return <span className="layer-count">{facts.join(" · ")}</span>;
};

/** The colour of the layer's pen, or the layer's own. If there are pens, a press chooses one. */
const PenPicker = ({
  row,
  name,
  index,
}: Pick<LayerRowProps, "row" | "index"> & { readonly name: string }) => {
  const pens = usePageState(({ settings }) => settings.pens);
  const pen = usePageState(({ settings }) => penOf(settings, row));
  const { changeSettings } = useActions();
  const swatch = (
    <span className="swatch" style={{ backgroundColor: pen?.color ?? row.color ?? listColor(index) }} />
  );
  if (pens.length === 0) return <span className="layer-pen">{swatch}</span>;
  return (
    <span className="layer-pen" data-choice>
      {swatch}
      <Icon name="down" />
      <select
        aria-label={words.penOf(name)}
        title={words.penOf(name)}
        value={pen?.id ?? ""}
        onChange={(event) => {
          const chosen = event.target.value;
          changeSettings(`pen of ${row.id}`, (settings) =>
            setLayerPen(settings, row.id, chosen === "" ? null : chosen),
          );
        }}
      >
        <option value="">{words.anyPen}</option>
        {pens.map(({ id, name: penName }) => (
          <option key={id} value={id}>
            {penName}
          </option>
        ))}
      </select>
    </span>
  );
};
