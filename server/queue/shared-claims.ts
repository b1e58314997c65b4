/** Claims of a server that is not connected to the shared queue. */
import type { Store } from "../storage/store.js";
import type { Claims } from "../../host/queue/queue-parts.js";

/** Jobs taken from the shared queue can't start, since they may have been given to another server meanwhile. */
export function claimsWithoutSharing(store: Pick<Store, "unreportedShared">): Claims {
  return {
    claim: (jobId) => {
      const isShared = store.unreportedShared().some((one) => one.jobId === jobId);
      return Promise.resolve(
        isShared
          ? "This job is from the shared queue, so another server may have been given it. Start this server with --shared-queue, or duplicate the job and start the copy."
          : null,
      );
    },
    release: () => Promise.resolve(),
  };
}
