/** Chooses the page's backend when it is built: by plotwright's server, or, with VITE_BACKEND=browser, without one. */
import type { Backend } from "./backend.js";
import { createBrowserBackend } from "./browser/browser-backend.js";
import { createServerBackend } from "./server/server-backend.js";

/** The build leaves out the one that is not chosen. */
export const createPageBackend = (): Backend =>
  import.meta.env.VITE_BACKEND === "browser"
    ? createBrowserBackend(
        import.meta.glob<string>("../../samples/*.svg", { query: "?url", import: "default" }),
      )
    : createServerBackend();
