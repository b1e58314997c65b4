/** The DNS records of a server that is announced by mDNS (RFC 6763), and its answers to questions. */
// eslint-disable-next-line @typescript-eslint/triple-slash-reference -- the package has no types
/// <reference path="./multicast-dns.d.ts" />
import type { DnsPacket, DnsQuestion, DnsRecord } from "multicast-dns";

interface AnnouncedService {
  /** "plotwright-2.local" */
  readonly host: string;
  /** "_http._tcp.local" */
  readonly type: string;
  /** "plotwright-2._http._tcp.local" */
  readonly fullName: string;
  readonly port: number;
  /** IPv4 and IPv6 addresses of this computer on its networks. */
  readonly addresses: readonly string[];
}

const HOST_TTL_S = 120;
const TEXT_TTL_S = 4_500;
const TYPE_TTL_S = 28_800;

export function recordsOf({ host, type, fullName, port, addresses }: AnnouncedService): DnsRecord[] {
  return [
    { name: type, type: "PTR", ttl: TYPE_TTL_S, data: fullName },
    { name: "_services._dns-sd._udp.local", type: "PTR", ttl: HOST_TTL_S, data: type },
    { name: fullName, type: "SRV", ttl: HOST_TTL_S, data: { port, target: host, priority: 0, weight: 0 } },
    { name: fullName, type: "TXT", ttl: TEXT_TTL_S, data: [] },
    ...addresses.map((data) => ({
      name: host,
      type: data.includes(":") ? "AAAA" : "A",
      ttl: HOST_TTL_S,
      data,
    })),
  ];
}

/** Null if the question asks for none of these records. */
export function answerTo({ name, type }: DnsQuestion, records: readonly DnsRecord[]): DnsPacket | null {
  const answers = records.filter(
    (record) => sameName(record.name, name) && (type === "ANY" || type === record.type),
  );
  if (answers.length === 0) return null;
  // A client that asks for the service will ask for its port and addresses next.
  const isService = answers.some((record) => record.type === "PTR");
  return { answers, additionals: isService ? records.filter((record) => !answers.includes(record)) : [] };
}

export const sameName = (a: string, b: string): boolean => a.toLowerCase() === b.toLowerCase();
