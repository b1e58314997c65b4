/** The actions on a job, by their names in the HTTP interface and in the page's backend. */
import type { Job } from "../../src/schema/index.js";
import type { JobQueue } from "./job-queue.js";

export const jobActions = (queue: JobQueue) =>
  ({
    // Shortly after the host has started it is still looking for boards, so these two wait until it knows.
    start: async (id) => {
      await queue.plotterSettled(id);
      return queue.start(id);
    },
    recover: async (id) => {
      await queue.plotterSettled(id);
      return queue.recover(id);
    },
    pause: (id) => queue.pause(id),
    resume: (id) => queue.resume(id),
    cancel: (id) => queue.cancel(id),
    requeue: (id) => queue.requeue(id),
    "emergency-stop": (id) => queue.emergencyStop(id),
    "check-place": (id) => queue.checkPlace(id),
  }) satisfies Record<string, (id: string) => Job | Promise<Job>>;
