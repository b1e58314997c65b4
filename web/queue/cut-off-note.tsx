import { usePageState } from "../state/use-store.js";
import { formatCount } from "../ui/format.js";
import { plotText } from "./text.js";

/** How many lines are not drawn, or only in part, and why. */
export const CutOffNote = () => {
  const cutOff = usePageState((state) => state.planned?.cutOff ?? null);
  const isAtMargins = usePageState((state) => state.planned?.settings.prepare.clipToMargins ?? false);
  if (!cutOff) return null;
  const { outsideCount, partCount } = cutOff;
  const edge = isAtMargins ? plotText.margins : plotText.paper;
  return (
    <p className="note cut-off-note">
      {outsideCount > 0 && plotText.outside(outsideCount, formatCount(outsideCount), edge)}{" "}
      {partCount > 0 && plotText.cutOff(partCount, formatCount(partCount), edge)}
    </p>
  );
};
