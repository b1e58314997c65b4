/** Which requests the service worker answers, and how. Pure, for tests. */

export interface Asked {
  readonly method: string;
  readonly url: string;
  /** "navigate": a page is opened. */
  readonly mode: string;
}

/**
 * "page": the page itself, from the server while it answers, else as it was last time.
 * "kept": a file whose name has a hash, or an icon: from the cache where it is.
 * null: everything else goes its way as without a service worker. The API above all: an old answer of it would be a
 * lie about what the plotter does.
 *
 * `page`: the page's address, which ends with "/".
 */
export const ruleFor = ({ method, url, mode }: Asked, page: string): "page" | "kept" | null => {
  const { origin, pathname } = new URL(url);
  if (method !== "GET" || !`${origin}${pathname}`.startsWith(page)) return null;
  const file = `${origin}${pathname}`.slice(page.length);
  if (mode === "navigate") return file === "" || file === "index.html" ? "page" : null;
  const isKept = file.startsWith("assets/") || /^[\w.-]+\.(svg|png|webmanifest)$/.test(file);
  return isKept ? "kept" : null;
};

/** Of the caches that there are, oldest first, those to be thrown away: all but the new one and the one before,
 *  which pages that are still open may take their parts from. */
export const cachesToDrop = (
  names: readonly string[],
  prefix: string,
  current: string,
): readonly string[] => {
  const before = names.filter((name) => name.startsWith(prefix) && name !== current);
  return before.slice(0, -1);
};
