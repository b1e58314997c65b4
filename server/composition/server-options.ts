import { PlotwrightError } from "../../src/index.js";
import type { Springs } from "../../src/internal.js";

/** The options of a server. */
export interface ServerOptions {
  /** Default 9080; 0 picks a free port. */
  readonly port?: number;
  /** Default 127.0.0.1, or all addresses with `lan`. */
  readonly host?: string;
  /** Listen on the network. Other devices have to be paired; the links are in the server's `pairing`. */
  readonly lan?: boolean;
  /**
   * Announce plotwright.local by mDNS, or plotwright-2.local if that is taken. Default: the value of `lan`.
   */
  readonly mdns?: boolean;
  /** Serve https with this certificate and key (PEM text). */
  readonly tls?: { readonly cert: string; readonly key: string };
  /** Require pairing on this computer too, for use behind a proxy on this computer. */
  readonly pairAlways?: boolean;
  /**
   * Serial path of the board, or "virtual"; default: the first EBB found, or the virtual board if there is
   * none.
   */
  readonly device?: string;
  /** Speed of the virtual board: 1 is real time. */
  readonly virtualSpeed?: number;
  /** How the pen of the virtual board vibrates, which makes its drawn lines ring. Default: it does not. */
  readonly virtualSprings?: Springs;
  /** Folder for jobs and settings. */
  readonly dataDir?: string;
  /** Largest upload; default 200 MB. */
  readonly maxUploadBytes?: number;
  /** Host names to accept besides localhost and addresses. */
  readonly allowedHosts?: readonly string[];
  /**
   * Origins, such as `https://preview.p5js.org`, whose pages may use the HTTP interface. They need a key: `POST
   * /access/keys`. Default: none.
   */
  readonly allowedOrigins?: readonly string[];
  /** Notify other programs of jobs, as users set up on the page. Default true. */
  readonly webhooks?: boolean;
  /** Folder whose new drawings become queued jobs. */
  readonly watchDir?: string;
  /** postgres://… of a database through which servers share jobs; needs the packages pg and pg-boss. */
  readonly sharedQueue?: string;
  /** How often idle plotters look for shared jobs; default 2000. */
  readonly sharedPollMs?: number;
  /** Time without a sign of life after which a sharing server counts as lost; default 60 000. */
  readonly sharedLostAfterMs?: number;
  /** Timeout of the shared database; default 5 s. */
  readonly sharedTimeoutMs?: number;
  /**
   * `mqtt://` or `mqtts://` address of a broker, with user, password and topic, that learns the plotters' states and sends
   * commands; needs the package mqtt.
   */
  readonly mqtt?: string;
  /** Called when the links in `pairing` were replaced, because a device was removed. */
  readonly onNewPairing?: () => void;
  /** Receives the lines of the log. */
  readonly log?: (line: string) => void;
}

const NAMES = Object.keys({
  port: true,
  host: true,
  lan: true,
  mdns: true,
  tls: true,
  pairAlways: true,
  device: true,
  virtualSpeed: true,
  virtualSprings: true,
  dataDir: true,
  maxUploadBytes: true,
  allowedHosts: true,
  allowedOrigins: true,
  webhooks: true,
  watchDir: true,
  sharedQueue: true,
  sharedPollMs: true,
  sharedLostAfterMs: true,
  sharedTimeoutMs: true,
  mqtt: true,
  onNewPairing: true,
  log: true,
} satisfies Record<keyof ServerOptions, true>);

/**
 * For programs written without types: a misspelt `dataDir` would write into the user's own folder.
 *
 * @throws PlotwrightError "bad-setting"
 */
export function checkServerOptions(options: object): void {
  const unknown = Object.keys(options).find((name) => !NAMES.includes(name));
  if (unknown === undefined) return;
  throw new PlotwrightError(
    "bad-setting",
    `createServer has no option "${unknown}". Options: ${NAMES.join(", ")}.`,
  );
}

/**
 * The origins of these URLs, as browsers send them: in lower case, without path and default port.
 *
 * @throws PlotwrightError "bad-setting"
 */
export function originsOf(urls: readonly string[]): string[] {
  return urls.map((url) => {
    const origin = originIn(url);
    if (origin !== null) return origin;
    const why =
      url === "*" || url === "null"
        ? "Only single origins can be allowed: a page opened as a file has none, and any page could send a key that it has found."
        : "It must be the address of a site without a path, such as https://preview.p5js.org or http://localhost:8080.";
    throw new PlotwrightError("bad-setting", `${JSON.stringify(url)} is not an origin. ${why}`);
  });
}

function originIn(text: string): string | null {
  // The URL standard accepts much more: spaces, backslashes, user names, numbers as hosts.
  if (!/^https?:\/\/[^\s/\\?#@*]+\/?$/i.test(text) || !URL.canParse(text)) return null;
  return new URL(text).origin;
}
