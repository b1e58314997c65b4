/**
 * The server's name on the network: http://plotwright.local, or plotwright-2.local if that is taken.
 *
 * mDNS has no authority that assigns names. A host that wants a name probes for it three times and takes it
 * if no host answers (RFC 6762, 8.1). If two probe at the same time, the one whose records are
 * lexicographically later wins, and the other probes again (8.2). A host that receives a claim of its name from
 * another one probes again as well (9). The last name is probed first after a restart, so that every server gets its own
 * name back after a power cut.
 *
 *   probing ──no host answers─> announced ──another host uses it, or the network changes──> probing
 *     └──another host has it──> probing for the next name
 */
// eslint-disable-next-line @typescript-eslint/triple-slash-reference -- the package has no types
/// <reference path="./multicast-dns.d.ts" />
import type { EventEmitter } from "node:events";
import { networkInterfaces } from "node:os";
import multicastDns, {
  type DnsPacket,
  type DnsQuestion,
  type DnsRecord,
  type MulticastDns,
} from "multicast-dns";
import { LOCAL_NAME } from "../../security/network.js";
import { answerTo, recordsOf, sameName } from "./service-records.js";

const LAST_NAME = new RegExp(`^(${LOCAL_NAME}(?:-[1-9]\\d{0,3})?)\\.local$`);

const PROBES = 3;
/** Time between two probes (RFC 6762, 8.1). */
const PROBE_INTERVAL_MS = 250;
/** How long the loser of a simultaneous probe waits for the winner to announce itself (8.2). */
const YIELD_MS = 1_000;
/** Time until the next try when nothing can be sent: the network may come up later than the server. */
const NO_NETWORK_MS = 5_000;
/**
 * So many names may be taken at once. Then each further probe waits (8.1), so that a device that claims all names causes
 * no flood.
 */
const FAST_CONFLICTS = 15;
const CONTESTED_MS = 5_000;
/** A record is multicast at most once in this time (6), but sooner in reply to a probe, which must not take the name. */
const REPEAT_MS = 1_000;
/** Pauses between announcements (8.3): devices that were asleep or missed one receive the next. */
const ANNOUNCE_AFTER_MS = [1_000, 2_000, 4_000];

export interface LocalNameOptions {
  readonly port: number;
  readonly isTls: boolean;
  /** The name of the last run, as "plotwright-2.local". */
  readonly last?: string | undefined;
  /** Called with each new name; null while the server has none. */
  readonly onName?: (name: string | null) => void;
  readonly log?: (line: string) => void;
  /** Socket and times for tests, in place of the real ones. */
  readonly socket?: EventEmitter;
  readonly probeIntervalMs?: number;
  readonly yieldMs?: number;
}

export class LocalName {
  private readonly mdns: MulticastDns;
  /** All addresses this computer has had: an answer with one of them is an old answer of this server. */
  private readonly addresses = new Set<string>();
  private label: string;
  private probeCount = 0;
  /** Since the server last had a name. */
  private conflictCount = 0;
  /** The announced records; null while the server has no name. */
  private records: readonly DnsRecord[] | null = null;
  /** When each of the announced records was last sent, in ms of `performance.now()`. */
  private readonly sentAtMs = new WeakMap<DnsRecord, number>();
  /** For the next probe or announcement. */
  private timer: NodeJS.Timeout | undefined;
  private isClosed = false;
  private hasFailed = false;

  constructor(private readonly options: LocalNameOptions) {
    this.label = LAST_NAME.exec(options.last ?? "")?.[1] ?? LOCAL_NAME;
    this.mdns = multicastDns(options.socket === undefined ? {} : { socket: options.socket });
    // An "error" event without a listener would end the process. Send errors are reported by query().
    this.mdns.on("error", () => undefined);
    this.mdns.on("response", (packet: DnsPacket) => this.onAnswer(packet));
    this.mdns.on("query", (packet: DnsPacket) => this.onQuestion(packet));
    this.mdns.on("networkInterface", () => this.onNetwork());
    this.probe(0);
  }

  /** The current name, as "plotwright-2.local"; null while the server has none. */
  get name(): string | null {
    return this.records === null ? null : this.host;
  }

  /** Gives up the name. */
  close(): Promise<void> {
    this.isClosed = true;
    clearTimeout(this.timer);
    return new Promise((resolve) => {
      this.sayGoodbye(() => this.mdns.destroy(resolve));
    });
  }

  private get host(): string {
    return `${this.label}.local`;
  }

  private get probeIntervalMs(): number {
    return this.options.probeIntervalMs ?? PROBE_INTERVAL_MS;
  }

  private get fullName(): string {
    return `${this.label}.${this.type}`;
  }

  private get type(): string {
    return `_${this.scheme}._tcp.local`;
  }

  private get scheme(): string {
    return this.options.isTls ? "https" : "http";
  }

  /** Starts probing for the name again. */
  private probe(inMs: number): void {
    this.probeCount = 0;
    this.schedule(inMs);
  }

  private schedule(inMs: number): void {
    clearTimeout(this.timer);
    if (this.isClosed) return;
    this.timer = setTimeout(() => this.probeOnce(), inMs).unref();
  }

  private probeOnce(): void {
    if (this.probeCount === PROBES) {
      this.announce();
      return;
    }
    const questions = [this.host, this.fullName].map((name) => ({ name, type: "ANY" }));
    this.mdns.query({ questions, authorities: this.claim() }, (error) => {
      if (error) this.onNoNetwork(error);
      else {
        this.probeCount++;
        this.schedule(this.probeIntervalMs);
      }
    });
  }

