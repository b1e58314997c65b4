/** Simulates the pen of a swinging machine, in parallel with the page and the planning. */
import { swingPicture } from "../scene/swing-scene.js";
import type { SwingReply, SwingRequest } from "./protocol.js";

interface WorkerScope {
  onmessage: ((event: MessageEvent<SwingRequest>) => void) | null;
  postMessage(reply: SwingReply, transfer: Transferable[]): void;
}
const scope = self as unknown as WorkerScope;

/** The share of the plot between two progress reports. */
const REPORT_SHARE = 0.02;

scope.onmessage = ({ data: { strokes, trajectory, springs } }) => {
  let reported = 0;
  const picture = swingPicture(strokes, trajectory, springs, (share) => {
    if (share < reported + REPORT_SHARE) return;
    reported = share;
    scope.postMessage({ type: "share", share }, []);
  });
  scope.postMessage({ type: "done", picture }, [picture.pieces.bytes]);
};
