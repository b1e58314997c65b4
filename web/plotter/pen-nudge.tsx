import type { Job, PlotSettings } from "../../src/schema/index.js";
import { useActions, usePageState } from "../state/use-store.js";
import { nudgeText } from "./hand-text.js";
import { formatNumber } from "../ui/format.js";
import { IconButton } from "../ui/icon-button.js";
import "./nudge.css";

const words = nudgeText;
/** Enough to be seen on the paper, little enough to be safe. */
const STEP_PCT = 1;
type Heights = Pick<PlotSettings["pen"], "upPct" | "downPct">;

interface NudgeProps {
  readonly heights: Heights;
  readonly isOff?: boolean;
  onChange(which: keyof Heights, pct: number): void;
}

/** Both heights, a little higher or lower with each press. */
const Nudge = ({ heights, isOff = false, onChange }: NudgeProps) => (
  <div className="nudge" role="group" aria-label={words.title}>
    {(["upPct", "downPct"] as const).map((which) => {
      const label = which === "upPct" ? words.up : words.down;
      const pct = heights[which];
      const move = (by: number): void => onChange(which, Math.min(100, Math.max(0, pct + by)));
      return (
        <div key={which} className="nudge-row">
          <span>{label}</span>
          <IconButton icon="minus" label={words.less(label)} isOff={isOff} onClick={() => move(-STEP_PCT)} />
          <output>{formatNumber(pct, 1)} %</output>
          <IconButton icon="plus" label={words.more(label)} isOff={isOff} onClick={() => move(STEP_PCT)} />
        </div>
      );
    })}
  </div>
);

/** Of a plot under way: it takes the new height at once, and keeps it. */
export const NudgeJob = ({ job }: { job: Job }) => {
  const { changeJob } = useActions();
  const { pen } = job.settings;
  return (
    <Nudge
      heights={pen}
      onChange={(which, pct) => void changeJob(job.id, { pen: { ...pen, [which]: pct } })}
    />
  );
};

/** With nothing under way: the pen goes there, so that one sees it. */
export const NudgeSettings = ({ isOff }: { isOff: boolean }) => {
  const { changeSettings, movePen } = useActions();
  const pen = usePageState((state) => state.settings.pen);
  return (
    <Nudge
      heights={pen}
      isOff={isOff}
      onChange={(which, pct) => {
        changeSettings(`pen ${which}`, (settings) => ({
          ...settings,
          pen: { ...settings.pen, [which]: pct },
        }));
        void movePen(which === "upPct", pct);
      }}
    />
  );
};