  /** The records this server will announce; they decide between two simultaneous probes. */
  private claim(): DnsRecord[] {
    for (const address of ownAddresses("IPv4")) this.addresses.add(address);
    const service = { port: this.options.port, target: this.host, priority: 0, weight: 0 };
    return [
      { name: this.fullName, type: "SRV", ttl: 120, data: service },
      ...[...this.addresses].map((data) => ({ name: this.host, type: "A", ttl: 120, data })),
    ];
  }

  private announce(): void {
    const { port, log, onName } = this.options;
    this.records = recordsOf({
      host: this.host,
      type: this.type,
      fullName: this.fullName,
      port,
      addresses: [...ownAddresses("IPv4"), ...ownAddresses("IPv6")],
    });
    this.repeatAnnouncement(0);
    this.hasFailed = false;
    this.conflictCount = 0;
    log?.(`the server's address on the network is ${this.scheme}://${this.host}:${port}`);
    onName?.(this.host);
  }

  private repeatAnnouncement(count: number): void {
    if (this.records === null) return;
    this.respond({ answers: this.records });
    const pauseMs = ANNOUNCE_AFTER_MS[count];
    if (pauseMs === undefined) return;
    this.timer = setTimeout(() => this.repeatAnnouncement(count + 1), pauseMs).unref();
  }

  private respond(packet: DnsPacket): void {
    const nowMs = performance.now();
    for (const record of recordsIn(packet)) this.sentAtMs.set(record, nowMs);
    this.mdns.respond(packet);
  }

  /** Withdraws the name if it was announced. */
  private withdraw(): void {
    if (this.records === null) return;
    this.sayGoodbye();
    this.options.onName?.(null);
  }

  /** Tells the network that the announced records are no longer valid. */
  private sayGoodbye(sent: () => void = () => undefined): void {
    const records = this.records;
    this.records = null;
    if (records === null) sent();
    else this.mdns.respond({ answers: records.map((record) => ({ ...record, ttl: 0 })) }, () => sent());
  }

  private onAnswer(packet: DnsPacket): void {
    if (this.isClosed || !recordsIn(packet).some((record) => this.isAnothers(record))) return;
    if (this.records === null) {
      this.options.log?.(`${this.host} is in use by another server on this network`);
      this.label = nextLabel(this.label);
    }
    this.withdraw();
    this.conflictCount++;
    this.probe(this.conflictCount < FAST_CONFLICTS ? 0 : CONTESTED_MS);
  }

  private onQuestion({ questions = [], authorities = [] }: DnsPacket): void {
    if (this.isClosed) return;
    if (this.records !== null) {
      this.answer(this.records, questions, authorities.length > 0);
      return;
    }
    const theirs = authorities.filter((record) => this.isOfName(record));
    if (!theirs.some((record) => this.isAnothers(record))) return;
    if (inOrder(theirs) > inOrder(this.claim())) this.probe(this.options.yieldMs ?? YIELD_MS);
  }

  /** A record that was just sent is left out: all devices on the network have received it. */
  private answer(records: readonly DnsRecord[], questions: readonly DnsQuestion[], isProbe: boolean): void {
    const pauseMs = isProbe ? this.probeIntervalMs : REPEAT_MS;
    for (const question of questions) {
      const nowMs = performance.now();
      const due = records.filter((record) => nowMs - (this.sentAtMs.get(record) ?? -Infinity) >= pauseMs);
      const answer = answerTo(question, due);
      if (answer !== null) this.respond(answer);
    }
  }

  /** The announced records lack the addresses of a network that appears later, so announce again. */
  private onNetwork(): void {
    if (this.isClosed || this.records === null) return;
    this.withdraw();
    this.probe(0);
  }

  private onNoNetwork(error: Error): void {
    if (!this.hasFailed) {
      this.options.log?.(
        `${this.host} cannot be announced on the network (${error.message}); use the server's address until the next try succeeds`,
      );
    }
    this.hasFailed = true;
    this.probe(NO_NETWORK_MS);
  }

  private isOfName({ name, type }: DnsRecord): boolean {
    return (type === "A" && sameName(name, this.host)) || (type === "SRV" && sameName(name, this.fullName));
  }

  /**
   * Whether another host claims this name: a record of it that differs from this server's and is not a
   * withdrawal.
   */
  private isAnothers(record: DnsRecord): boolean {
    if (record.ttl === 0 || !this.isOfName(record)) return false;
    if (record.type === "A") return !this.addresses.has(String(record.data));
    return portOf(record) !== this.options.port;
  }
}

const recordsIn = ({ answers = [], additionals = [] }: DnsPacket): readonly DnsRecord[] => [
  ...answers,
  ...additionals,
];

function ownAddresses(wanted: "IPv4" | "IPv6"): string[] {
  return Object.values(networkInterfaces())
    .flatMap((list) => list ?? [])
    .filter(({ family, internal }) => family === wanted && !internal)
    .map(({ address }) => address);
}

function nextLabel(label: string): string {
  const number = /-(\d+)$/.exec(label)?.[1];
  return `${LOCAL_NAME}-${number === undefined ? 2 : Number(number) + 1}`;
}

const portOf = ({ data }: DnsRecord): unknown => (data as { readonly port?: unknown }).port;

/** Text for comparing two claims. Sorted, so that the order of the records does not matter. */
const inOrder = (records: readonly DnsRecord[]): string =>
  records
    .map((record) => `${record.type} ${record.type === "A" ? String(record.data) : String(portOf(record))}`)
    .sort()
    .join(" ");
