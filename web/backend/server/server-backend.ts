/** The page's backend with plotwright's server: REST requests and the live event stream. */
import { API_PATH, clientOf, OPERATIONS, requestOf } from "../../../src/schema/index.js";
import { BackendFault, type Backend } from "../backend.js";
import { openEvents } from "./events.js";
import { sendOperation, type Fetch } from "./requests.js";

export const createServerBackend = (fetchPath: Fetch = (path, init) => fetch(path, init)): Backend => ({
  ...clientOf(OPERATIONS, (one, input) => sendOperation(fetchPath, one, input)),
  features: { sharing: true, asksForPort: false, whyNoPort: null },
  listen: (listener) => openEvents(`${API_PATH}${OPERATIONS.state.events.path}`, listener),
  connect: () => Promise.reject(new BackendFault("internal", "The server finds its plotters itself.")),
  svgOf: async ({ of, id }, maxBytes) => {
    const stop = new AbortController();
    const one = of === "job" ? OPERATIONS.jobs.drawing : OPERATIONS.samples.get;
    const response = await fetchPath(requestOf(one, { id }).path, { signal: stop.signal });
    if (!response.ok || Number(response.headers.get("content-length") ?? 0) > maxBytes) {
      stop.abort();
      return null;
    }
    const file = await response.text();
    return /<svg[\s>]/i.test(file.slice(0, 20_000)) ? file : null;
  },
});
