/**
 * Checks the headers of every request before any route.
 *
 * Host: another site can point its own name at 127.0.0.1 (DNS rebinding) and is then "same origin" with this
 * server. But it can't choose the Host header, which contains that name. A numeric address can't be rebound.
 * So addresses are accepted, and of all names only localhost and the configured ones.
 *
 * Origin: browsers add it to every cross-site POST and event stream. It must match the host of the request, or be one
 * of those that the server was started with (cross-origin.ts).
 */
import type { RequestHandler } from "express";
import { isIP } from "node:net";
import { PlotwrightError } from "../../src/index.js";
import { isAllowedOrigin, isApi, isCrossOrigin } from "./cross-origin.js";
import type { Refusals } from "./refusals.js";

const MAX_LOGGED = 150;

/** Refuses paths that contain "..", in any encoding. */
export function guardPaths(refusals: Refusals): RequestHandler {
  return (request, _response, next) => {
    const path = request.url.split("?", 1)[0] ?? "";
    if (/(^|[/\\])\.\.+([/\\]|$)|\0/.test(decoded(decoded(path)))) {
      refusals.note(request, "not a path of this server");
      throw new PlotwrightError("not-found", "There is nothing at this path.");
    }
    next();
  };
}

function decoded(path: string): string {
  try {
    return decodeURIComponent(path);
  } catch {
    return path;
  }
}

export function guardHosts(
  extraNames: readonly string[],
  allowedOrigins: readonly string[],
  localName: () => string | null,
  refusals: Refusals,
): RequestHandler {
  const names = new Set(["localhost", ...extraNames.map((name) => name.toLowerCase())]);
  return (request, response, next) => {
    const refuse = (message: string): never => {
      refusals.note(request, message.slice(0, MAX_LOGGED));
      // These pages use the connections of a browser that may be paired, or is on this computer.
      response.setHeader("Connection", "close");
      throw new PlotwrightError("not-allowed", message);
    };
    const host = hostName(request.headers.host);
    if (
      host === null ||
      !(isIP(host) > 0 || names.has(host) || host === localName() || host.endsWith(".localhost"))
    ) {
      refuse(
        `This server does not answer to the name ${JSON.stringify(request.headers.host ?? "")}. Use its address, or allow the name with --allow-host.`,
      );
    }
    const { origin } = request.headers;
    const mayUse = isAllowedOrigin(origin, allowedOrigins) && isApi(request.path);
    if (origin !== undefined && isCrossOrigin(request) && !mayUse) {
      refuse(`Pages of ${origin} may not use this server.${adviceFor(origin, allowedOrigins)}`);
    }
    if (origin === undefined && isForeign(request.headers["sec-fetch-site"]) && isApi(request.path)) {
      refuse("Pages of other sites may not use this server.");
    }
    next();
  };
}

function adviceFor(origin: string, allowedOrigins: readonly string[]): string {
  if (!/^https?:/.test(origin) || allowedOrigins.includes(origin)) return "";
  return ` To allow them, with a key, start it with --allow-origin ${origin}.`;
}

/** The Host header without port and brackets; null if it is invalid. */
function hostName(header: string | undefined): string | null {
  const match = /^(?:\[([0-9a-fA-F:.]+)\]|([A-Za-z0-9._-]+))(?::\d{1,5})?$/.exec(header ?? "");
  return (match?.[1] ?? match?.[2])?.toLowerCase() ?? null;
}

/** Sec-Fetch-Site is set by the browser and can't be set by a page. Absent from curl and scripts. */
const isForeign = (site: string | string[] | undefined): boolean =>
  site === "cross-site" || site === "same-site";
