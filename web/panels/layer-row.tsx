import type { RefObject } from "react";
import { parseLayerName, shownLayerName, type PreparedLayer } from "../../src/index.js";
import { layerColor } from "../preview/color-map.js";
import { setLayerPen, showLayer } from "../state/layer-settings.js";
import { usePageState } from "../state/use-store.js";
import { setup } from "../text/setup.js";
import { formatCount } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { LayerDetails } from "./layer-details.js";
import { useRowDrag } from "./row-drag.js";
import { useChange } from "./use-change.js";

const words = setup.layers;

interface LayerRowProps {
  readonly row: PreparedLayer;
  readonly index: number;
  readonly rows: readonly PreparedLayer[];
  readonly list: RefObject<HTMLUListElement | null>;
  readonly isOpen: boolean;
  onToggle(): void;
  /** To a place among all layers. */
  onMove(place: number): void;
}

export const LayerRow = (props: LayerRowProps) => {
  const { row, index, rows, isOpen } = props;
  const change = useChange();
  const name = shownLayerName(row.name);
  return (
    <div className="layer-card" data-off={!row.visible || undefined} data-open={isOpen || undefined}>
      <div className="layer-head">
        {rows.length > 1 && <DragHandle {...props} name={name} />}
        <label className="layer">
          <input
            type="checkbox"
            checked={row.visible}
            aria-label={words.show(name)}
            onChange={(event) => {
              const isOn = event.target.checked;
              change(`layer ${row.id}`, (settings) => showLayer(settings, row, isOn));
            }}
          />
          <Swatch row={row} index={index} />
          <span className="layer-words">
            <span className="layer-name" title={row.name}>
              {name}
            </span>
            <Facts row={row} />
          </span>
        </label>
        <PenPicker row={row} name={name} />
        <button
          type="button"
          className="tool layer-more"
          aria-label={words.details(name)}
          title={words.detailsHint}
          aria-expanded={isOpen}
          onClick={props.onToggle}
        >
          <Icon name="chevron" />
        </button>
      </div>
      {isOpen && <LayerDetails row={row} rows={rows} index={index} onMove={props.onMove} />}
    </div>
  );
};

const DragHandle = ({ row, index, list, onMove, name }: LayerRowProps & { readonly name: string }) => {
  const drag = useRowDrag(list, row.id, onMove);
  return (
    <button
      type="button"
      className="tool layer-grip"
      aria-label={words.drag(name)}
      title={words.dragHint}
      onKeyDown={(event) => {
        const way = event.key === "ArrowUp" ? -1 : event.key === "ArrowDown" ? 1 : 0;
        if (way === 0) return;
        event.preventDefault();
        onMove(Math.max(0, index + way));
      }}
      {...drag}
    >
      <Icon name="grip" />
    </button>
  );
};

/** The colour that the layer is drawn in: its pen's, else its own. */
const Swatch = ({ row, index }: Pick<LayerRowProps, "row" | "index">) => {
  const penColor = usePageState(
    ({ settings }) => settings.pens.find(({ id }) => id === settings.layerPens[row.id])?.color ?? null,
  );
  return <span className="swatch" style={{ backgroundColor: penColor ?? row.color ?? layerColor(index) }} />;
};

/** How much there is to draw, and what of it is out of the ordinary. */
const Facts = ({ row }: { row: PreparedLayer }) => {
  const times = usePageState(({ settings }) => settings.prepare.layerRepeats[row.id] ?? 1);
  const hasOwn = usePageState(
    ({ settings }) =>
      settings.motion.layers?.[row.id] !== undefined ||
      settings.pen.layers?.[row.id] !== undefined ||
      settings.prepare.layerHatches.some(({ layer }) => layer === row.id),
  );
  const { penDownPct, drawSpeedPct, delayMs, skip } = parseLayerName(row.name);
  const isCoded = penDownPct !== null || drawSpeedPct !== null || delayMs !== null;
  const facts = [
    words.strokes(formatCount(row.strokeCount), row.strokeCount === 1),
    ...(times > 1 ? [words.times(times)] : []),
    ...(hasOwn || isCoded ? [words.own] : []),
    ...(skip && !row.visible ? [words.offByName] : []),
  ];
  return <span className="layer-count">{facts.join(" · ")}</span>;
};

const PenPicker = ({ row, name }: { row: PreparedLayer; name: string }) => {
  const pens = usePageState(({ settings }) => settings.pens);
  const penId = usePageState(({ settings }) => settings.layerPens[row.id] ?? "");
  const change = useChange();
  if (pens.length === 0) return null;
  return (
    <select
      className="layer-pen"
      aria-label={words.penOf(name)}
      value={pens.some(({ id }) => id === penId) ? penId : ""}
      onChange={(event) => {
        const chosen = event.target.value;
        change(`pen of ${row.id}`, (settings) =>
          setLayerPen(settings, row.id, chosen === "" ? null : chosen),
        );
      }}
    >
      <option value="">{words.anyPen}</option>
      {pens.map((pen) => (
        <option key={pen.id} value={pen.id}>
          {pen.name}
        </option>
      ))}
    </select>
  );
};
