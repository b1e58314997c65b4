/** The part of multicast-dns that is used here; the package includes no types. */
declare module "multicast-dns" {
  import type { EventEmitter } from "node:events";

  export interface DnsRecord {
    readonly name: string;
    readonly type: string;
    /** Seconds; 0 withdraws the record. */
    readonly ttl?: number;
    readonly data: unknown;
  }

  export interface DnsQuestion {
    readonly name: string;
    readonly type: string;
  }

  export interface DnsPacket {
    readonly questions?: readonly DnsQuestion[];
    readonly answers?: readonly DnsRecord[];
    readonly additionals?: readonly DnsRecord[];
    readonly authorities?: readonly DnsRecord[];
  }

  type Sent = (error?: Error | null) => void;

  /** Events: "query" and "response" with a DnsPacket, "networkInterface" when a network was joined, "error". */
  export interface MulticastDns extends EventEmitter {
    query(packet: DnsPacket, sent?: Sent): void;
    respond(packet: DnsPacket, sent?: Sent): void;
    destroy(done?: () => void): void;
  }

  /** `socket`: in place of a UDP socket. */
  export default function multicastDns(options?: { readonly socket?: EventEmitter }): MulticastDns;
}
