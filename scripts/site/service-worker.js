/** Stores the start page and the whole documentation, so that it can be read in a workshop without a network. */
const VERSION = "__VERSION__";
const FILES = "__FILES__";
const PREFIX = "manual-";

self.addEventListener("install", (event) => event.waitUntil(fetchAll()));
self.addEventListener("activate", (event) => event.waitUntil(takeOver()));
self.addEventListener("fetch", (event) => {
  const { request } = event;
  const isOurs = request.url.startsWith(self.registration.scope);
  if (request.method === "GET" && isOurs) event.respondWith(fetchedOrStored(request));
});

async function fetchAll() {
  const cache = await caches.open(PREFIX + VERSION);
  await cache.addAll(FILES.map((file) => new Request(file, { cache: "reload" })));
  await self.skipWaiting();
}

async function takeOver() {
  const old = (await caches.keys()).filter((name) => name.startsWith(PREFIX) && name !== PREFIX + VERSION);
  await Promise.all(old.map((name) => caches.delete(name)));
  await self.clients.claim();
}

async function fetchedOrStored(request) {
  try {
    return await fetch(request);
  } catch (error) {
    const page = request.url.replace(/\/$/, "/index.html");
    const stored = await caches.match(page, { ignoreSearch: true });
    if (stored === undefined) throw error;
    return stored;
  }
}
