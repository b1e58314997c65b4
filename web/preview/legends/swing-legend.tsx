/** The legend of the view mode "Pen (simulated)", which runs the simulation in a worker while it is shown. */
import { useEffect } from "react";
import { findMachine, type Springs } from "../../../src/internal.js";
import { ASKED_COLOR } from "../../scene/renderer.js";
import type { Actions } from "../../state/actions.js";
import type { PageStore, Swing } from "../../state/store.js";
import { useActions, usePageState, usePageStore } from "../../state/use-store.js";
import { Button } from "../../ui/button.js";
import { formatNumber } from "../../ui/format.js";
import type { Planned, SwingReply, SwingRequest } from "../../worker/protocol.js";
import { Ramp, scaleLabels } from "./legend.js";
import "./swing-legend.css";

const words = {
  legend: "Legend of the simulated pen",
  title: "Distance from the line",
  unit: "mm",
  working: (percent: string) => `Simulating the pen… ${percent} %`,
  atMost: (max: string, p99: string) => `At most ${max} mm, 99 % below ${p99} mm`,
  orMore: (mm: string) => `≥ ${mm}`,
  asked: "Planned line",
  measured: (x: string, y: string) => `Your plotter’s swing: ${x} Hz along x, ${y} Hz along y`,
  assumed: (x: string, y: string) => `Assumed swing: ${x} Hz along x, ${y} Hz along y.`,
  measure: "Measure yours…",
  failed: "The pen could not be simulated: the drawing may be too large for this device’s memory.",
};

/**
 * The legend of the simulated pen: colours, largest error, and the springs used. The simulation runs while it is
 * shown.
 */
export const SwingLegend = ({ planned }: { planned: Planned }) => {
  const store = usePageStore();
  const actions = useActions();
  const isPlanning = usePageState((state) => state.isPlanning);
  useEffect(
    () => (isPlanning ? undefined : simulatePen(store, actions, planned)),
    [store, actions, planned, isPlanning],
  );
  const swing = usePageState((state) => state.swing);
  return (
    <figure className="legend legend-rows swing-legend" aria-label={words.legend}>
      {swing?.result ? <Scale result={swing.result} /> : <Progress swing={swing} />}
      {swing && <Springs swing={swing} />}
    </figure>
  );
};

const Scale = ({ result: { error, topMm } }: { result: NonNullable<Swing["result"]> }) => {
  const labels = scaleLabels(0, topMm, topMm < 0.2 ? 3 : 2);
  const last = labels.length - 1;
  if (error.maxMm > topMm) labels[last] = words.orMore(labels[last]);
  return (
    <>
      <Ramp title={words.title} unit={words.unit} labels={labels} />
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

/** For a machine that was not measured: typical values of plotters with a long arm. */
const ASSUMED: Springs = { xHz: 15, yHz: 25, damping: 0.05 };

/** Returns a function that stops the simulation. There must be only one at a time. */
const simulatePen = (
  store: PageStore,
  { askStrokes }: Pick<Actions, "askStrokes">,
  planned: Planned,
): (() => void) => {
  let worker: Worker | null = null;
  let isStopped = false;
  const measured = findMachine(planned.settings)?.springs ?? null;
  const springs = measured ?? ASSUMED;
  let swing: Swing = {
    of: planned,
    springs,
    isAssumed: measured === null,
    share: 0,
    picture: null,
    result: null,
    fault: null,
  };
  const show = (change: Partial<Swing>): void => {
    swing = { ...swing, ...change };
    store.setState({ swing });
  };
  show({});
  askStrokes((strokes) => {
    if (isStopped || worker) return;
    worker = new Worker(new URL("../../worker/swing.worker.ts", import.meta.url), { type: "module" });
    worker.onerror = () => show({ fault: words.failed });
    worker.onmessage = ({ data }: MessageEvent<SwingReply>) => {
      if (data.type === "share") return show({ share: data.share });
      worker?.terminate();
      const { pieces, error, topMm } = data.picture;
      const { draw, travel, totalS } = planned.scene;
      show({ share: 1, picture: { draw: pieces, asked: draw, travel, totalS }, result: { error, topMm } });
    };
    // The unshaped plan is not needed here.
    const request: SwingRequest = { strokes, trajectory: { ...planned.trajectory, planned: null }, springs };
    worker.postMessage(request, [strokes.xy.buffer, strokes.offsets.buffer, strokes.layer.buffer]);
  });
  return () => {
    isStopped = true;
    worker?.terminate();
    store.setState({ swing: null });
  };
};
