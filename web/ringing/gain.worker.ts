/** Plans the test figure of ringing-gain.ts. In a worker, so that the page never loads the planners itself. */
import { gainsOf, type Gain, type GainRequest } from "./ringing-gain.js";

interface WorkerScope {
  onmessage: ((event: MessageEvent<GainRequest>) => void) | null;
  postMessage(gains: readonly Gain[]): void;
}
const scope = self as unknown as WorkerScope;

scope.onmessage = ({ data: { machine, springs } }) => scope.postMessage(gainsOf(machine, springs));
