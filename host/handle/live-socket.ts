/** The connection of a live drawing's sender to a server: the WebSocket of the operation `liveDrawings.draw`. */
import { PlotwrightError } from "../../src/index.js";
import { API_PATH, liveReportSchema, OPERATIONS } from "../../src/schema/index.js";
import type { OpenLiveLink } from "./live-sender.js";

/** The part of the browsers' WebSocket that is used; Node's packages have it too. */
export interface SocketLike {
  onopen: ((event: never) => void) | null;
  onmessage: ((event: never) => void) | null;
  onclose: ((event: never) => void) | null;
  onerror: ((event: never) => void) | null;
  send(text: string): void;
  close(): void;
}
export type OpenSocket = (address: string, protocols: string[]) => Promise<SocketLike>;

/** The protocols that a client offers: browsers can send an access key in no other header. */
export const LIVE_PROTOCOL = "plotwright-live";
export const KEY_PROTOCOL = "plotwright-key.";

/** `url`: of the server. */
export const liveSocket =
  (openSocket: OpenSocket, url: string, plotterId: string, key?: string): OpenLiveLink =>
  async (report, lost) => {
    const path = API_PATH + OPERATIONS.liveDrawings.draw.path.replace(":id", encodeURIComponent(plotterId));
    const address = new URL(path, url).href.replace(/^http/, "ws");
    const protocols = key === undefined ? [LIVE_PROTOCOL] : [LIVE_PROTOCOL, KEY_PROTOCOL + key];
    const socket = await openSocket(address, protocols);
    return new Promise((resolve, reject) => {
      let isOpen = false;
      let isOver = false;
      socket.onopen = () => {
        isOpen = true;
        resolve({
          send: (message) => socket.send(JSON.stringify(message)),
          close: () => socket.close(),
        });
      };
      socket.onmessage = ({ data }: { readonly data: unknown }) => {
        const parsed = liveReportSchema.safeParse(parsedJson(data));
        if (!parsed.success) return;
        isOver ||= parsed.data.type === "ended" || parsed.data.type === "error";
        report(parsed.data);
      };
      socket.onerror = () => undefined;
      socket.onclose = () => {
        if (!isOpen) reject(notOpened(url));
        else if (!isOver) lost(new PlotwrightError("disconnected", "The connection to the server was lost."));
      };
    });
  };

function parsedJson(data: unknown): unknown {
  try {
    return JSON.parse(String(data));
  } catch {
    return null;
  }
}

/** Why is not known: browsers show a page no answer but an open connection. */
const notOpened = (url: string): PlotwrightError =>
  new PlotwrightError(
    "disconnected",
    `The server at ${url} has not opened a live drawing. It may be gone, or not allow this device to operate.`,
  );
