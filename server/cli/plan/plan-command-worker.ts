/** The thread in which `plotwright plan` runs; plan-thread.ts starts it. */
import { parentPort, workerData } from "node:worker_threads";
import { faultOf, type Fault } from "../../../host/planning/messages.js";
import { mustFitMemory } from "../../planning/planning-limits.js";
import { runPlan } from "./plan.js";
import type { FromPlanThread, PlanThreadData } from "./plan-thread.js";

const { file, settings, options, growthMb } = workerData as PlanThreadData;
const post = (message: FromPlanThread): void => parentPort?.postMessage(message);

let fault: Fault | null = null;
try {
  runPlan(file, settings, options, {
    out: (text) => post({ type: "out", text }),
    err: (text) => post({ type: "err", text }),
    imported: (drawing) => mustFitMemory(drawing, growthMb),
    begin: (step) => post({ type: "begin", step }),
  });
} catch (error) {
  fault = faultOf(error);
}
post({ type: "done", fault });
