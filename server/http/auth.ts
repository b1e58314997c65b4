/**
 * Authenticates requests by their address, session or key, limits their rate, and enforces roles. Also the pairing
 * route.
 */
import type { IncomingMessage } from "node:http";
import { Router, type Request, type RequestHandler, type Response } from "express";
import { ipKeyGenerator, rateLimit } from "express-rate-limit";
import { PlotwrightError } from "../../src/index.js";
import {
  API_PATH,
  maySubmitterPerform,
  OPERATIONS,
  type Operation,
  type Role,
} from "../../src/schema/index.js";
import { SESSION_DAYS, type Access } from "../security/access.js";
import { isCrossOrigin, isPreflight } from "./cross-origin.js";
import type { Refusals } from "./refusals.js";

export const SESSION_COOKIE = "plotwright_session";
const LOOPBACK = /^(::1|(::ffff:)?127(\.\d{1,3}){3})$/;
const SAFE_METHODS = new Set(["GET", "HEAD", "OPTIONS"]);

/** Requests per minute of one session, key or unknown address; a page makes at most about one per second. */
const MAX_REQUESTS = 600;
/**
 * Requests for the page's own files per minute, counted in the same way. A first visit fetches about 100, since the service
 * worker stores all of them; if one is refused, it is not installed. Behind a proxy all visitors have one address.
 */
const MAX_FILES = 6_000;
/** Pairings per minute of an address, also of its paired devices. Its other requests do not use them up. */
const MAX_PAIRINGS = 10;

/** Who sent a request: a session or key by its id, or this computer. */
export interface Caller {
  readonly id: string;
  readonly role: Role;
  readonly isLocal: boolean;
  /** The name of a key; null for others. */
  readonly keyName: string | null;
}

/**
 * Null for a client that has not identified itself. A key counts on this computer too, so that a program has the same rights
 * here and elsewhere. Pages of other origins identify themselves only with a key.
 */
export function callerOf(request: IncomingMessage, access: Access): Caller | null {
  const bearer = bearerOf(request);
  const byBearer = bearer === null ? null : access.entryOf(bearer);
  const hasKey = byBearer?.kind === "key";
  if (!hasKey && isTrusted(request, access))
    return { id: "this computer", role: "operate", isLocal: true, keyName: null };
  if (!hasKey && isCrossOrigin(request)) return null;
  const cookie = bearer === null ? cookieOf(request, SESSION_COOKIE) : null;
  const entry = cookie === null ? byBearer : access.entryOf(cookie);
  if (entry === null) return null;
  const { id, role, kind, name } = entry;
  return { id, role, isLocal: false, keyName: kind === "key" ? name : null };
}

/** For everything under /api: requires a role, and one that may do what is asked. The routes find the caller in `callerIn`. */
export function requireRole(access: Access, isRunning: IsRunning, refusals: Refusals): RequestHandler {
  const isAllowed: Readonly<Record<Role, (request: Request) => boolean>> = {
    operate: () => true,
    submit: maySubmit,
    watch: (request) => isStop(request, isRunning) || maySee(request),
  };
  return (request, response, next) => {
    const caller = callerOf(request, access);
    if (caller !== null && isAllowed[caller.role](request)) {
      (response.locals as CallerLocals).caller = caller;
      next();
      return;
    }
    const role = caller?.role ?? null;
    refusals.note(request, role === null ? "not paired" : `may only ${role}`);
    throw new PlotwrightError("not-allowed", whyNot(request, role));
  };
}

interface CallerLocals {
  caller?: Caller;
}

/** Who sent the request, behind `requireRole`. */
export function callerIn({ locals }: Pick<Response, "locals">): Caller {
  const { caller } = locals as CallerLocals;
  if (caller === undefined) throw new Error("This route is not behind requireRole.");
  return caller;
}

function whyNot(request: Request, role: Role | null): string {
  if (role === "submit") {
    return "This device may only add drawings to the queue. To operate, pair it with the link for operating.";
  }
  if (role === "watch") return "This device may only watch. To operate, pair it with the link for operating.";
  const hasNoKey = request.headers.authorization === undefined;
  if (hasNoKey && isCrossOrigin(request)) {
    return "A page of another site needs an access key, sent as “Authorization: Bearer KEY”. You make one on the server's page, under Sharing, Access.";
  }
  return hasNoKey
    ? "Pair this device first: open the link or scan the QR code that the server shows on its own computer."
    : "This access key is not valid: it may have been revoked. Make another one on the server's page, under Sharing, Access.";
}

/** Whether a job is on a plotter now. */
export type IsRunning = (jobId: string) => boolean;

const ALL: readonly Operation[] = Object.values<Readonly<Record<string, Operation>>>(OPERATIONS).flatMap(
  (group) => Object.values(group),
);
const pathPattern = ({ path }: Operation): RegExp =>
  new RegExp(`^${API_PATH}${path.replace(/:\w+/, "([^/]+)").replaceAll(".", "\\.")}$`, "i");
const STOPS = ALL.filter(({ role }) => role === "stop").map((one) => ({
  isCancel: one === OPERATIONS.jobs.cancel,
  path: pathPattern(one),
}));
const OF_SUBMITTERS = ALL.filter(maySubmitterPerform).map((one) => ({
  method: one.method.toUpperCase(),
  path: pathPattern(one),
}));
/** The first parts of the paths whose answers only operators may read. */
const SECRETS: ReadonlySet<string> = new Set(
  ALL.filter(({ method, role }) => method === "get" && role === "operate").map(({ path }) =>
    String(path.split("/")[1]),
  ),
);

