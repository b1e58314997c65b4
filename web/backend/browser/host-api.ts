/** What pages can ask of the host: operations of the table, and what only this host has. */
import { PlotwrightError } from "../../../src/index.js";
import type { OperationHandlers, Plotter } from "../../../src/schema/index.js";
import { hostOperations, type HostParts } from "../../../host/operations/host-operations.js";
import type { Requester } from "../../../host/planning/lane.js";
import { findPlotter } from "../../../host/queue/find-plotter.js";
import type { DrawingText } from "../drawing-text.js";
import { portFilters } from "../../serial/port-filters.js";
import { browserText } from "./text.js";

interface BrowserParts extends Omit<HostParts, "storeText" | "jobBoxMm" | "log"> {
  readonly drawings: {
    /** Resolves with the drawing's id when it is stored. */
    add(drawing: DrawingText): Promise<string>;
    read(id: string): Promise<DrawingText>;
  };
}

/** The size of text is only estimated by its length, because it is not encoded. */
const sizeOf = (drawing: DrawingText): number =>
  typeof drawing === "string" ? drawing.length : drawing.byteLength;

export const browserOperations = (parts: BrowserParts): OperationHandlers<Requester> => {
  const { queue, drawings, uploads } = parts;
  const storeText = async (drawing: DrawingText) => {
    if (sizeOf(drawing) === 0) throw new PlotwrightError("bad-file", "The file is empty.");
    return { id: await drawings.add(drawing), bytes: sizeOf(drawing) };
  };
  const host = hostOperations({
    ...parts,
    storeText,
    jobBoxMm: () => Promise.reject(new PlotwrightError("not-allowed", browserText.needsServer)),
    log: () => undefined,
  });
  return {
    ...host,
    drawings: {
      upload: async (drawing) => {
        const stored = await storeText(drawing);
        uploads.keep(stored);
        return { id: stored.id };
      },
    },
    jobs: { ...host.jobs, drawing: (id) => drawings.read(queue.drawingOf(id)) },
  };
};

/** What only this host has. */
export type OwnMethods = ReturnType<typeof ownMethods>;

export const ownMethods = ({ queue, registry }: Pick<BrowserParts, "queue" | "registry">) => ({
  /** Called after the user has allowed the page to use a port: the plotter searches for its board again. */
  reconnect: async (id: string): Promise<Plotter> => {
    if (registry.stored(id)?.device === "auto") await registry.reconnect(id, queue);
    else await registry.patch(id, { device: "auto" }, queue);
    const plotter = findPlotter(registry.ports, id);
    await plotter.settled();
    // On the virtual plotter a chosen port would be ignored silently.
    if (plotter.snapshot().kind === "virtual") throw new PlotwrightError("no-board", browserText.noneAnswers);
    return plotter.snapshot();
  },
  /** For the browser's dialog of ports. The host has them, so that the page does not load the drivers. */
  portFilters: () => portFilters(),
  /** After this the host's worker stops being the host, and the calling page's worker becomes the host. */
  handOver: (): void => {
    if (queue.list().some(({ state }) => state === "plotting" || state === "paused")) {
      throw new PlotwrightError(
        "busy",
        "The other tab is plotting. Wait until the plot ends, or cancel it; you can cancel it from here.",
      );
    }
  },
});
