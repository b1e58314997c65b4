import type { Job, PlotSettings } from "../../../src/schema/index.js";
import { mayOperate, penOf } from "../../state/store.js";
import { useActions, usePageState } from "../../state/use-store.js";
import { nudgeText as words } from "./text.js";
import { Button, IconButton } from "../../ui/button.js";
import { formatNumber } from "../../ui/format.js";
import { usePenChange } from "../../ui/use-change.js";
import "./nudge.css";

/** Enough to see a difference on the paper, and little enough to be safe. */
const STEP_PCT = 1;
type Heights = Pick<PlotSettings["pen"], "upPct" | "downPct">;

interface NudgeProps {
  readonly heights: Heights;
  readonly isOff?: boolean;
  onChange(which: keyof Heights, pct: number): void;
}

/** Both heights; each press changes one a little. */
const Nudge = ({ heights, isOff = false, onChange }: NudgeProps) => (
  <div className="nudge" role="group" aria-label={words.title}>
    {(["upPct", "downPct"] as const).map((which) => {
      const label = which === "upPct" ? words.up : words.down;
      const pct = heights[which];
      const move = (by: number): void => onChange(which, Math.min(100, Math.max(0, pct + by)));
      return (
        <div key={which} className="nudge-row">
          <span>{label}</span>
          <IconButton
            icon="minus"
            label={words.less(label)}
            disabled={isOff}
            onClick={() => move(-STEP_PCT)}
          />
          <output>{formatNumber(pct, 1)} %</output>
          <IconButton icon="plus" label={words.more(label)} disabled={isOff} onClick={() => move(STEP_PCT)} />
        </div>
      );
    })}
  </div>
);

/** Changes the running plot's heights at once. */
export const NudgeJob = ({ job }: { job: Job }) => {
  const { changeJobPen } = useActions();
  const pen = usePageState((state) => penOf(state, job));
  return <Nudge heights={pen} onChange={(which, pct) => void changeJobPen(job, { [which]: pct })} />;
};

/** Offers to keep the heights that were found while this job plotted. */
export const KeepHeights = ({ job }: { job: Job }) => {
  const found = usePageState((state) => penOf(state, job));
  const own = usePageState((state) => state.settings.pen);
  const isOffered = usePageState((state) => state.nudgedJobId === job.id && mayOperate(state));
  const change = usePenChange();
  if (!isOffered) return null;
  return (["upPct", "downPct"] as const)
    .filter((which) => found[which] !== own[which])
    .map((which) => (
      <p key={which} className="keep-height">
        {words.keep(which === "upPct" ? words.up : words.down, formatNumber(found[which], 1))}
        <Button kind="small" onClick={() => change({ [which]: found[which] })}>
          {words.keepIt}
        </Button>
      </p>
    ));
};

/** Changes the heights in the settings and moves the pen there to show it. */
export const NudgeSettings = ({ isOff }: { isOff: boolean }) => {
  const { movePen } = useActions();
  const change = usePenChange();
  const pen = usePageState((state) => state.settings.pen);
  return (
    <Nudge
      heights={pen}
      isOff={isOff}
      onChange={(which, pct) => {
        change({ [which]: pct });
        void movePen(which === "upPct", pct);
      }}
    />
  );
};
