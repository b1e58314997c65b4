/** Lets a request in by where it comes from or by what it carries, and holds watchers to watching. */
import type { IncomingMessage } from "node:http";
import express, { Router, type Request, type RequestHandler } from "express";
import { rateLimit } from "express-rate-limit";
import { PlotwrightError } from "../../src/index.js";
import { newKeySchema, type Role } from "../../src/schema/index.js";
import type { Access } from "../security/access.js";
import { parseWith } from "./errors.js";

export const SESSION_COOKIE = "plotwright_session";
const SESSION_DAYS = 90;
const LOOPBACK = /^(::1|(::ffff:)?127(\.\d{1,3}){3})$/;
const SAFE_METHODS = new Set(["GET", "HEAD", "OPTIONS"]);

/** Requests a minute from one address of the network; a page needs about one a second at most. */
const MOST_REQUESTS = 600;
const MOST_PAIRINGS = 10;

export function roleOf(request: IncomingMessage, access: Access): Role | null {
  if (isTrusted(request, access)) return "operate";
  const secret = bearerOf(request) ?? cookieOf(request, SESSION_COOKIE);
  return secret === null ? null : access.roleOf(secret);
}

/** For everything under /api: some role, and "operate" for whatever changes something. */
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
    throw new PlotwrightError(
      "not-allowed",
      role === null
        ? "Pair this device first: open the link (or the QR code) that the server shows where it runs."
        : "This device may watch, not operate.",
    );
  };
}

/** Whether a job is on a plotter now. */
export type IsRunning = (jobId: string) => boolean;

/** Whoever stands nearest to a plot that goes wrong must be able to stop it. `path` below /api. */
export function isStop({ method, path }: Request, isRunning: IsRunning): boolean {
  const match = /^\/v1\/jobs\/([^/]+)\/(pause|cancel|emergency-stop)$/.exec(path);
  // To cancel what only waits in the queue is no stop.
  return method === "POST" && match !== null && (match[2] !== "cancel" || isRunning(match[1] ?? ""));
}

/** Keys, links with secrets in them and logs are for operators. */
const maySee = ({ method, path }: Request): boolean =>
  SAFE_METHODS.has(method) && !/^\/v1\/(access|webhooks|logs)(\/|$)/i.test(path);

/** GET /pair?token=…: a session cookie, then on to the page. */
export function pairRoutes(access: Access, log: (line: string) => void): Router {
  const router = Router();
  router.get("/pair", limitBy(MOST_PAIRINGS, access), (request, response) => {
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
    // Not a redirect: a cookie that is Strict is not sent with one that another site began.
    response.set("Cache-Control", "no-store").set("Referrer-Policy", "no-referrer");
    response
      .type("html")
      .send('<!doctype html><meta http-equiv="refresh" content="0;url=/"><a href="/">plotwright</a>');
  });
  return router;
}

/** /api/v1/access: sessions and keys, for operators. */
export function accessRoutes(access: Access): Router {
  const router = Router();
  router.get("/", (_request, response) => {
    response.json({ entries: access.list() });
  });
  router.post("/keys", express.json({ limit: "10kb" }), (request, response) => {
    const { name, role } = parseWith(newKeySchema, request.body);
    const { entry, secret } = access.createKey(name, role);
    response.status(201).json({ entry, secret });
  });
  router.delete("/:id", (request, response) => {
    access.revoke(request.params.id);
    response.json({ ok: true });
  });
  return router;
}

/** For addresses of the network; this computer is not limited. */
export const limitRequests = (access: Access): RequestHandler => limitBy(MOST_REQUESTS, access);

function limitBy(most: number, access: Access): RequestHandler {
  return rateLimit({
    windowMs: 60_000,
    limit: most,
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

/** On this computer, and this computer's users are not asked who they are. */
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
