import {
  parseLayerName,
  penOfLayer,
  speedOfCode,
  withLayerCodes,
  type LayerMotion,
  type LayerPen,
  type PreparedLayer,
} from "../../src/index.js";
import {
  hatchLayer,
  repeatLayer,
  setLayerMotion,
  setLayerPenMotion,
  showOnly,
  stopBefore,
  withoutLayer,
} from "../state/layer-settings.js";
import { usePageState } from "../state/use-store.js";
import { setup } from "../text/setup.js";
import { Segments } from "../ui/choice.js";
import { Icon } from "../ui/icon.js";
import { IconButton } from "../ui/icon-button.js";
import { OwnNumber } from "../ui/own-number.js";
import { useChange } from "./use-change.js";

const words = setup.layers;

interface LayerDetailsProps {
  readonly row: PreparedLayer;
  readonly rows: readonly PreparedLayer[];
  readonly index: number;
  onMove(place: number): void;
}

/** What one layer does in its own way; empty fields are as for all, or as its name asks. */
export const LayerDetails = ({ row, rows, index, onMove }: LayerDetailsProps) => {
  const change = useChange();
  return (
    <div className="layer-details">
      {row.colorCount > 1 && <p className="note">{words.colorsHint}</p>}
      <CodesNote row={row} />
      <MotionFields row={row} />
      <PenFields row={row} />
      <InkFields row={row} />
      <StopChoice row={row} />
      {rows.length > 1 && (
        <div className="button-row">
          <button
            type="button"
            className="button button-small"
            onClick={() => change(`solo ${row.id}`, (settings) => showOnly(settings, rows, row.id))}
          >
            <Icon name="eye" />
            {words.onlyThis}
          </button>
          <span className="spacer" />
          <IconButton icon="up" label={words.earlier} isOff={index === 0} onClick={() => onMove(index - 1)} />
          <IconButton
            icon="down"
            label={words.later}
            isOff={index === rows.length - 1}
            onClick={() => onMove(index + 1)}
          />
        </div>
      )}
    </div>
  );
};

type RowProps = Pick<LayerDetailsProps, "row">;

/** What the layer's name says about the plot, in words. */
const CodesNote = ({ row }: RowProps) => {
  const { skip, pause, penDownPct, drawSpeedPct, delayMs } = parseLayerName(row.name);
  const said = [
    skip ? words.code.skip : null,
    pause ? words.code.pause : null,
    penDownPct === null ? null : words.code.penDownPct(penDownPct),
    drawSpeedPct === null ? null : words.code.drawSpeedPct(speedOfCode(drawSpeedPct)),
    delayMs === null ? null : words.code.delayMs(delayMs),
  ].filter((one) => one !== null);
  if (said.length === 0) return null;
  return <p className="note">{words.codes(said.join(", "))}</p>;
};

/** The settings as they would be for a layer without any of its own, its name's codes included. */
const useInherited = (row: PreparedLayer) => {
  const settings = usePageState((state) => state.settings);
  const bare = {
    motion: { ...settings.motion, layers: withoutLayer(settings.motion.layers, row.id) },
    pen: { ...settings.pen, layers: withoutLayer(settings.pen.layers, row.id) },
  };
  const { motion, pen } = withLayerCodes(bare, [row]);
  const own = motion.layers?.[row.id] ?? {};
  return {
    motion: { ...motion.draw, ...own },
    pen: { ...penOfLayer(pen, row.id), beforeMs: pen.layers?.[row.id]?.beforeMs ?? 0 },
  };
};

const MotionFields = ({ row }: RowProps) => {
  const own: LayerMotion = usePageState(({ settings }) => settings.motion.layers?.[row.id]) ?? {};
  const { motion } = useInherited(row);
  const change = useChange();
  const fields = [
    ["speedMmPerS", words.speed, "mm/s", 1, 1_000, 5],
    ["accelMmPerS2", words.accel, "mm/s²", 10, 50_000, 50],
  ] as const;
  return fields.map(([key, label, unit, min, max, step]) => (
    <OwnNumber
      key={key}
      label={label}
      value={own[key] ?? null}
      inherited={motion[key] ?? null}
      unit={unit}
      min={min}
      max={max}
      step={step}
      resetLabel={words.reset(label)}
      onChange={(value) =>
        change(`${key} of ${row.id}`, (settings) => setLayerMotion(settings, row.id, { [key]: value }))
      }
    />
  ));
};

