import "../ui/rows/row-drag.css";
import "./layers.css";
import { useRef, useState } from "react";
import { PREPARE_TABLE } from "../../src/internal.js";
import type { Planned } from "../worker/protocol.js";
import { inWantedOrder, isLayerShown, moveLayer, showAll } from "./layer-settings.js";
import { useActions, usePageState } from "../state/use-store.js";
import { layersText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { Segments } from "../ui/fields/choice.js";
import { Icon } from "../ui/icon.js";
import { usePrepareChange } from "../ui/use-change.js";
import { LayerRow } from "./layer-row.js";

type ShownPenStop = Planned["penStops"][number];

/** The layers in drawing order, each with its switch and pen, and the stops between them. */
export const LayerList = () => {
  const planned = usePageState((state) => state.planned);
  const { changeSettings } = useActions();
  const changePrepare = usePrepareChange();
  const list = useRef<HTMLUListElement>(null);
  const [openId, setOpenId] = useState<string | null>(null);
  const settings = usePageState((state) => state.settings);
  const { layers: mode, layerOrder } = settings.prepare;
  const rows = inWantedOrder(settings, planned?.layers ?? []);
  const hasHidden = rows.some((row) => !isLayerShown(settings, row));
  const move = (id: string, place: number): void =>
    changeSettings(`order of ${id}`, (now) => moveLayer(now, rows, id, place));

  return (
    <>
      <Segments
        label={words.by}
        value={mode}
        options={PREPARE_TABLE.layers.choices.map((value) => ({ value, label: words.modes[value] }))}
        onChange={(layers) => changePrepare("layers from", { layers })}
      />
      {planned && rows.length === 0 && <p className="note">{words.none}</p>}
      <ul className="layer-list" ref={list}>
        {rows.map((row, index) => (
          <li key={row.id} data-row={row.id}>
            <StopsBefore stops={planned?.penStops ?? []} layerId={row.id} />
            <LayerRow
              row={row}
              index={index}
              rows={rows}
              list={list}
              isOpen={openId === row.id}
              onToggle={() => setOpenId(openId === row.id ? null : row.id)}
              onMove={(place) => move(row.id, place)}
            />
          </li>
        ))}
      </ul>
      {(hasHidden || layerOrder.length > 0) && (
        <div className="layer-links">
          {hasHidden && (
            <Button kind="link" onClick={() => changeSettings("all layers", (now) => showAll(now, rows))}>
              {words.everything}
            </Button>
          )}
          {layerOrder.length > 0 && (
            <Button kind="link" onClick={() => changePrepare("file order", { layerOrder: [] })}>
              {words.fileOrder}
            </Button>
          )}
        </div>
      )}
    </>
  );
};

/** The planned stop before this layer, if any. */
const StopsBefore = ({ stops, layerId }: { stops: readonly ShownPenStop[]; layerId: string }) => {
  const stop = stops.find((one) => one.layerId === layerId);
  if (!stop) return null;
  return (
    <p className="layer-stop">
      <Icon name="pause" />
      {stop.penName === null ? words.stopNoPen : words.stop(stop.penName)}
    </p>
  );
};
