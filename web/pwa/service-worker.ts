/**
 * Caches the page's own files, so that the page opens, and can say so, when the server is unreachable. Never caches API
 * responses. A new version takes over only after all of its files are fetched.
 */
import { cachedAnswer, cachesToDrop, ruleFor } from "./shell-rules.js";

/** Written by the build: paths of the page's files, relative to this one, and a version that changes with them. */
const SHELL = JSON.parse("__SHELL__") as { readonly version: string; readonly files: readonly string[] };
const PREFIX = "plotwright-";
const CACHE = `${PREFIX}${SHELL.version}`;
/** If the server takes longer, the cached page is shown: a request to a server that is off may take a minute to fail. */
const PAGE_TIMEOUT_MS = 4_000;

/** The service-worker types used here; TypeScript's DOM library lacks them. */
interface Waiting extends Event {
  waitUntil(done: Promise<unknown>): void;
}
interface Fetching extends Waiting {
  readonly request: Request;
  respondWith(answer: Promise<Response>): void;
}
interface Clicking extends Waiting {
  readonly notification: Notification;
}
interface Clients {
  claim(): Promise<void>;
  /** The most recently focused page first. */
  matchAll(options: { readonly type: "window" }): Promise<readonly { focus(): Promise<unknown> }[]>;
  openWindow(url: string): Promise<unknown>;
}
interface Scope {
  readonly location: Location;
  readonly clients: Clients;
  skipWaiting(): Promise<void>;
  addEventListener(type: "install" | "activate", listener: (event: Waiting) => void): void;
  addEventListener(type: "fetch", listener: (event: Fetching) => void): void;
  addEventListener(type: "notificationclick", listener: (event: Clicking) => void): void;
}
const scope = globalThis as unknown as Scope;
/** Address of the page, and of the folder with its files. */
const PAGE = new URL("./", scope.location.href).href;

scope.addEventListener("install", (event) => event.waitUntil(fetchShell()));
scope.addEventListener("activate", (event) => event.waitUntil(takeOver()));
scope.addEventListener("fetch", (event) => {
  const rule = ruleFor(event.request, PAGE);
  if (rule === "page") event.respondWith(pageOrCached(event.request));
  if (rule === "cached") event.respondWith(cachedOrFetched(event.request));
});
scope.addEventListener("notificationclick", (event) => {
  event.notification.close();
  event.waitUntil(showPage());
});

async function fetchShell(): Promise<void> {
  const cache = await caches.open(CACHE);
  // Bypasses the browser's own cache, which may have an old version of a file without a hash.
  await cache.addAll(SHELL.files.map((file) => new Request(new URL(file, PAGE), { cache: "reload" })));
  await scope.skipWaiting();
}

async function takeOver(): Promise<void> {
  const names = cachesToDrop(await caches.keys(), PREFIX, CACHE);
  await Promise.all(names.map((name) => caches.delete(name)));
  await scope.clients.claim();
}

/** Brings the page to the front, or opens it if it was closed. */
async function showPage(): Promise<void> {
  const page = (await scope.clients.matchAll({ type: "window" })).at(0);
  await (page === undefined ? scope.clients.openWindow(PAGE) : page.focus());
}

async function pageOrCached(request: Request): Promise<Response> {
  const fetched = fetch(request);
  // If it fails after the cached page was shown, nothing is left to do.
  fetched.catch(() => undefined);
  const late = new Promise<null>((resolve) => setTimeout(() => resolve(null), PAGE_TIMEOUT_MS));
  try {
    const first = await Promise.race([fetched, late]);
    if (first?.ok) return first;
  } catch {
    // No server: the cached page is shown instead.
  }
  const cache = await caches.open(CACHE);
  return (await cache.match(PAGE)) ?? fetched;
}

async function cachedOrFetched(request: Request): Promise<Response> {
  return (await cachedAnswer(caches, CACHE, request)) ?? fetch(request);
}
