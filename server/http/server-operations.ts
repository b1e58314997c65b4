/** The operations of a server: those of every host, and those about its state, its files, its users and its log. */
import type { RequestHandler } from "express";
import { readFile, readdir } from "node:fs/promises";
import { join } from "node:path";
import { PlotwrightError } from "../../src/index.js";
import type { BoxMm, Pairing, Snapshot } from "../../src/schema/index.js";
import { hostOperations } from "../../host/operations/host-operations.js";
import { lane } from "../../host/planning/lane.js";
import { drawingBoxMm } from "../planning/planner.js";
import type { DrawingFiles } from "../storage/drawing-files.js";
import type { LibraryFiles } from "../storage/library-files.js";
import { bundleText } from "../storage/log-book.js";
import type { UploadedDrawings } from "../../host/queue/uploaded-drawings.js";
import type { Access } from "../security/access.js";
import type { Browsers } from "./browser.js";
import { jobResponders } from "./job-routes.js";
import { libraryOperations, libraryResponders } from "./library-routes.js";
import { liveResponders, type LiveSockets } from "./live-routes.js";
import { bytesOf, submitterOf, type Responders, type ServerHandlers } from "./operation-routes.js";
import type { PlotterRegistry } from "../../host/plotter/plotter-registry.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { Notices } from "../../host/queue/notices.js";
import type { OperatorLock } from "../security/operator-lock.js";
import type { MachineFiles } from "../storage/machine-files.js";
import { callerIn, type Caller } from "./auth.js";
import type { EventHub, Viewer } from "./events.js";

export interface ServerParts {
  readonly version: string;
  readonly queue: JobQueue;
  readonly registry: PlotterRegistry;
  readonly hub: EventHub;
  readonly lives: LiveSockets;
  readonly operatorLock: OperatorLock;
  readonly notices: Notices;
  /** Sessions and keys; normally required only of clients on other computers. */
  readonly access: Access;
  /** The server's mDNS name, which it accepts as Host; null while it has none. */
  readonly localName: () => string | null;
  /** Built-in and custom machine profiles. */
  readonly machines: MachineFiles;
  readonly files: DrawingFiles;
  readonly library: LibraryFiles;
  readonly uploads: UploadedDrawings;
  /** Operations of the plug-ins that are loaded. */
  readonly plugins: readonly ServerHandlers[];
  /** Links that pair a device. */
  readonly pairing: () => Promise<Pairing>;
  /** The server's log so far. */
  readonly serverLog: () => Promise<string>;
  /** Folder with the samples. */
  readonly samplesDir: string;
  readonly log: (line: string) => void;
}

/** Those of the plug-ins included. */
export const serverHandlers = (parts: ServerParts): ServerHandlers => {
  const host = hostOperations({
    ...parts,
    storeText: (text) => parts.files.add([Buffer.from(text, "utf8")]),
    jobBoxMm: jobBoxMm(parts),
  });
  return {
    ...host,
    samples: sampleOperations(parts.samplesDir),
    operator: {
      ...host.operator,
      pairing: () => parts.pairing(),
      logs: async () =>
        bundleText({
          version: parts.version,
          serverLog: await parts.serverLog(),
          jobs: parts.queue.list(),
          plotters: [...parts.registry.ports.values()].map((port) => ({
            plotter: port.snapshot(),
            log: port.log(),
          })),
        }),
    },
    access: accessOperations(parts.access),
    library: libraryOperations(parts),
    ...parts.plugins.reduce((all, one) => ({ ...all, ...one }), {}),
  };
};

/** `openApi`: the text of the OpenAPI document. */
export const serverResponders = (
  parts: ServerParts,
  browsers: Browsers,
  openApi: () => Promise<string>,
): Responders => ({
  state: stateResponders(parts, browsers, openApi),
  drawings: { upload: receiveDrawing(parts) },
  jobs: jobResponders(parts),
  library: libraryResponders(parts),
  liveDrawings: liveResponders(parts, browsers),
  operator: {
    take: (request, response) => {
      const browser = browsers.of(request);
      if (browser === null) {
        throw new PlotwrightError(
          "bad-setting",
          "Only a browser can take over; scripts may act at any time.",
        );
      }
      response.json({ operator: parts.operatorLock.take(browser) });
    },
  },
});

const accessOperations = (access: Access) =>
  ({
    list: () => ({ entries: access.list() }),
    addKey: ({ name, role }) => access.createKey(name, role),
    revoke: (id) => access.revoke(id),
  }) satisfies ServerHandlers["access"];

const receiveDrawing =
  ({ files, uploads }: ServerParts): RequestHandler<Record<string, string>> =>
  async (request, response) => {
    if (request.is("multipart/*") !== false) {
      throw new PlotwrightError(
        "bad-setting",
        "The body must be the file itself. Send a form to POST /jobs.",
      );
    }
    const drawing = await files.addFile(bytesOf(request));
    uploads.keep(drawing, submitterOf(request, response)?.id);
    response.status(201).json({ id: drawing.id });
  };

/** Measures the drawings of two jobs at a time. */
function jobBoxMm({ queue, files }: ServerParts): (id: string) => Promise<BoxMm> {
  const turn = lane(2);
  return (id) =>
    turn({ client: id }, () => drawingBoxMm(files.path(queue.drawingOf(id)), queue.get(id).settings));
}

/** The drawings that come with plotwright. */
const sampleOperations = (dir: string) => {
  const names = async (): Promise<string[]> =>
    (await readdir(dir).catch(() => [])).filter((name) => name.endsWith(".svg")).sort();
  return {
    list: async () => ({ samples: (await names()).map((name) => ({ name, title: titleOf(name) })) }),
    // Only names in the listing are opened, so no name can refer to a file outside the folder.
    get: async (name) => {
      if ((await names()).includes(name)) return readFile(join(dir, name), "utf8");
      throw new PlotwrightError("not-found", `There is no sample ${name}.`);
    },
  } satisfies ServerHandlers["samples"];
};

/** "many-short-strokes.svg" -> "Many short strokes" */
function titleOf(name: string): string {
  const words = name.replace(/\.svg$/, "").replaceAll("-", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}

const viewerOf = ({ id, role }: Caller): Viewer => ({ id, seesOnlyOwn: role === "submit" });

/** `openApi`: the text of the OpenAPI document. */
const stateResponders = (parts: ServerParts, browsers: Browsers, openApi: () => Promise<string>) => {
  const { queue, registry, operatorLock, hub } = parts;
  const snapshot = (submitterId?: string): Snapshot => ({
    version: parts.version,
    plotters: registry.list(),
    plotterSettings: registry.settings(),
    queue: queue.settings(),
    queues: queue.allSettings(),
    operator: operatorLock.operator,
    // They name the drawings of others.
    serverNotices: submitterId === undefined ? parts.notices.list() : [],
    localName: parts.localName(),
    machines: parts.machines.list(),
    ...queue.recent(submitterId),
  });
  return {
    openApi: async (_request, response) => {
      response.type("json").send(await openApi());
    },
    get: async (_request, response) => {
      await hub.answer(response, viewerOf(callerIn(response)), snapshot);
    },
    events: async (request, response) => {
      const browser = browsers.of(request);
      if (browser !== null) request.on("close", operatorLock.streamOpened(browser.id));
      await hub.open(request, response, viewerOf(callerIn(response)), snapshot);
    },
    me: (request, response) => {
      const { id = null, name = null } = browsers.of(request) ?? {};
      response.json({ role: callerIn(response).role, id, name });
    },
  } satisfies Responders["state"];
};
