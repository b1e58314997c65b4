/** The thread in which `plotwright plan` runs; plan-thread.ts starts it. */
import { parentPort, workerData } from "node:worker_threads";
import { faultOf, type Fault } from "../../../host/planning/messages.js";
import { mustFitMemory } from "../../planning/planning-limits.js";
import { inFont } from "../../planning/read-drawing.js";
import { runPlan, type PlanOutput } from "./plan.js";
import type { FromPlanThread, PlanThreadData } from "./plan-thread.js";

const { file, settings, options, growthMb } = workerData as PlanThreadData;
const post = (message: FromPlanThread): void => parentPort?.postMessage(message);

let fault: Fault | null = null;
try {
  const output: PlanOutput = {
    out: (text) => post({ type: "out", text }),
    err: (text) => post({ type: "err", text }),
    imported: (drawing) => mustFitMemory(drawing, growthMb),
    begin: (step) => post({ type: "begin", step }),
  };
  await runPlan(file, settings, options, output, await inFont(options.font));
} catch (error) {
  fault = faultOf(error);
}
post({ type: "done", fault });
