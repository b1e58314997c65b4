import { usePageState } from "../state/use-store.js";
import { hoverText as words } from "./text.js";
import { Facts } from "../ui/facts.js";
import { formatCount, formatMoment, formatNumber } from "../ui/format.js";

/** A tooltip with the numbers of the stroke under the pointer. */
export const HoverTip = () => {
  const hover = usePageState((state) => state.hover);
  const strokeCount = usePageState((state) => state.planned?.strokeCount ?? 0);
  if (!hover) return null;
  return (
    <div
      className="hover-tip"
      role="tooltip"
      data-right={hover.isRight || undefined}
      data-low={hover.isLow || undefined}
      style={{ left: hover.xPx, top: hover.yPx }}
    >
      <strong>{hover.layerName}</strong>
      <Facts
        rows={[
          [words.speed, `${formatNumber(hover.speedMmPerS, 1)} mm/s`],
          [words.accel, `${formatNumber(hover.accelMmPerS2, 0)} mm/s²`],
          [words.time, formatMoment(hover.tS)],
          [words.stroke, words.strokeOf(formatCount(hover.strokeNumber), formatCount(strokeCount))],
        ]}
      />
    </div>
  );
};
