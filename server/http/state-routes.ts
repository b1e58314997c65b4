/** The server's whole state, its event stream, the caller, the API itself. */
import type { Request } from "express";
import type { Snapshot } from "../../src/schema/index.js";
import type { PlotterRegistry } from "../../host/plotter/plotter-registry.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { Notices } from "../../host/queue/notices.js";
import type { Access } from "../security/access.js";
import type { OperatorLock } from "../security/operator-lock.js";
import type { MachineFiles } from "../storage/machine-files.js";
import { callerOf } from "./auth.js";
import type { Browsers } from "./browser.js";
import type { EventHub } from "./events.js";
import type { Responders } from "./operation-routes.js";

export interface StateParts {
  readonly version: string;
  readonly queue: JobQueue;
  readonly registry: PlotterRegistry;
  readonly hub: EventHub;
  readonly operatorLock: OperatorLock;
  readonly notices: Notices;
  /** Sessions and keys; normally required only of clients on other computers. */
  readonly access: Access;
  /** The server's mDNS name, which it accepts as Host; null while it has none. */
  readonly localName: () => string | null;
  /** Built-in and custom machine profiles. */
  readonly machines: MachineFiles;
}

/** `openApi`: the text of the OpenAPI document. */
export const stateResponders = (parts: StateParts, browsers: Browsers, openApi: () => Promise<string>) => {
  const { queue, registry, operatorLock, hub } = parts;
  const snapshot = (): Snapshot => ({
    version: parts.version,
    plotters: registry.list(),
    plotterSettings: registry.settings(),
    queue: queue.settings(),
    queues: queue.allSettings(),
    operator: operatorLock.operator,
    serverNotices: parts.notices.list(),
    localName: parts.localName(),
    machines: parts.machines.list(),
    ...queue.recent(),
  });
  const callerIdOf = (request: Request): string => callerOf(request, parts.access)?.id ?? "";
  return {
    openApi: async (_request, response) => {
      response.type("json").send(await openApi());
    },
    get: async (request, response) => {
      await hub.answer(response, callerIdOf(request), snapshot);
    },
    events: async (request, response) => {
      const browser = browsers.of(request);
      if (browser !== null) request.on("close", operatorLock.streamOpened(browser.id));
      await hub.open(request, response, callerIdOf(request), snapshot);
    },
    me: (request, response) => {
      const { id = null, name = null } = browsers.of(request) ?? {};
      response.json({ role: callerOf(request, parts.access)?.role, id, name });
    },
  } satisfies Responders["state"];
};
