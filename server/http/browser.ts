/**
 * Which browser a request comes from, for the operator lock (server/security/operator-lock.ts). This is not
 * access control: what a caller may do at all is decided earlier, by its session, its key or its address.
 *
 * A paired browser is identified by its session; one on this computer by a separate cookie. Other clients see
 * only the session's id or a hash of the cookie. Scripts send neither and have no identity.
 */
import { createHash, randomBytes } from "node:crypto";
import { Router, type Request } from "express";
import type { Operator } from "../../src/schema/index.js";
import type { Access } from "../security/access.js";
import type { OperatorLock } from "../security/operator-lock.js";
import { SESSION_COOKIE, bearerOf, cookieOf, isStop, type IsRunning } from "./auth.js";

const BROWSER_COOKIE = "plotwright_browser";
const COOKIE_DAYS = 400;
const SAFE_METHODS = new Set(["GET", "HEAD", "OPTIONS"]);

export class Browsers {
  readonly #access: Access;
  /** Requests of browsers that get their cookie with this answer. */
  readonly #fresh = new WeakMap<Request, string>();

  constructor(access: Access) {
    this.#access = access;
  }

  /** Null for scripts. */
  of(request: Request): Operator | null {
    if (bearerOf(request) !== null) return null;
    const name = browserName(request);
    const session = cookieOf(request, SESSION_COOKIE);
    const entry = session === null ? null : this.#access.entryOf(session);
    if (entry !== null) return { id: entry.id, name };
    const secret = cookieOf(request, BROWSER_COOKIE) ?? this.#fresh.get(request) ?? null;
    if (secret === null) return null;
    return { id: createHash("sha256").update(secret).digest("hex").slice(0, 16), name };
  }

  /** Sets the cookie of every new browser with the answer to its first request. */
  routes(): Router {
    const router = Router();
    router.use((request, response, next) => {
      const isBrowser = request.headers["user-agent"]?.startsWith("Mozilla/") === true;
      if (isBrowser && cookieOf(request, BROWSER_COOKIE) === null) {
        const secret = randomBytes(24).toString("base64url");
        this.#fresh.set(request, secret);
        response.cookie(BROWSER_COOKIE, secret, {
          httpOnly: true,
          sameSite: "strict",
          secure: request.secure,
          maxAge: COOKIE_DAYS * 86_400_000,
          path: "/",
        });
      }
      next();
    });
    return router;
  }
}

/** For everything under /api: a browser needs the operator lock to change anything, except to stop a plot. */
export function requireOperator(
  browsers: Browsers,
  operatorLock: OperatorLock,
  isRunning: IsRunning,
): Router {
  const router = Router();
  router.use((request, _response, next) => {
    const isFree = SAFE_METHODS.has(request.method) || isStop(request, isRunning);
    const browser = isFree || request.path === "/v1/operator/take" ? null : browsers.of(request);
    if (browser !== null) operatorLock.act(browser);
    next();
  });
  return router;
}

const BROWSERS: readonly (readonly [RegExp, string])[] = [
  [/Firefox\//, "Firefox"],
  [/Edg\//, "Edge"],
  [/Chrom(e|ium)\//, "Chrome"],
  [/Safari\//, "Safari"],
];
const SYSTEMS: readonly (readonly [RegExp, string])[] = [
  [/iPhone/, "iPhone"],
  [/iPad/, "iPad"],
  [/Android/, "Android"],
  [/Windows/, "Windows"],
  [/Mac OS X/, "Mac"],
  [/CrOS/, "ChromeOS"],
  [/Linux/, "Linux"],
];

/** "Firefox on Android (192.168.1.20)": enough for people to recognize the device. */
function browserName(request: Request): string {
  const agent = request.headers["user-agent"] ?? "";
  const find = (table: typeof BROWSERS, other: string): string =>
    table.find(([pattern]) => pattern.test(agent))?.[1] ?? other;
  const address = (request.socket.remoteAddress ?? "").replace(/^::ffff:/, "");
  const where = /^(127\.|::1$)/.test(address) ? "this computer" : address;
  return `${find(BROWSERS, "A browser")} on ${find(SYSTEMS, "some system")} (${where})`;
}
