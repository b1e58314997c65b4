/**
 * Identifies the browser of a request, for the operator lock (server/security/operator-lock.ts). This is not access
 * control: the permissions of a caller are decided earlier, by its session, its key or its address.
 *
 * A paired browser is identified by its session; one on this computer by a separate cookie. Other clients see
 * only the session's id or a hash of the cookie. Scripts send neither and have no identity.
 */
import { createHash, randomBytes } from "node:crypto";
import { Router, type Request } from "express";
import { OPERATIONS, type Operator } from "../../src/schema/index.js";
import type { Access } from "../security/access.js";
import type { OperatorLock } from "../security/operator-lock.js";
import { isCrossOrigin } from "./cross-origin.js";
import { SESSION_COOKIE, bearerOf, callerIn, cookieOf, isStop, type IsRunning } from "./auth.js";

/** Max number of browser names to store; the oldest are forgotten. */
const MAX_NAMES = 1_000;
const BROWSER_COOKIE = "plotwright_browser";
const COOKIE_DAYS = 400;
const SAFE_METHODS = new Set(["GET", "HEAD", "OPTIONS"]);

export class Browsers {
  /** Requests of browsers that get their cookie with this answer. */
  private readonly fresh = new WeakMap<Request, string>();
  /** By browser id. */
  private readonly names = new Map<string, string>();

  /** `known`: a browser that got its name before the server was restarted. */
  constructor(
    private readonly access: Access,
    known: Operator | null = null,
  ) {
    if (known !== null) this.names.set(known.id, known.name);
  }

  /** Null for scripts. */
  of(request: Request): Operator | null {
    if (bearerOf(request) !== null) return null;
    const id = this.idOf(request);
    return id === null ? null : { id, name: this.nameOf(id, request) };
  }

  private idOf(request: Request): string | null {
    const session = cookieOf(request, SESSION_COOKIE);
    const entry = session === null ? null : this.access.entryOf(session);
    if (entry !== null) return entry.id;
    const secret = cookieOf(request, BROWSER_COOKIE) ?? this.fresh.get(request) ?? null;
    return secret === null ? null : createHash("sha256").update(secret).digest("hex").slice(0, 16);
  }

  /** Two browsers of one kind have different names: "Chrome on Linux", "Chrome (2) on Linux": not as a version. */
  private nameOf(id: string, request: Request): string {
    const [what, where] = browserWords(request);
    const named = (number: number): string => `${what}${number === 1 ? "" : ` (${number})`} on ${where}`;
    const known = this.names.get(id);
    if (known?.endsWith(where) === true) return known;
    const taken = new Set(this.names.values());
    let number = 1;
    while (taken.has(named(number))) number++;
    this.names.delete(id);
    this.names.set(id, named(number));
    const [oldest] = this.names.keys();
    if (this.names.size > MAX_NAMES && oldest !== undefined) this.names.delete(oldest);
    return named(number);
  }

  /** Sets the cookie of every new browser with the answer to its first request. */
  routes(): Router {
    const router = Router();
    router.use((request, response, next) => {
      const isBrowser = request.headers["user-agent"]?.startsWith("Mozilla/") === true;
      if (isBrowser && !isCrossOrigin(request) && cookieOf(request, BROWSER_COOKIE) === null) {
        const secret = randomBytes(24).toString("base64url");
        this.fresh.set(request, secret);
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

/**
 * For everything under /api: a browser needs the operator lock to change anything, except to stop a plot. Those that only
 * submit jobs do not operate.
 */
export function requireOperator(
  browsers: Browsers,
  operatorLock: OperatorLock,
  isRunning: IsRunning,
): Router {
  const router = Router();
  router.use((request, response, next) => {
    const isSubmitter = callerIn(response).role === "submit";
    const isFree = isSubmitter || SAFE_METHODS.has(request.method) || isStop(request, isRunning);
    const browser =
      isFree || request.path === `/v1${OPERATIONS.operator.take.path}` ? null : browsers.of(request);
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

/** "Firefox on Android (192.168.1.20)". */
export const deviceName = (request: Pick<Request, "headers" | "socket">): string =>
  browserWords(request).join(" on ");

/** "Firefox" and "Android (192.168.1.20)": enough for people to recognize the device. */
function browserWords(request: Pick<Request, "headers" | "socket">): readonly [what: string, where: string] {
  const agent = request.headers["user-agent"] ?? "";
  const find = (table: typeof BROWSERS, other: string): string =>
    table.find(([pattern]) => pattern.test(agent))?.[1] ?? other;
  const address = (request.socket.remoteAddress ?? "").replace(/^::ffff:/, "");
  const where = /^(127\.|::1$)/.test(address) ? "this computer" : address;
  return [find(BROWSERS, "A browser"), `${find(SYSTEMS, "some system")} (${where})`];
}
