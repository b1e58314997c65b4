/**
 * Pages of other origins, which the server refuses unless it was started with their origin (--allow-origin). Such a page
 * has the rights of the key that it sends, and no others: what a browser sends by itself, its address and its cookies,
 * counts for nothing.
 *
 * Before a request with a key, the browser asks for permission (a "preflight", with the method OPTIONS and without the
 * key). These headers answer that, and let the page read the answers.
 */
import type { IncomingMessage } from "node:http";
import type { RequestHandler } from "express";

const READABLE_HEADERS = "Content-Disposition, Location, RateLimit, Retry-After";
/** No credentials: a page can't use the browser's cookies. A browser need not ask again for ten minutes. */
const PERMISSIONS = {
  "Access-Control-Allow-Methods": "GET, HEAD, POST, PUT, PATCH, DELETE",
  "Access-Control-Allow-Headers": "Authorization, Content-Type",
  "Access-Control-Max-Age": "600",
};

/** The page that sent the request has another origin than this server. */
export function isCrossOrigin({ headers: { origin, host } }: IncomingMessage): boolean {
  if (origin === undefined) return false;
  const match = /^https?:\/\/(.+)$/.exec(origin);
  return match?.[1]?.toLowerCase() !== (host ?? "").toLowerCase();
}

/** A browser asks whether a page of an allowed origin may send a request. */
export const isPreflight = (
  { method, headers, originalUrl }: Pick<IncomingMessage, "method" | "headers"> & { originalUrl: string },
  allowedOrigins: readonly string[],
): boolean =>
  method === "OPTIONS" &&
  headers["access-control-request-method"] !== undefined &&
  isAllowedOrigin(headers.origin, allowedOrigins) &&
  isApi(originalUrl);

export const isAllowedOrigin = (origin: string | undefined, allowedOrigins: readonly string[]): boolean =>
  origin !== undefined && allowedOrigins.includes(origin);

/** Case-insensitive, because express also matches routes in upper case. */
export const isApi = (path: string): boolean => path.toLowerCase().startsWith("/api/");

/** For everything under /api. Sets headers only: the request may still be refused, with an answer that the page can read. */
export const crossOriginHeaders =
  (allowedOrigins: readonly string[]): RequestHandler =>
  (request, response, next) => {
    const { origin } = request.headers;
    response.vary("Origin");
    if (origin !== undefined && isAllowedOrigin(origin, allowedOrigins)) {
      response
        .set("Access-Control-Allow-Origin", origin)
        .set("Access-Control-Expose-Headers", READABLE_HEADERS);
    }
    if (isPreflight(request, allowedOrigins)) {
      response.set(PERMISSIONS);
      // Asked by browsers when a public page wants to reach a server in the user's own network.
      if (request.headers["access-control-request-private-network"] === "true") {
        response.set("Access-Control-Allow-Private-Network", "true");
      }
    }
    next();
  };

/** After the guards, so that a preflight to a name that is not this server's is refused. */
export const answerPreflights =
  (allowedOrigins: readonly string[]): RequestHandler =>
  (request, response, next) => {
    if (isPreflight(request, allowedOrigins)) response.status(204).end();
    else next();
  };