/** Stopping a plot needs no operator role: the person closest to the plotter must be able to do it. */
export function isStop({ method, baseUrl, path }: Request, isRunning: IsRunning): boolean {
  if (method !== "POST") return false;
  return STOPS.some((stop) => {
    const match = stop.path.exec(baseUrl + path);
    // Cancelling a job that is only queued is not a stop.
    return match !== null && (!stop.isCancel || isRunning(match[1] ?? ""));
  });
}

/** Whether the role "submit" may do it at all; the routes refuse the jobs of others. */
const maySubmit = ({ method, baseUrl, path }: Request): boolean =>
  OF_SUBMITTERS.some(
    (one) => one.method === (method === "HEAD" ? "GET" : method) && one.path.test(baseUrl + path),
  );

/** Access keys, webhooks and logs may contain secrets, so only operators may read them, and whatever is below them. */
const maySee = ({ method, path }: Request): boolean =>
  SAFE_METHODS.has(method) && !SECRETS.has(/^\/v1\/([^/]*)/i.exec(path)?.[1]?.toLowerCase() ?? "");

/** For the links that pair a device: anyone with such a link gets access. */
export const requireLocal =
  (access: Access, refusals: Refusals): RequestHandler<Record<string, string>> =>
  (request, _response, next) => {
    if (isTrusted(request, access)) {
      next();
      return;
    }
    refusals.note(request, "pairing links are only for this computer");
    throw new PlotwrightError(
      "not-allowed",
      "Pairing links are shown only on the computer where the server runs, and in its terminal.",
    );
  };

/** GET /pair?token=…: sets a session cookie, then forwards to the page. */
export function pairRoutes(access: Access, refusals: Refusals, log: (line: string) => void): Router {
  const router = Router();
  router.get("/pair", (request, response) => {
    const { token } = request.query;
    const name = request.headers["user-agent"] ?? "browser";
    try {
      const before = cookieOf(request, SESSION_COOKIE);
      const secret = access.pair(typeof token === "string" ? token : "", name, before);
      response.cookie(SESSION_COOKIE, secret, {
        httpOnly: true,
        sameSite: "strict",
        secure: request.secure,
        maxAge: SESSION_DAYS * 86_400_000,
        path: "/",
      });
      log(`paired ${request.socket.remoteAddress ?? "?"}`);
    } catch (error) {
      refusals.note(request, "not a valid pairing link");
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

/**
 * Limits requests from the network; this computer is not limited. Each session and key has its own limit, so that other
 * clients at the same address can't use it up. Stops of operators and watchers are not limited, nor are the questions
 * that browsers ask before them.
 */
export function limitRequests(
  access: Access,
  isRunning: IsRunning,
  allowedOrigins: readonly string[],
  refusals: Refusals,
): RequestHandler {
  const addressOf = ({ socket }: Request): string => ipKeyGenerator(socket.remoteAddress ?? "");
  const callerKey = (request: Request): string => callerOf(request, access)?.id ?? addressOf(request);
  const ofPairings = limitBy(MAX_PAIRINGS, addressOf, refusals);
  const ofFiles = limitBy(MAX_FILES, callerKey, refusals);
  const ofRest = limitBy(MAX_REQUESTS, callerKey, refusals);
  return (request, response, next) => {
    const caller = callerOf(request, access);
    const mayStop = caller !== null && caller.role !== "submit" && isStop(request, isRunning);
    const isFree = caller?.isLocal === true || mayStop;
    if (isFree || isPreflight(request, allowedOrigins)) next();
    else if (/^\/pair\/?$/i.test(request.path)) ofPairings(request, response, next);
    else if (request.path.startsWith("/assets/")) ofFiles(request, response, next);
    else ofRest(request, response, next);
  };
}

function limitBy(limit: number, keyGenerator: (request: Request) => string, refusals: Refusals) {
  return rateLimit({
    windowMs: 60_000,
    limit,
    standardHeaders: "draft-8",
    legacyHeaders: false,
    keyGenerator,
    handler: (request, response) => {
      refusals.note(request, "too many requests");
      response
        .status(429)
        .json({ error: { code: "busy", message: "Too many requests: wait a minute, then try again." } });
    },
  });
}

/** Whether the request comes from this computer, not from a page of another site, and this computer needs no pairing. */
const isTrusted = (request: IncomingMessage, access: Access): boolean =>
  isTrustedAddress(request.socket.remoteAddress, access) && !isCrossOrigin(request);

export const isTrustedAddress = (address: string | undefined, access: Access): boolean =>
  access.trustsLoopback && LOOPBACK.test(address ?? "");

/** The access key. For a WebSocket, browsers can send it only as one of the protocols that they offer. */
export function bearerOf({ headers }: IncomingMessage): string | null {
  const bearer = /^Bearer ([\w-]{20,200})$/.exec(headers.authorization ?? "")?.[1];
  const offered = headers.upgrade === undefined ? "" : (headers["sec-websocket-protocol"] ?? "");
  return bearer ?? /(?:^|,\s*)plotwright-key\.([\w-]{20,200})(?:$|,)/.exec(offered)?.[1] ?? null;
}

export function cookieOf(request: IncomingMessage, name: string): string | null {
  const match = new RegExp(`(?:^|;\\s*)${name}=([\\w-]{20,200})(?:;|$)`).exec(request.headers.cookie ?? "");
  return match?.[1] ?? null;
}
