/** Chooses the page's backend at build time: plotwright's server, or with VITE_BACKEND=browser a worker of the page. */
import type { Backend } from "./backend.js";
import { createBrowserBackend } from "./browser/browser-backend.js";
import { createServerBackend } from "./server/server-backend.js";

/** The build leaves out the other one. */
export const createPageBackend = (): Backend =>
  import.meta.env.VITE_BACKEND === "browser"
    ? createBrowserBackend(
        import.meta.glob<string>("../../samples/*.svg", { query: "?url", import: "default" }),
      )
    : createServerBackend();
