/**
 * Authenticates requests by their address, session or key, and enforces roles. Also the pairing route.
 */
import type { IncomingMessage } from "node:http";
import { Router, type Request, type RequestHandler } from "express";
import { rateLimit } from "express-rate-limit";
import { PlotwrightError } from "../../src/index.js";
import type { Role } from "../../src/schema/index.js";
import { SESSION_DAYS, type Access } from "../security/access.js";

export const SESSION_COOKIE = "plotwright_session";
const LOOPBACK = /^(::1|(::ffff:)?127(\.\d{1,3}){3})$/;
const SAFE_METHODS = new Set(["GET", "HEAD", "OPTIONS"]);

/** Requests per minute from one address of the network; a page makes at most about one per second. */
const MAX_REQUESTS = 600;
/**
 * Requests for the page's own files per minute from one address. A first visit fetches about 100, since the service
 * worker stores all of them; if one is refused, it is not installed. Behind a proxy all visitors have one address.
 */
const MAX_FILES = 6_000;
const MAX_PAIRINGS = 10;

export function roleOf(request: IncomingMessage, access: Access): Role | null {
  if (isTrusted(request, access)) return "operate";
  const secret = bearerOf(request) ?? cookieOf(request, SESSION_COOKIE);
  return secret === null ? null : access.roleOf(secret);
}

/**
 * For everything under /api: requires a role, and the role "operate" for everything that changes something.
 */
export function requireRole(
  access: Access,
  isRunning: IsRunning,
  log: (line: string) => void,
): RequestHandler {
  return (request, _response, next) => {
    const role = roleOf(request, access);
    const isAllowed =
      role === "operate" || (role === "watch" && (isStop(request, isRunning) || maySee(request)));
    if (isAllowed) {
      next();
      return;
    }
    log(`refused ${request.method} ${request.path} from ${request.socket.remoteAddress ?? "?"}`);
    throw new PlotwrightError("not-allowed", whyNot(request, role));
  };
}

function whyNot({ headers }: Request, role: Role | null): string {
  if (role !== null) return "This device may only watch. To operate, pair it with the link for operating.";
  return headers.authorization === undefined
    ? "Pair this device first: open the link or scan the QR code that the server shows on its own computer."
    : "This access key is not valid: it may have been revoked. Make another one on the server's page, under Sharing, Access.";
}

/** Whether a job is on a plotter now. */
export type IsRunning = (jobId: string) => boolean;

/** Stopping a plot needs no operator role: the person closest to the plotter must be able to do it. `path` is below /api. */
export function isStop({ method, path }: Request, isRunning: IsRunning): boolean {
  const match = /^\/v1\/jobs\/([^/]+)\/(pause|cancel|emergency-stop)$/.exec(path);
  // Cancelling a job that is only queued is not a stop.
  return method === "POST" && match !== null && (match[2] !== "cancel" || isRunning(match[1] ?? ""));
}

/** Access keys, webhooks and logs may contain secrets, so only operators may read them. */
const maySee = ({ method, path }: Request): boolean =>
  SAFE_METHODS.has(method) && !/^\/v1\/(access|webhooks|logs)(\/|$)/i.test(path);

/** GET /pair?token=…: sets a session cookie, then forwards to the page. */
export function pairRoutes(access: Access, log: (line: string) => void): Router {
  const router = Router();
  router.get("/pair", limitBy(MAX_PAIRINGS, access), (request, response) => {
    const { token } = request.query;
    const name = request.headers["user-agent"] ?? "browser";
    try {
      const secret = access.pair(typeof token === "string" ? token : "", name);
      response.cookie(SESSION_COOKIE, secret, {
        httpOnly: true,
        sameSite: "strict",
        secure: request.secure,
        maxAge: SESSION_DAYS * 86_400_000,
        path: "/",
      });
      log(`paired ${request.socket.remoteAddress ?? "?"}`);
    } catch (error) {
      log(`refused pairing of ${request.socket.remoteAddress ?? "?"}`);
      throw error;
    }
    // Not a redirect: browsers do not send a Strict cookie after a redirect that another site started.
    response.set("Cache-Control", "no-store").set("Referrer-Policy", "no-referrer");
    response
      .type("html")
      .send('<!doctype html><meta http-equiv="refresh" content="0;url=/"><a href="/">plotwright</a>');
  });
  return router;
}

/** Limits requests from the network; this computer is not limited. */
export const limitRequests = (access: Access): RequestHandler => {
  const [ofFiles, ofRest] = [limitBy(MAX_FILES, access), limitBy(MAX_REQUESTS, access)];
  return (request, response, next) =>
    (request.path.startsWith("/assets/") ? ofFiles : ofRest)(request, response, next);
};

function limitBy(limit: number, access: Access): RequestHandler {
  return rateLimit({
    windowMs: 60_000,
    limit,
    standardHeaders: "draft-8",
    legacyHeaders: false,
    skip: (request) => isTrusted(request, access),
    handler: (_request, response) => {
      response
        .status(429)
        .json({ error: { code: "busy", message: "Too many requests: wait a minute, then try again." } });
    },
  });
}

/** Whether the request comes from this computer and this computer needs no pairing. */
export const isTrusted = (request: IncomingMessage, access: Access): boolean =>
  isTrustedAddress(request.socket.remoteAddress, access);

export const isTrustedAddress = (address: string | undefined, access: Access): boolean =>
  access.trustsLoopback && LOOPBACK.test(address ?? "");

export function bearerOf(request: IncomingMessage): string | null {
  return /^Bearer ([\w-]{20,200})$/.exec(request.headers.authorization ?? "")?.[1] ?? null;
}

export function cookieOf(request: IncomingMessage, name: string): string | null {
  const match = new RegExp(`(?:^|;\\s*)${name}=([\\w-]{20,200})(?:;|$)`).exec(request.headers.cookie ?? "");
  return match?.[1] ?? null;
}
