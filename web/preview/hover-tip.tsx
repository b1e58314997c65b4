import { usePageState } from "../state/use-store.js";
import { Facts } from "../ui/facts.js";
import { formatCount, formatMoment, formatNumber } from "../ui/format.js";
import { hoverText } from "./text.js";

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
          [hoverText.speed, `${formatNumber(hover.speedMmPerS, 1)} mm/s`],
          [hoverText.accel, `${formatNumber(hover.accelMmPerS2, 0)} mm/s²`],
          [hoverText.time, formatMoment(hover.tS)],
          [hoverText.stroke, hoverText.strokeOf(formatCount(hover.strokeNumber), formatCount(strokeCount))],
        ]}
      />
    </div>
  );
};
