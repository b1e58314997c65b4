import { penOf } from "../../src/internal.js";
import { COLOR_MODES, type ColorMode } from "../scene/color-mode.js";
import { legendStops, rampColor } from "../scene/color-map.js";
import { useActions, usePageState } from "../state/use-store.js";
import { Segments, Select } from "../ui/choice.js";
import { formatDuration, formatNumber } from "../ui/format.js";
import { lazyPart } from "../ui/lazy-part.js";
import type { Planned } from "../worker/protocol.js";
import { legendEntries } from "./looks.js";
import { previewText as words } from "./text.js";

const SwingLegend = lazyPart(async () => (await import("./swing-legend.js")).SwingLegend);
const LABELS = 5;
const SHOWN_ENTRIES = 6;

const OPTIONS = COLOR_MODES.map((value) => ({ value, label: words.looks[value] }));

/** The looks of the drawing, and the legend of the chosen one. */
export const Looks = () => {
  const colorBy = usePageState((state) => state.view.colorBy);
  const planned = usePageState((state) => state.planned);
  const { changeView } = useActions();
  const choose = (chosen: ColorMode): void => changeView({ colorBy: chosen });
  return (
    <div className="looks">
      {planned && planned.scene.draw.count > 0 && <Legend colorBy={colorBy} planned={planned} />}
      {/* Where six names have no room beside each other; the style shows one of the two. */}
      <div className="looks-menu">
        <Select label={words.colorBy} value={colorBy} options={OPTIONS} onChange={choose} />
      </div>
      <Segments label={words.colorBy} isLabelHidden value={colorBy} options={OPTIONS} onChange={choose} />
    </div>
  );
};

const Legend = ({ colorBy, planned }: { colorBy: ColorMode; planned: Planned }) => {
  if (colorBy === "speed") return <SpeedLegend topMmPerS={planned.scene.topDrawMmPerS} />;
  if (colorBy === "order") return <OrderLegend totalS={planned.scene.totalS} />;
  if (colorBy === "swing") return <SwingLegend planned={planned} gradient={gradient} />;
  return <ListLegend colorBy={colorBy} planned={planned} />;
};

/** `data-stops` is the scale as JSON, for programs that read the page. */
const SpeedLegend = ({ topMmPerS }: { topMmPerS: number }) => {
  const stops = legendStops(topMmPerS);
  return (
    <figure className="legend" role="img" aria-label={words.legend} data-stops={JSON.stringify(stops)}>
      <figcaption aria-hidden="true">
        <span>{words.legendTitle}</span>
        <span>{words.legendUnit}</span>
      </figcaption>
      <div className="legend-bar" style={{ background: gradient }} />
      <div className="legend-labels" aria-hidden="true">
        {Array.from({ length: LABELS }, (_, i) => (
          <span key={i}>{formatNumber((topMmPerS * i) / (LABELS - 1), topMmPerS < 10 ? 1 : 0)}</span>
        ))}
      </div>
    </figure>
  );
};

const OrderLegend = ({ totalS }: { totalS: number }) => (
  <figure className="legend">
    <figcaption>{words.orderTitle(formatDuration(totalS))}</figcaption>
    <div className="legend-bar" style={{ background: gradient }} />
    <div className="legend-labels">
      <span>{words.first}</span>
      <span>{words.last}</span>
    </div>
  </figure>
);

type ListedMode = Exclude<ColorMode, "speed" | "order" | "swing">;

/** Layers, pens or inks by name. */
const ListLegend = ({ colorBy, planned }: { colorBy: ListedMode; planned: Planned }) => {
  const settings = usePageState((state) => state.settings);
  const entries = legendEntries({ planned, settings }, colorBy, (layer, { widthMm }) => {
    const mm = formatNumber(widthMm, 2);
    if (colorBy === "layer") return layer.name;
    if (colorBy === "ink") return words.ofWidth(layer.color ?? words.noColor, mm);
    const pen = penOf(settings, layer);
    return pen ? words.ofWidth(pen.name, mm) : words.noPen(layer.name);
  });
  const restCount = entries.length - SHOWN_ENTRIES;
  return (
    <figure className="legend">
      <figcaption>{words.lookTitles[colorBy]}</figcaption>
      <ul className="legend-list">
        {entries.slice(0, SHOWN_ENTRIES).map(({ color, label }) => (
          <li key={`${color} ${label}`}>
            <span className="swatch" style={{ backgroundColor: color }} />
            {label}
          </li>
        ))}
        {restCount > 0 && <li>{words.moreEntries(restCount)}</li>}
      </ul>
    </figure>
  );
};

const GRADIENT_STOPS = 16;
const gradient = `linear-gradient(90deg, ${Array.from({ length: GRADIENT_STOPS + 1 }, (_, i) =>
  rampColor(i / GRADIENT_STOPS),
).join(", ")})`;
