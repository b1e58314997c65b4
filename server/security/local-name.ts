/**
 * The server's name on the network: http://plotwright.local, or plotwright-2.local where another server has that.
 *
 * mDNS has no one who gives names away: whoever wants one asks for it three times and takes it when nobody answers
 * (RFC 6762, 8.1); of two who ask at once the lexicographically later one wins, and the other asks again (8.2); who
 * hears another use its name asks again too (9). A name that was had is asked for first next time, so that after a
 * power cut every server has its own again.
 *
 *   asking ──nobody answers──> announced ──another is heard, or the network is another──> asking
 *     └──another has it──> asking for the next name
 */
import type { EventEmitter } from "node:events";
import { networkInterfaces } from "node:os";
import { Bonjour, type Service } from "bonjour-service";

export const MDNS_NAME = "plotwright";

const LAST_NAME = new RegExp(`^(${MDNS_NAME}(?:-[1-9]\\d{0,3})?)\\.local$`);

const ASKS = 3;
/** Between two questions, ms (RFC 6762, 8.1). */
const ASK_EVERY_MS = 250;
/** How long who has lost to another that asks leaves it to announce itself (8.2). */
const YIELD_MS = 1_000;
/** Until the next try where nothing can be sent: the network may come up later than the server. */
const NO_NETWORK_MS = 5_000;

export interface LocalNameOptions {
  readonly port: number;
  readonly isTls: boolean;
  /** The name that it had last, as "plotwright-2.local". */
  readonly last?: string | undefined;
  /** The name that it has now; null while it has none. */
  readonly onName?: (name: string | null) => void;
  readonly log?: (line: string) => void;
  /** A socket other than the system's own, and its pace. */
  readonly socket?: EventEmitter;
  readonly askEveryMs?: number;
  readonly yieldMs?: number;
}

interface DnsRecord {
  readonly name: string;
  readonly type: string;
  readonly ttl?: number;
  readonly data: unknown;
}

interface DnsPacket {
  readonly answers?: readonly DnsRecord[];
  readonly additionals?: readonly DnsRecord[];
  readonly authorities?: readonly DnsRecord[];
}

/** As much of multicast-dns, which the library holds, as is used here. */
interface Mdns extends EventEmitter {
  query(packet: object, done: (error?: Error | null) => void): void;
}

export class LocalName {
  readonly #options: LocalNameOptions;
  readonly #bonjour: Bonjour;
  readonly #mdns: Mdns;
  /** All that were this computer's: an answer of its own from before it moved is nobody else's. */
  readonly #addresses = new Set<string>();
  #label: string;
  #asked = 0;
  #service: Service | null = null;
  #timer: NodeJS.Timeout | undefined;
  #isClosed = false;
  #hasFailed = false;

  constructor(options: LocalNameOptions) {
    this.#options = options;
    this.#label = LAST_NAME.exec(options.last ?? "")?.[1] ?? MDNS_NAME;
    const line = options.socket === undefined ? {} : { socket: options.socket };
    this.#bonjour = new Bonjour(line as Record<string, unknown>, () => undefined);
    this.#mdns = (this.#bonjour as unknown as { readonly server: { readonly mdns: Mdns } }).server.mdns;
    // An error that nobody hears ends the process; what cannot be sent is told where it is sent.
    this.#mdns.on("error", () => undefined);
    this.#mdns.on("response", (packet: DnsPacket) => this.#onAnswer(packet));
    this.#mdns.on("query", (packet: DnsPacket) => this.#onQuestion(packet));
    this.#mdns.on("networkInterface", () => this.#onNetwork());
    this.#ask(0);
  }

  /** "plotwright-2.local"; null while it has none. */
  get name(): string | null {
    return this.#service === null ? null : this.#host;
  }

  /** Gives the name back. */
  close(): Promise<void> {
    this.#isClosed = true;
    clearTimeout(this.#timer);
    return new Promise((resolve) => {
      this.#bonjour.unpublishAll(() => this.#bonjour.destroy(() => resolve()));
    });
  }

  get #host(): string {
    return `${this.#label}.local`;
  }

