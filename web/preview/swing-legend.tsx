import { useEffect } from "react";
import { ASKED_COLOR } from "../scene/renderer.js";
import type { Swing } from "../state/store.js";
import { useActions, usePageState, usePageStore } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { formatNumber } from "../ui/format.js";
import type { Planned } from "../worker/protocol.js";
import { simulatePen } from "./simulate-pen.js";
import { swingText as words } from "./swing-text.js";
import "./swing-legend.css";

const LABELS = 5;

/**
 * The legend of the simulated pen: colours, largest error, and the springs used. The simulation runs while it is
 * shown.
 */
export const SwingLegend = ({ planned, gradient }: { planned: Planned; gradient: string }) => {
  const store = usePageStore();
  const actions = useActions();
  const isPlanning = usePageState((state) => state.isPlanning);
  useEffect(
    () => (isPlanning ? undefined : simulatePen(store, actions, planned)),
    [store, actions, planned, isPlanning],
  );
  const swing = usePageState((state) => state.swing);
  return (
    <figure className="legend swing-legend" aria-label={words.legend}>
      {swing?.result ? <Scale result={swing.result} gradient={gradient} /> : <Progress swing={swing} />}
      {swing && <Springs swing={swing} />}
    </figure>
  );
};

const Scale = ({ result, gradient }: { result: NonNullable<Swing["result"]>; gradient: string }) => {
  const { error, topMm } = result;
  const digits = topMm < 0.2 ? 3 : 2;
  return (
    <>
      <figcaption>
        <span>{words.title}</span>
        <span>{words.unit}</span>
      </figcaption>
      <div className="legend-bar" style={{ background: gradient }} />
      <div className="legend-labels" aria-hidden="true">
        {Array.from({ length: LABELS }, (_, i) => {
          const mm = formatNumber((topMm * i) / (LABELS - 1), digits);
          return <span key={i}>{i === LABELS - 1 && error.maxMm > topMm ? words.orMore(mm) : mm}</span>;
        })}
      </div>
      <p className="swing-most" role="status" data-max-mm={error.maxMm} data-top-mm={topMm}>
        {words.atMost(formatNumber(error.maxMm, 2), formatNumber(error.p99Mm, 2))}
      </p>
      <p className="swing-asked">
        <span className="swatch" style={{ backgroundColor: ASKED_COLOR }} />
        {words.asked}
      </p>
    </>
  );
};

const Progress = ({ swing }: { swing: Swing | null }) => {
  if (swing?.fault) return <p className="note-error">{swing.fault}</p>;
  const percent = Math.round(100 * (swing?.share ?? 0));
  return (
    <>
      <figcaption>{words.working(String(percent))}</figcaption>
      <progress aria-label={words.title} max={100} value={percent} />
    </>
  );
};

const Springs = ({ swing: { springs, isAssumed } }: { swing: Swing }) => {
  const { openDialog } = useActions();
  const [x, y] = [springs.xHz, springs.yHz].map((hz) => formatNumber(hz, 1));
  if (!isAssumed) return <p className="swing-springs">{words.measured(x, y)}</p>;
  return (
    <p className="swing-springs">
      {words.assumed(x, y)}{" "}
      <Button kind="link" onClick={() => openDialog("ringing")}>
        {words.measure}
      </Button>
    </p>
  );
};
