/** `plotwright plan` in a separate thread, which is ended if the file takes too long. */
import { PlotwrightError } from "../../../src/index.js";
import type { PlotSettings } from "../../../src/schema/index.js";
import { BoundedThread } from "../../planning/bounded-thread.js";
import type { Fault } from "../../../host/planning/messages.js";
import {
  importLimit,
  planLimit,
  prepareLimit,
  PLANNING_LIMITS,
  type PlanningLimits,
} from "../../planning/planning-limits.js";
import type { CliIo } from "../io.js";
import type { PlanCommandOptions, PlanStep } from "./plan.js";

export interface PlanThreadInput {
  readonly file: string;
  readonly settings: PlotSettings;
  readonly options: PlanCommandOptions;
}

export interface PlanThreadData extends PlanThreadInput {
  /** How much memory planning may take. */
  readonly growthMb: number;
}

export type FromPlanThread =
  | { readonly type: "out"; readonly text: string }
  | { readonly type: "err"; readonly text: string }
  | { readonly type: "begin"; readonly step: PlanStep }
  | { readonly type: "done"; readonly fault: Fault | null };

/** Throws what `runPlan` throws, and `bad-file` or `too-large` if a step takes too long. */
export function runPlanInThread(
  input: PlanThreadInput,
  io: Pick<CliIo, "out" | "err">,
  limits: PlanningLimits = PLANNING_LIMITS,
): Promise<void> {
  return new Promise((resolve, reject) => {
    const name = "plan-command-worker";
    const { heapMb, growthMb } = limits;
    const workerData: PlanThreadData = { ...input, growthMb };
    const start = { name, starterUrl: import.meta.url, workerData, heapMb, growthMb };
    const thread = new BoundedThread<FromPlanThread>(start, {
      message: (message) => {
        if (message.type === "out") io.out(message.text);
        else if (message.type === "err") io.err(message.text);
        else if (message.type === "begin") {
          thread.allow(
            message.step === "plan" ? planLimit(limits) : prepareLimit(limits, input.settings.prepare),
          );
        } else if (message.fault === null) resolve();
        else reject(new PlotwrightError(message.fault.code, message.fault.message));
      },
      ended: reject,
    });
    thread.allow(importLimit(limits));
  });
}
