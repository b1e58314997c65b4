/** The page's backend without a server: a worker of the page, or of another tab, operates the plotter. */
import { textOf, type DrawingText } from "../../worker/drawing-text.js";
import { BackendFault, type Backend, type StudioBackend } from "../backend.js";
import { whyNoPort } from "./capabilities.js";
import { HostClient } from "./host-client.js";
import { sampleList, sampleText, type SampleFiles } from "./samples.js";
import { browserText } from "./text.js";
import { watchOverPlots } from "./while-plotting.js";

/** `?virtual-speed=50`: how many times faster than real time the virtual board runs. */
const virtualSpeed = (): number => {
  const speed = Number(new URLSearchParams(location.search).get("virtual-speed") ?? 1);
  return speed >= 1 && speed <= 1_000 ? speed : 1;
};

/** `sampleFiles`: the files of samples/ in the build. */
export const createBrowserBackend = (sampleFiles: SampleFiles): Backend => {
  const client = new HostClient(virtualSpeed());
  const { remote, tab } = client;
  watchOverPlots(client);
  return {
    features: { sharing: false, asksForPort: true, whyNoPort: whyNoPort() },
    listen: (listener) => client.listen(listener),

    addJob: (job, drawing) => remote.addJob(job, drawing),
    patchJob: (id, patch) => remote.patchJob(id, patch),
    actOnJob: (id, action) => remote.actOnJob(id, action),
    changeJob: (id, change) => remote.changeJob(id, change),
    movePlace: (id, by) => remote.movePlace(id, by),
    moveJob: (id, beforeId) => remote.moveJob(id, beforeId),
    duplicateJob: (id) => remote.duplicateJob(id),
    removeJob: (id) => remote.removeJob(id),
    olderJobs: (wanted) => remote.olderJobs(wanted),
    jobDrawing: (id) => remote.jobDrawing(id),
    setQueue: (plotterId, settings) => remote.setQueue(plotterId, settings),

    me: () => Promise.resolve({ role: "operate", id: tab, name: null }),
    takeOver: async () => {
      await client.takeOver();
      return { id: tab, name: "" };
    },
    dismissNotice: (id) => remote.dismissNotice(id),

    savePlotterSettings: (id, settings) => remote.savePlotterSettings(id, settings),
    setPlotterMachine: (id, machine) => remote.patchPlotter(id, { machine }),
    movePen: (id, request) => remote.movePen(id, request),
    motorsOff: (id) => remote.motorsOff(id),
    moveByHand: (id, move, how) => remote.moveByHand(id, move, how),
    command: (id, line) => remote.command(id, line),
    connect: async (id) => {
      await askForPort(client);
      return remote.reconnect(id);
    },
    log: (id) => remote.log(id),

    saveMachine: (profile) => remote.saveMachine(profile),
    removeMachine: (id) => remote.removeMachine(id),

    samples: () => Promise.resolve(sampleList(sampleFiles)),
    sample: (name) => sampleText(sampleFiles, name),
    svgOf: async ({ of, id }, maxBytes) => {
      const drawing = of === "job" ? await remote.jobDrawing(id) : await sampleText(sampleFiles, id);
      const text = textUpTo(drawing, maxBytes);
      return text !== null && /<svg[\s>]/i.test(text.slice(0, 20_000)) ? text : null;
    },

    studio: () => Promise.resolve(studioOf(client)),
  };
};

const textUpTo = (drawing: DrawingText, maxBytes: number): string | null => {
  const size = typeof drawing === "string" ? drawing.length : drawing.byteLength;
  return size > maxBytes ? null : textOf(drawing);
};

/** Opens the browser's own dialog, which works only in a click handler. */
const askForPort = async ({ remote }: HostClient): Promise<void> => {
  const reason = whyNoPort();
  if (reason !== null) throw new BackendFault("not-allowed", reason);
  const filters = (await remote.usbIds()).map(({ vendorId, productId }) => ({
    usbVendorId: Number.parseInt(vendorId, 16),
    usbProductId: Number.parseInt(productId, 16),
  }));
  try {
    await (navigator as { serial: Serial }).serial.requestPort({ filters });
  } catch {
    throw new BackendFault("no-board", browserText.noneChosen);
  }
};

/** Requests that need a server are refused with a message that says so. */
const studioOf = ({ remote }: HostClient): StudioBackend => {
  const needsServer = (): Promise<never> =>
    Promise.reject(new BackendFault("not-allowed", browserText.needsServer));
  return {
    devices: () => remote.devices(),
    patchPlotter: (id, patch) => remote.patchPlotter(id, patch),
    sharedJobs: () => Promise.resolve(null),
    addPlotter: needsServer,
    removePlotter: needsServer,
    pairing: needsServer,
    access: needsServer,
    addKey: needsServer,
    revoke: needsServer,
    webhooks: needsServer,
    addWebhook: needsServer,
    removeWebhook: needsServer,
    shareJob: needsServer,
    giveBackShared: needsServer,
    withdrawShared: needsServer,
  };
};
