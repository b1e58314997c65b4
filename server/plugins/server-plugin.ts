/**
 * The interface of optional parts of the server. Each plug-in has a folder beside this file, whose `plugin.ts` exports a
 * function that creates it. Only `composition/load-plugins.ts` imports plug-ins, and only if an option of the server
 * asks for them.
 *
 *   created ──the queue loads its jobs──> start(host) ──the port is open──> listening(address) ──> close()
 */
import type { ServerHandlers } from "../http/operation-routes.js";
import type { PlotterPort } from "../../host/plotter/plotter-port.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { Notices } from "../../host/queue/notices.js";
import type { JobHooks, Claims } from "../../host/queue/queue-parts.js";
import type { ServerEvent } from "../../src/schema/index.js";
import type { DrawingFiles } from "../storage/drawing-files.js";
import type { Store } from "../storage/store.js";
import type { UploadedDrawings } from "../../host/queue/uploaded-drawings.js";

export interface ServerPlugin {
  /** Its name in the log when the server closes, such as "the webhooks". */
  readonly name: string;
  /** Called by the queue from the first change on, also before `start`. */
  readonly jobs?: JobHooks;
  start(host: PluginHost): Promise<RunningPlugin> | RunningPlugin;
}

export interface RunningPlugin {
  readonly operations?: ServerHandlers;
  /** Called after each change of plotters and jobs, and many times a second while one plots. Never throws. */
  onEvent?(event: ServerEvent): void;
  /** The server accepts requests. */
  listening?(address: ServerAddress): void;
  close(): Promise<void> | void;
}

interface ServerAddress {
  readonly port: number;
  readonly isTls: boolean;
}

/** The parts of the server that exist before the queue, when a plug-in is created. */
export interface PluginCore {
  readonly store: Store;
  /** By id; plotters may be added and removed while the server runs. */
  readonly plotters: ReadonlyMap<string, PlotterPort>;
  readonly log: (line: string) => void;
  /** The server's folder for its data. */
  readonly dataDir: string;
}

export interface PluginHost extends PluginCore {
  readonly queue: JobQueue;
  readonly files: DrawingFiles;
  readonly uploads: UploadedDrawings;
  readonly notices: Notices;
  /** Sets the name that the server answers to and shows to its users; null: none. */
  readonly setLocalName: (name: string | null) => void;
}

/**
 * The claims of a server that is not connected to the shared queue. Jobs taken from there can't start, since they may
 * have been given to another server meanwhile.
 */
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