  get #fullName(): string {
    return `${this.#label}._${this.#type}._tcp.local`;
  }

  get #type(): string {
    return this.#options.isTls ? "https" : "http";
  }

  /** Starts asking for the name anew. */
  #ask(inMs: number): void {
    this.#asked = 0;
    this.#later(inMs);
  }

  #later(inMs: number): void {
    clearTimeout(this.#timer);
    if (this.#isClosed) return;
    this.#timer = setTimeout(() => this.#askOnce(), inMs).unref();
  }

  #askOnce(): void {
    if (this.#asked === ASKS) {
      this.#announce();
      return;
    }
    const questions = [this.#host, this.#fullName].map((name) => ({ name, type: "ANY" }));
    this.#mdns.query({ questions, authorities: this.#claim() }, (error) => {
      if (error) this.#onNoNetwork(error);
      else {
        this.#asked++;
        this.#later(this.#options.askEveryMs ?? ASK_EVERY_MS);
      }
    });
  }

  /** What it will say of the name, which decides between two who ask at once. */
  #claim(): DnsRecord[] {
    for (const address of ownAddresses()) this.#addresses.add(address);
    const service = { port: this.#options.port, target: this.#host, priority: 0, weight: 0 };
    return [
      { name: this.#fullName, type: "SRV", ttl: 120, data: service },
      ...[...this.#addresses].map((data) => ({ name: this.#host, type: "A", ttl: 120, data })),
    ];
  }

  #announce(): void {
    const { port, log, onName } = this.#options;
    // The library would ask once more, and write to the console what it hears.
    const service = { name: this.#label, type: this.#type, port, host: this.#host, probe: false };
    this.#service = this.#bonjour.publish(service);
    this.#hasFailed = false;
    log?.(`this server is at ${this.#type}://${this.#host}:${port} on the network`);
    onName?.(this.#host);
  }

  /** Takes the name back where it is announced already. */
  #withdraw(): void {
    if (this.#service === null) return;
    (this.#service.stop as () => void)();
    this.#service = null;
    this.#options.onName?.(null);
  }

  #onAnswer({ answers = [], additionals = [] }: DnsPacket): void {
    if (this.#isClosed || ![...answers, ...additionals].some((record) => this.#isAnothers(record))) return;
    if (this.#service === null) {
      this.#options.log?.(`${this.#host} is another server's on this network`);
      this.#label = nextLabel(this.#label);
    }
    this.#withdraw();
    this.#ask(0);
  }

  #onQuestion({ authorities = [] }: DnsPacket): void {
    if (this.#isClosed || this.#service !== null) return;
    const theirs = authorities.filter((record) => this.#isOfName(record));
    if (!theirs.some((record) => this.#isAnothers(record))) return;
    if (inOrder(theirs) > inOrder(this.#claim())) this.#ask(this.#options.yieldMs ?? YIELD_MS);
  }

  /** What the library has announced lacks the addresses of a network that came later. */
  #onNetwork(): void {
    if (this.#isClosed || this.#service === null) return;
    this.#withdraw();
    this.#ask(0);
  }

  #onNoNetwork(error: Error): void {
    if (!this.#hasFailed) {
      this.#options.log?.(
        `${this.#host} cannot be announced on the network (${error.message}); its address works, and the name is tried again`,
      );
    }
    this.#hasFailed = true;
    this.#ask(NO_NETWORK_MS);
  }

  #isOfName({ name, type }: DnsRecord): boolean {
    const is = (other: string): boolean => name.toLowerCase() === other.toLowerCase();
    return (type === "A" && is(this.#host)) || (type === "SRV" && is(this.#fullName));
  }

  /** A record of this name that is not as this server says it, and not one that takes it back. */
  #isAnothers(record: DnsRecord): boolean {
    if (record.ttl === 0 || !this.#isOfName(record)) return false;
    if (record.type === "A") return !this.#addresses.has(String(record.data));
    return portOf(record) !== this.#options.port;
  }
}

function ownAddresses(): string[] {
  return Object.values(networkInterfaces())
    .flatMap((list) => list ?? [])
    .filter(({ family, internal }) => family === "IPv4" && !internal)
    .map(({ address }) => address);
}

function nextLabel(label: string): string {
  const number = /-(\d+)$/.exec(label)?.[1];
  return `${MDNS_NAME}-${number === undefined ? 2 : Number(number) + 1}`;
}

const portOf = ({ data }: DnsRecord): unknown => (data as { readonly port?: unknown }).port;

/** Both sides order both claims alike, whatever the order they were sent in. */
const inOrder = (records: readonly DnsRecord[]): string =>
  records
    .map((record) => `${record.type} ${record.type === "A" ? String(record.data) : String(portOf(record))}`)
    .sort()
    .join(" ");
