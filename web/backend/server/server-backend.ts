/** The page's backend with plotwright's server: REST requests and the live event stream. */
import { z } from "zod";
import {
  commandAnswerSchema,
  jobPageSchema,
  jobSchema,
  machineProfileSchema,
  meSchema,
  operatorSchema,
  plotterSchema,
  plotterSettingsSchema,
  queueSettingsSchema,
} from "../../../src/schema/index.js";
import { contentOf } from "../../worker/drawing-text.js";
import { BackendFault, type Backend, type DrawingSource } from "../backend.js";
import { openEvents } from "./events.js";
import { API, createRequests, pathOf, type Fetch } from "./requests.js";

const samplesSchema = z.object({ samples: z.array(z.object({ name: z.string(), title: z.string() })) });
const operatorAnswerSchema = z.object({ operator: operatorSchema.nullable() });

const drawingPath = ({ of, id }: DrawingSource): string =>
  of === "job" ? `${pathOf("jobs", id)}/drawing` : pathOf("samples", id);

export const createServerBackend = (fetchPath: Fetch = (path, init) => fetch(path, init)): Backend => {
  const requests = createRequests(fetchPath);
  const { ask, send, command, askWithDrawing } = requests;
  return {
    features: { sharing: true, asksForPort: false, whyNoPort: null },
    listen: (listener) => openEvents(`${API}/events`, listener),

    addJob: (job, drawing) => askWithDrawing(jobSchema, "/jobs", job, drawing),
    patchJob: (id, patch) => ask(jobSchema, "PATCH", pathOf("jobs", id), patch),
    actOnJob: (id, action) => ask(jobSchema, "POST", `${pathOf("jobs", id)}/${action}`),
    changeJob: (id, change) => ask(jobSchema, "POST", `${pathOf("jobs", id)}/change`, change),
    movePlace: (id, move) => ask(jobSchema, "POST", `${pathOf("jobs", id)}/place`, move),
    moveJob: (id, beforeId) => command("POST", `${pathOf("jobs", id)}/move`, { beforeId }),
    duplicateJob: (id) => ask(jobSchema, "POST", `${pathOf("jobs", id)}/duplicate`),
    removeJob: (id) => command("DELETE", pathOf("jobs", id)),
    olderJobs: ({ after, plotterId }) => {
      const query = new URLSearchParams();
      if (after !== undefined) query.set("after", after);
      if (plotterId !== undefined) query.set("plotterId", plotterId);
      return ask(jobPageSchema, "GET", `/history?${query.toString()}`);
    },
    jobDrawing: async (id) =>
      contentOf(await (await send("GET", drawingPath({ of: "job", id }))).arrayBuffer()),
    setQueue: (plotterId, settings) =>
      ask(queueSettingsSchema, "PATCH", `${pathOf("plotters", plotterId)}/queue`, settings),

    me: () => ask(meSchema, "GET", "/me"),
    takeOver: async () => (await ask(operatorAnswerSchema, "POST", "/operator/take")).operator,
    dismissNotice: (id) => command("DELETE", pathOf("notices", id)),

    savePlotterSettings: (id, settings) =>
      ask(plotterSettingsSchema, "PUT", `${pathOf("plotters", id)}/settings`, settings),
    setPlotterMachine: (id, machine) => ask(plotterSchema, "PATCH", pathOf("plotters", id), { machine }),
    movePen: (id, request) => ask(plotterSchema, "POST", `${pathOf("plotters", id)}/pen`, request),
    motorsOff: (id) => ask(plotterSchema, "POST", `${pathOf("plotters", id)}/motors-off`),
    moveByHand: (id, { kind, ...numbers }, how) =>
      ask(plotterSchema, "POST", `${pathOf("plotters", id)}/${kind}`, { ...numbers, ...how }),
    command: (id, line) => ask(commandAnswerSchema, "POST", `${pathOf("plotters", id)}/command`, { line }),
    connect: () => Promise.reject(new BackendFault("internal", "The server finds its plotters itself.")),
    log: async (id) => (await send("GET", `${pathOf("plotters", id)}/log`)).text(),

    saveMachine: (profile) => ask(machineProfileSchema, "PUT", pathOf("machines", profile.id), profile),
    removeMachine: (id) => command("DELETE", pathOf("machines", id)),

    samples: async () => (await ask(samplesSchema, "GET", "/samples")).samples,
    sample: async (name) => (await send("GET", drawingPath({ of: "sample", id: name }))).text(),
    svgOf: async (source, maxBytes) => {
      const stop = new AbortController();
      const response = await fetchPath(`${API}${drawingPath(source)}`, { signal: stop.signal });
      if (!response.ok || Number(response.headers.get("content-length") ?? 0) > maxBytes) {
        stop.abort();
        return null;
      }
      const file = await response.text();
      return /<svg[\s>]/i.test(file.slice(0, 20_000)) ? file : null;
    },

    studio: async () => (await import("./studio-routes.js")).studioRoutes(requests),
  };
};