const PenFields = ({ row }: RowProps) => {
  const own: LayerPen = usePageState(({ settings }) => settings.pen.layers?.[row.id]) ?? {};
  const { pen } = useInherited(row);
  const change = useChange();
  const fields = [
    ["downPct", words.penDown, "%", 100, 1],
    ["upPct", words.penUp, "%", 100, 1],
    ["liftMs", words.lift, "ms", 10_000, 10],
    ["dropMs", words.drop, "ms", 10_000, 10],
    ["beforeMs", words.before, "ms", 60_000, 500],
  ] as const;
  return fields.map(([key, label, unit, max, step]) => (
    <OwnNumber
      key={key}
      label={label}
      value={own[key] ?? null}
      inherited={pen[key]}
      unit={unit}
      min={0}
      max={max}
      step={step}
      resetLabel={words.reset(label)}
      onChange={(value) =>
        change(`${key} of ${row.id}`, (settings) => setLayerPenMotion(settings, row.id, { [key]: value }))
      }
    />
  ));
};

const InkFields = ({ row }: RowProps) => {
  const { layerRepeats, layerHatches, hatch } = usePageState(({ settings }) => settings.prepare);
  const own = layerHatches.find(({ layer }) => layer === row.id) ?? null;
  const change = useChange();
  return (
    <>
      <OwnNumber
        label={words.repeat}
        value={layerRepeats[row.id] ?? null}
        inherited={1}
        unit={words.repeatUnit}
        min={1}
        max={20}
        step={1}
        resetLabel={words.reset(words.repeat)}
        onChange={(times) =>
          change(`repeat ${row.id}`, (settings) =>
            repeatLayer(settings, row.id, times === null ? null : Math.round(times)),
          )
        }
      />
      <OwnNumber
        label={words.hatch}
        value={own?.spacingMm ?? null}
        inherited={hatch.spacingMm}
        unit="mm"
        min={0}
        max={100}
        step={0.1}
        resetLabel={words.reset(words.hatch)}
        onChange={(spacingMm) =>
          change(`hatch of ${row.id}`, (settings) =>
            hatchLayer(settings, row.id, spacingMm === null ? null : { ...(own ?? hatch), spacingMm }),
          )
        }
      />
      {own && own.spacingMm > 0 && (
        <OwnNumber
          label={words.hatchAngle}
          value={own.angleDeg}
          inherited={hatch.angleDeg}
          unit="°"
          min={-360}
          max={360}
          step={5}
          resetLabel={words.reset(words.hatchAngle)}
          onChange={(angleDeg) =>
            change(`hatch angle of ${row.id}`, (settings) =>
              hatchLayer(settings, row.id, { ...own, angleDeg: angleDeg ?? hatch.angleDeg }),
            )
          }
        />
      )}
    </>
  );
};

const StopChoice = ({ row }: RowProps) => {
  const stop = usePageState(({ settings }) => settings.layerStops[row.id]);
  const isNever = usePageState(({ settings }) => settings.penStops === "never");
  const change = useChange();
  if (isNever) return null;
  return (
    <Segments
      label={words.stopBefore}
      value={stop === undefined ? "auto" : stop ? "yes" : "no"}
      options={[
        { value: "auto", label: words.stops.auto },
        { value: "yes", label: words.stops.yes },
        { value: "no", label: words.stops.no },
      ]}
      onChange={(value) =>
        change(`stop before ${row.id}`, (settings) =>
          stopBefore(settings, row.id, value === "auto" ? null : value === "yes"),
        )
      }
    />
  );
};
