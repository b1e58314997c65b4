/** The plug-in that shares jobs with other servers through PostgreSQL. */
import { randomUUID } from "node:crypto";
import { hostname } from "node:os";
import { claimsWithoutSharing } from "../../queue/shared-claims.js";
import type { Store } from "../../storage/store.js";
import type { PluginCore, ServerPlugin } from "../server-plugin.js";
import { SharedQueue } from "./shared-queue.js";
import { sharedJobOperations } from "./shared-job-operations.js";
import { SharedStore } from "./shared-store.js";

export interface SharedQueueOptions {
  /** postgres://… */
  readonly url: string;
  readonly pollMs?: number | undefined;
  readonly lostAfterMs?: number | undefined;
  readonly timeoutMs?: number | undefined;
}

export function sharedQueuePlugin(options: SharedQueueOptions, { store, log }: PluginCore): ServerPlugin {
  const { url, pollMs, lostAfterMs, timeoutMs } = options;
  const unopened = claimsWithoutSharing(store);
  let shared: SharedQueue | null = null;
  return {
    name: "the shared queue",
    jobs: {
      afterChange: () => shared?.wake(),
      claims: {
        claim: (jobId) => (shared ?? unopened).claim(jobId),
        release: (jobId) => (shared ?? unopened).release(jobId),
      },
    },
    start: async ({ queue, files, uploads, plotters, notices }) => {
      const queueOfServers = new SharedQueue({
        shared: await SharedStore.open(url, log, timeoutMs),
        serverId: serverIdIn(store),
        serverName: hostname(),
        store,
        queue,
        files,
        plotters,
        log,
        notice: (message) => notices.add(message),
        pollMs,
        lostAfterMs,
      });
      shared = queueOfServers;
      return {
        operations: { sharedJobs: sharedJobOperations(queueOfServers, files, uploads) },
        close: () => queueOfServers.close(),
      };
    },
  };
}

/** Stays the same over restarts, so that the server finds the jobs it took before. */
function serverIdIn(store: Store): string {
  const stored = store.setting("server-id");
  if (typeof stored === "string") return stored;
  const id = randomUUID();
  store.saveSetting("server-id", id);
  return id;
}
