/** Runs the worker that simulates the pen on the current plan. */
import { findMachine, type Springs } from "../../src/internal.js";
import type { Actions } from "../state/actions.js";
import type { PageStore, Swing } from "../state/store.js";
import type { Planned } from "../worker/protocol.js";
import type { SwingReply, SwingRequest } from "../worker/swing-protocol.js";
import { swingText } from "./swing-text.js";

/** For a machine that was not measured: typical values of plotters with a long arm. */
const ASSUMED: Springs = { xHz: 15, yHz: 25, damping: 0.05 };

/** Returns a function that stops the simulation. There must be only one at a time. */
export const simulatePen = (
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
    worker = new Worker(new URL("../worker/swing.worker.ts", import.meta.url), { type: "module" });
    worker.onerror = () => show({ fault: swingText.failed });
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
