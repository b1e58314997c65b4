import { useMemo } from "react";
import { usePageState } from "../state/use-store.js";
import { previewText } from "./text.js";
import { formatDuration, formatNumber } from "../ui/format.js";
import { legendStops, rampColor } from "../scene/color-map.js";

const words = previewText;
const LABELS = 5;

/** What the colours mean. `data-stops` holds the scale as JSON, for whoever reads the page by program. */
export const Legend = () => {
  const colorBy = usePageState((state) => state.view.colorBy);
  const scene = usePageState((state) => state.planned?.scene ?? null);
  const topMmPerS = scene?.topDrawMmPerS ?? 0;
  const stops = useMemo(() => legendStops(topMmPerS), [topMmPerS]);
  if (!scene || scene.draw.count === 0) return null;
  if (colorBy === "order") return <OrderLegend totalS={scene.totalS} />;
  if (colorBy !== "speed") return null;
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

const GRADIENT_STOPS = 16;
const gradient = `linear-gradient(90deg, ${Array.from({ length: GRADIENT_STOPS + 1 }, (_, i) =>
  rampColor(i / GRADIENT_STOPS),
).join(", ")})`;
