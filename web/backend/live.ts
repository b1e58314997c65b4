/** Begins live drawings for the page. Loaded when one is wanted. */
import type { PlotwrightError } from "../../src/index.js";
import type { LiveBegin } from "../../src/schema/index.js";
import { LiveSender, type OpenLiveLink } from "../../host/handle/live-sender.js";
import { BackendFault } from "./backend.js";

export { liveSocket } from "../../host/handle/live-socket.js";

/** The errors of a drawing that has begun are PlotwrightErrors, which have the same fields. */
export const beginLive = (open: OpenLiveLink, wanted: LiveBegin): Promise<LiveSender> =>
  LiveSender.begin(open, wanted).catch((error: unknown) => {
    const { code, message } = error as PlotwrightError;
    throw new BackendFault(code, message);
  });
