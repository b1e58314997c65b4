/**
 * Logs refused requests: the first ones of each minute in full, the others as a number. Otherwise anyone could fill the
 * log, and push out what it says about faults.
 */
/** An HTTP request, or the connection of one that could not be read. */
interface Refused {
  readonly method?: string | undefined;
  readonly url?: string | undefined;
  /** Express shortens `url` to the part below a route. */
  readonly originalUrl?: string | undefined;
  readonly socket: { readonly remoteAddress?: string | undefined };
}

const PERIOD_MS = 60_000;
const MAX_LINES = 10;
/** Longer paths are cut. */
const MAX_PATH = 100;

export class Refusals {
  private count = 0;
  /** `total` at the start of the current period, and the requests of the period by address. */
  private before = 0;
  private readonly addresses = new Map<string, number>();
  private timer: NodeJS.Timeout | null = null;

  constructor(private readonly log: (line: string) => void) {}

  /** All refusals since the server was started. */
  get total(): number {
    return this.count;
  }

  note(request: Refused, why: string): void {
    const address = request.socket.remoteAddress ?? "?";
    this.count++;
    if (this.count - this.before <= MAX_LINES) {
      const { method, originalUrl: url = request.url } = request;
      const what = method === undefined || url === undefined ? "a request" : `${method} ${pathOf(url)}`;
      this.log(`refused ${what} from ${address}: ${why}`);
    } else {
      const isKnown = this.addresses.has(address) || this.addresses.size < MAX_LINES;
      const counted = isKnown ? address : "others";
      this.addresses.set(counted, (this.addresses.get(counted) ?? 0) + 1);
    }
    this.timer ??= setTimeout(() => this.close(), PERIOD_MS).unref();
  }

  /** Ends the period: logs the number of requests that have no line. */
  close(): void {
    if (this.timer !== null) clearTimeout(this.timer);
    this.timer = null;
    const addresses = [...this.addresses].map(([address, count]) => `${count} from ${address}`);
    if (addresses.length > 0) this.log(`refused more requests: ${addresses.join(", ")}`);
    this.addresses.clear();
    this.before = this.count;
  }
}

/** The path as it was sent, in quotes if it has anything unusual. */
function pathOf(url: string): string {
  const path = url.split("?", 1)[0] ?? "";
  const cut = path.length > MAX_PATH ? `${path.slice(0, MAX_PATH)}…` : path;
  return /^[\w/.:-]*…?$/.test(cut) ? cut : JSON.stringify(cut);
}
