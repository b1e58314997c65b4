import { useRef } from "react";
import {
  DRAW_TABLE,
  HATCH_TABLE,
  LAYER_REPEATS,
  LAYER_WAIT,
  PEN_TABLE,
  parseLayerName,
  penOfLayer,
  speedOfCode,
  withLayerCodes,
  type LayerMotion,
  type LayerPen,
  type PreparedLayer,
} from "../../src/internal.js";
import {
  hatchLayer,
  repeatLayer,
  setLayerMotion,
  setLayerPenMotion,
  showOnly,
  stopBefore,
  withoutLayer,
} from "./layer-settings.js";
import { useIsUsed } from "../state/used-settings.js";
import { useActions, usePageState } from "../state/use-store.js";
import { layersText as words } from "./text.js";
import { Button, IconButton } from "../ui/button.js";
import { Segments } from "../ui/fields/choice.js";
import { Icon } from "../ui/icon.js";
import { OwnNumber } from "../ui/fields/own-number.js";

interface LayerDetailsProps {
  readonly row: PreparedLayer;
  readonly rows: readonly PreparedLayer[];
  readonly index: number;
  onMove(place: number): void;
}

/** One layer's own settings; an empty field uses the common setting, or the code in the layer's name. */
export const LayerDetails = ({ row, rows, index, onMove }: LayerDetailsProps) => {
  const { changeSettings } = useActions();
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
          <Button
            kind="small"
            onClick={() => changeSettings(`solo ${row.id}`, (settings) => showOnly(settings, rows, row.id))}
          >
            <Icon name="eye" />
            {words.onlyThis}
          </Button>
          <span className="spacer" />
          <IconButton
            icon="up"
            label={words.earlier}
            disabled={index === 0}
            onClick={() => onMove(index - 1)}
          />
          <IconButton
            icon="down"
            label={words.later}
            disabled={index === rows.length - 1}
            onClick={() => onMove(index + 1)}
          />
        </div>
      )}
    </div>
  );
};

type RowProps = Pick<LayerDetailsProps, "row">;

/** Explains the codes in the layer's name. */
const CodesNote = ({ row }: RowProps) => {
  const { skip, pause, penDownPct, drawSpeedPct, delayMs } = parseLayerName(row.name);
  const codes = [
    skip ? words.code.skip : null,
    pause ? words.code.pause : null,
    penDownPct === null ? null : words.code.penDownPct(penDownPct),
    drawSpeedPct === null ? null : words.code.drawSpeedPct(speedOfCode(drawSpeedPct)),
    delayMs === null ? null : words.code.delayMs(delayMs),
  ].filter((one) => one !== null);
  if (codes.length === 0) return null;
  return <p className="note">{words.codes(codes.join(", "))}</p>;
};

/** The values that apply if the layer has no custom setting: the common settings, and the codes in its name. */
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
  const { changeSettings } = useActions();
  const isAccelUsed = useIsUsed("motion.layers.*.accelMmPerS2");
  const keys = ["speedMmPerS", ...(isAccelUsed ? (["accelMmPerS2"] as const) : [])] as const;
  return keys.map((key) => (
    <OwnNumber
      key={key}
      {...DRAW_TABLE[key]}
      value={own[key] ?? null}
      inherited={motion[key] ?? null}
      resetLabel={words.reset(DRAW_TABLE[key].label)}
      onChange={(value) =>
        changeSettings(`${key} of ${row.id}`, (settings) =>
          setLayerMotion(settings, row.id, { [key]: value }),
        )
      }
    />
  ));
};

const LAYER_PEN_FIELDS = [
  ["downPct", PEN_TABLE.downPct],
  ["upPct", PEN_TABLE.upPct],
  ["extraLiftMs", PEN_TABLE.extraLiftMs],
  ["extraDropMs", PEN_TABLE.extraDropMs],
  ["beforeMs", LAYER_WAIT],
] as const;

const PenFields = ({ row }: RowProps) => {
  const own: LayerPen = usePageState(({ settings }) => settings.pen.layers?.[row.id]) ?? {};
  const { pen } = useInherited(row);
  const { changeSettings } = useActions();
  return LAYER_PEN_FIELDS.map(([key, setting]) => (
    <OwnNumber
      key={key}
      {...setting}
      value={own[key] ?? null}
      inherited={pen[key]}
      resetLabel={words.reset(setting.label)}
      onChange={(value) =>
        changeSettings(`${key} of ${row.id}`, (settings) =>
          setLayerPenMotion(settings, row.id, { [key]: value }),
        )
      }
    />
  ));
};

const InkFields = ({ row }: RowProps) => {
  const { layerRepeats, layerHatches, hatch } = usePageState(({ settings }) => settings.prepare);
  const own = layerHatches.find(({ layer }) => layer === row.id) ?? null;
  // An emptied distance deletes the layer's hatch; a distance typed next gets its angle and cross back.
  const beforeTyping = useRef(own);
  const { changeSettings } = useActions();
  return (
    <>
      <OwnNumber
        {...LAYER_REPEATS}
        value={layerRepeats[row.id] ?? null}
        inherited={LAYER_REPEATS.default}
        resetLabel={words.reset(LAYER_REPEATS.label)}
        onChange={(times) =>
          changeSettings(`repeat ${row.id}`, (settings) =>
            repeatLayer(settings, row.id, times === null ? null : Math.round(times)),
          )
        }
      />
      {/* After the reset button the field has to be focused again, which forgets the deleted hatch. */}
      <div onFocus={() => (beforeTyping.current = own)}>
        <OwnNumber
          {...HATCH_TABLE.spacingMm}
          label={words.hatch}
          value={own?.spacingMm ?? null}
          inherited={hatch.spacingMm}
          resetLabel={words.reset(words.hatch)}
          onChange={(spacingMm) => {
            const base = own ?? beforeTyping.current ?? hatch;
            changeSettings(`hatch of ${row.id}`, (settings) =>
              hatchLayer(settings, row.id, spacingMm === null ? null : { ...base, spacingMm }),
            );
          }}
        />
      </div>
      {own && own.spacingMm > 0 && (
        <OwnNumber
          {...HATCH_TABLE.angleDeg}
          label={words.hatchAngle}
          value={own.angleDeg}
          inherited={hatch.angleDeg}
          resetLabel={words.reset(words.hatchAngle)}
          onChange={(angleDeg) =>
            changeSettings(`hatch angle of ${row.id}`, (settings) =>
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
  const { changeSettings } = useActions();
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
        changeSettings(`stop before ${row.id}`, (settings) =>
          stopBefore(settings, row.id, value === "auto" ? null : value === "yes"),
        )
      }
    />
  );
};
