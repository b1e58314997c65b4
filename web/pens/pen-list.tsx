import { PLOT_PEN_TABLE, PEN_STOP_MODES, type PlotPen, isSameJson } from "../../src/internal.js";
import { convertRgbToHsv, parseHex } from "culori/fn";
import "../layers/layers.css";
import "./pens.css";
import { useState } from "react";
import { alignmentJob, CORNERS, type Corner } from "./alignment-mark.js";
import { addPen, changePen, pensFromColors, removePen } from "../layers/layer-settings.js";
import { useActions, usePageState, usePageStore } from "../state/use-store.js";
import { pensText as words } from "./text.js";
import { Button, IconButton } from "../ui/button.js";
import { Segments, Select } from "../ui/fields/choice.js";
import { formatNumber } from "../ui/format.js";
import { Icon } from "../ui/icon.js";
import { SettingField } from "../ui/fields/setting-field.js";

export const PenList = () => {
  const pens = usePageState(({ settings }) => settings.pens);
  const penStops = usePageState(({ settings }) => settings.penStops);
  const [openId, setOpenId] = useState<string | null>(null);
  const { changeSettings } = useActions();
  return (
    <>
      <ul className="pen-list">
        {pens.map((pen) => (
          <li key={pen.id} className="layer-card" data-open={openId === pen.id || undefined}>
            <PenRow
              pen={pen}
              isOpen={openId === pen.id}
              onToggle={() => setOpenId(openId === pen.id ? null : pen.id)}
            />
          </li>
        ))}
      </ul>
      <div className="pen-buttons">
        <FromColors />
        <Button
          onClick={() =>
            changeSettings("add pen", (settings) =>
              addPen(settings, { name: words.newName(pens.length + 1) }),
            )
          }
        >
          <Icon name="plus" />
          {words.add}
        </Button>
      </div>
      {pens.length > 0 && (
        <Segments
          label={words.stops}
          value={penStops}
          options={PEN_STOP_MODES.map((value) => ({ value, label: words.stopModes[value] })).reverse()}
          onChange={(value) => changeSettings("pen stops", (settings) => ({ ...settings, penStops: value }))}
        />
      )}
      <ShowInPens />
    </>
  );
};

/** Adds a pen for each colour of the layers. */
const FromColors = () => {
  const rows = usePageState((state) => state.planned?.layers);
  const settings = usePageState((state) => state.settings);
  const { changeSettings } = useActions();
  if (!rows) return null;
  const withPens = pensFromColors(settings, rows, nameOfColor);
  if (isSameJson(withPens.layerPens, settings.layerPens)) return null;
  return (
    <Button
      onClick={() => changeSettings("pens from colours", (now) => pensFromColors(now, rows, nameOfColor))}
    >
      {words.fromColors}
    </Button>
  );
};

/** An approximate name of a colour. */
const nameOfColor = (hex: string | null): string => {
  const rgb = hex === null ? undefined : parseHex(hex);
  if (!rgb) return words.noColor;
  const { h: hueDeg = 0, s: saturation, v: value } = convertRgbToHsv(rgb);
  const { black, white, grey, hues, dark } = words.tones;
  if (saturation * value < 0.14) return value < 0.28 ? black : value > 0.84 ? white : grey;
  const tone = hues.find(([upToDeg]) => hueDeg < upToDeg)?.[1] ?? words.noColor;
  return value < 0.43 ? dark(tone) : tone;
};

const ShowInPens = () => {
  const hasPens = usePageState(({ settings }) => Object.keys(settings.layerPens).length > 0);
  const viewMode = usePageState(({ view }) => view.viewMode);
  const { changeView } = useActions();
  if (!hasPens || viewMode === "pen") return null;
  return (
    <Button kind="link" onClick={() => changeView({ viewMode: "pen" })}>
      {words.showInPens}
    </Button>
  );
};

interface PenRowProps {
  readonly pen: PlotPen;
  readonly isOpen: boolean;
  onToggle(): void;
}

const PenRow = ({ pen, isOpen, onToggle }: PenRowProps) => {
  const { changeSettings } = useActions();
  const facts = [
    `${formatNumber(pen.widthMm)} mm`,
    ...(pen.offsetXMm !== 0 || pen.offsetYMm !== 0
      ? [`${formatNumber(pen.offsetXMm)} / ${formatNumber(pen.offsetYMm)} mm`]
      : []),
  ];
  return (
    <>
      <div className="layer-head">
        <ColorField pen={pen} />
        <input
          className="text-field pen-name"
          type="text"
          maxLength={200}
          aria-label={words.name}
          value={pen.name}
          onChange={(event) => {
            const name = event.target.value;
            changeSettings(`name of ${pen.id}`, (settings) => changePen(settings, pen.id, { name }));
          }}
        />
        <span className="layer-count">{facts.join(" · ")}</span>
        <IconButton
          kind="tool"
          icon="chevron"
          label={words.edit(pen.name)}
          className="layer-more"
          aria-expanded={isOpen}
          onClick={onToggle}
        />
      </div>
      {isOpen && <PenDetails pen={pen} />}
    </>
  );
};

const ColorField = ({ pen }: { pen: PlotPen }) => {
  const { changeSettings } = useActions();
  return (
    <span className="color-field" data-none={pen.color === null || undefined}>
      <input
        type="color"
        aria-label={`${words.color}: ${pen.name}`}
        title={words.color}
        value={pen.color ?? "#808080"}
        onChange={(event) => {
          const color = event.target.value.toLowerCase();
          changeSettings(`colour of ${pen.id}`, (settings) => changePen(settings, pen.id, { color }));
        }}
      />
    </span>
  );
};

const PEN_FIELDS = [
  ["widthMm", undefined],
  ["offsetXMm", undefined],
  ["offsetYMm", words.offsetHint],
] as const;

const PenDetails = ({ pen }: { pen: PlotPen }) => {
  const { changeSettings } = useActions();
  return (
    <div className="layer-details">
      {PEN_FIELDS.map(([key, hint]) => (
        <SettingField
          key={key}
          setting={PLOT_PEN_TABLE[key]}
          value={pen[key]}
          hint={hint}
          onChange={(value) =>
            changeSettings(`${key} of ${pen.id}`, (settings) => changePen(settings, pen.id, { [key]: value }))
          }
        />
      ))}
      <Mark pen={pen} />
      <Button
        kind="small"
        onClick={() => changeSettings(`remove ${pen.id}`, (settings) => removePen(settings, pen.id))}
      >
        <Icon name="close" />
        {words.remove(pen.name)}
      </Button>
    </div>
  );
};

/** Plots the cross that shows where this pen draws. */
const Mark = ({ pen }: { pen: PlotPen }) => {
  const [corner, setCorner] = useState<Corner>("topLeft");
  const isBusy = usePageState((state) => state.busyAction !== null || state.link !== "connected");
  const store = usePageStore();
  const { plotJob } = useActions();
  return (
    <>
      <Select<Corner>
        label={words.markCorner}
        value={corner}
        options={CORNERS.map((value) => ({ value, label: words.corners[value] }))}
        onChange={setCorner}
      />
      <Button
        disabled={isBusy}
        onClick={() =>
          void plotJob(alignmentJob(store.getState().settings, pen, corner, words.markName(pen.name)))
        }
      >
        {words.plotMark}
      </Button>
    </>
  );
};
