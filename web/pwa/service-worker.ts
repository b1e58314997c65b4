/**
 * Caches the page's own files, so that the page opens without the server and can say that it can't be reached. Never
 * caches API responses. A new version takes over only after all of its files are fetched.
 */
import { cachesToDrop, ruleFor } from "./shell-rules.js";

/** Written by the build: paths of the page's files, relative to this one, and a version that changes with them. */
const SHELL = JSON.parse("__SHELL__") as { readonly version: string; readonly files: readonly string[] };
const PREFIX = "plotwright-";
const CACHE = `${PREFIX}${SHELL.version}`;
/** If the server takes longer, the cached page is shown: a request to a server that is off may take a minute to fail. */
const PATIENCE_MS = 4_000;

/** The used part of a service worker's scope, which the DOM's types do not have. */
interface Waiting extends Event {
  waitUntil(done: Promise<unknown>): void;
}
interface Fetching extends Waiting {
  readonly request: Request;
  respondWith(answer: Promise<Response>): void;
}
interface Scope {
  readonly location: Location;
  readonly clients: { claim(): Promise<void> };
  skipWaiting(): Promise<void>;
  addEventListener(type: "install" | "activate", listener: (event: Waiting) => void): void;
  addEventListener(type: "fetch", listener: (event: Fetching) => void): void;
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

async function pageOrCached(request: Request): Promise<Response> {
  const fetched = fetch(request);
  // If it fails after the cached page was shown, nothing is left to do.
  fetched.catch(() => undefined);
  const late = new Promise<null>((resolve) => setTimeout(() => resolve(null), PATIENCE_MS));
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
  return (await caches.match(request)) ?? fetch(request);
}
