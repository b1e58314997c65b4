/** The methods that pages call on the host. Arguments are checked by the schemas of src/schema. */
import { PlotwrightError, type MachineProfile } from "../../../src/index.js";
import { machineProfileSchema } from "../../../src/schema/index.js";
import type { CustomMachines } from "../../../host/custom-machines.js";
import type { Notices } from "../../../host/queue/notices.js";
import type { JobAction } from "../backend.js";
import { parseWith } from "../../../host/parse-with.js";
import { jobApi, type JobApiParts } from "./job-api.js";
import { plotterApi, type PlotterApiParts } from "./plotter-api.js";

interface HostParts extends JobApiParts, PlotterApiParts {
  readonly machines: CustomMachines;
  readonly notices: Notices;
}

export type HostApi = ReturnType<typeof hostApi>;
export type HostMethod = keyof HostApi;

export const hostApi = (parts: HostParts) => {
  const { queue, notices, machines } = parts;
  return {
    ...jobApi(parts),
    ...plotterApi(parts),
    dismissNotice: (id: string): void => notices.remove(id),

    saveMachine: (profile: MachineProfile): MachineProfile =>
      machines.save(parseWith(machineProfileSchema, profile)),
    removeMachine: (id: string): void => machines.remove(id),

    /** After this the host's worker stops being the host, and the calling page's worker becomes the host. */
    handOver: (): void => {
      if (queue.list().some(({ state }) => state === "plotting" || state === "paused")) {
        throw new PlotwrightError(
          "busy",
          "The other tab is plotting. Wait until the plot ends, or cancel it; you can cancel it from here.",
        );
      }
    },
  };
};

/** Methods that change nothing: all pages may call them. */
export const READING: readonly HostMethod[] = [
  "olderJobs",
  "jobDrawing",
  "devices",
  "usbIds",
  "log",
  "handOver",
];
/** Actions that only stop a plot: all pages may call them. */
export const STOPPING: readonly JobAction[] = ["pause", "cancel", "emergency-stop"];
