/** Which requests the service worker answers, and how. Separate from it, for tests. */

interface ShellRequest {
  readonly method: string;
  readonly url: string;
  /** "navigate": a page is opened. */
  readonly mode: string;
}

/**
 * "page": the page itself: from the server, or from the cache if the server does not answer.
 * "cached": a file whose name has a hash, or an icon: from the cache if it is there.
 * null: not handled. This includes the API, because an old response would show a wrong state of the plotter.
 *
 * `page`: the page's address, which ends with "/".
 */
export const ruleFor = ({ method, url, mode }: ShellRequest, page: string): "page" | "cached" | null => {
  const { origin, pathname } = new URL(url);
  if (method !== "GET" || !`${origin}${pathname}`.startsWith(page)) return null;
  const file = `${origin}${pathname}`.slice(page.length);
  if (mode === "navigate") return file === "" || file === "index.html" ? "page" : null;
  const isCached = file.startsWith("assets/") || /^[\w.-]+\.(svg|png|webmanifest)$/.test(file);
  return isCached ? "cached" : null;
};

/**
 * The caches to delete, given all of them, oldest first: all but the current one and the one before it, from which
 * pages that are still open may load parts.
 */
export const cachesToDrop = (
  names: readonly string[],
  prefix: string,
  current: string,
): readonly string[] => {
  const before = names.filter((name) => name.startsWith(prefix) && name !== current);
  return before.slice(0, -1);
};

interface Lookup {
  match(request: Request): Promise<Response | undefined>;
}
interface Caches extends Lookup {
  open(name: string): Promise<Lookup>;
}

/**
 * A file from the cache `current`, or else from the previous one. `caches.match` alone searches the oldest cache first,
 * which has old versions of the files without a hash.
 */
export const cachedAnswer = async (
  caches: Caches,
  current: string,
  request: Request,
): Promise<Response | undefined> => {
  const cache = await caches.open(current);
  return (await cache.match(request)) ?? caches.match(request);
};
