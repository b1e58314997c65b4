import { usePageState } from "../state/use-store.js";
import { formatCount } from "../ui/format.js";
import { plotText } from "./text.js";

/** How many lines are not drawn, or only in part, and why. */
export const CutOffNote = () => {
  const cutOff = usePageState((state) => state.planned?.cutOff ?? null);
  if (!cutOff) return null;
  const { outsideCount, partCount } = cutOff;
  return (
    <p className="note cut-off-note">
      {outsideCount > 0 && plotText.outside(outsideCount, formatCount(outsideCount))}{" "}
      {partCount > 0 && plotText.cutOff(partCount, formatCount(partCount))}
    </p>
  );
};
