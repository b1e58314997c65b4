/**
 * plotwright.local, on a network inside this process: what is announced can be found, and is withdrawn at the
 * end.
 */
import { EventEmitter } from "node:events";
import { Bonjour, type Service } from "bonjour-service";
import multicastDns, { type DnsPacket, type MulticastDns } from "multicast-dns";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { LocalName, type LocalNameOptions } from "../../../../server/plugins/local-name/local-name.js";
import { answerTo, recordsOf } from "../../../../server/plugins/local-name/service-records.js";

type Sent = (error: Error | null) => void;

/** The part of a UDP socket that mDNS uses; what one sends, all others on its network receive. */
class Line extends EventEmitter {
  constructor(
    private readonly network: Set<Line>,
    private readonly fault: NodeJS.ErrnoException | null = null,
  ) {
    super();
  }

  bind(_port: number, _address: string | undefined, done: () => void): void {
    setImmediate(() => {
      if (this.fault !== null) {
        this.emit("error", this.fault);
        return;
      }
      this.network.add(this);
      this.emit("listening");
      done();
    });
  }

  send(bytes: Buffer, from: number, length: number, port: number, address: string, sent: Sent): void {
    const packet = Buffer.from(bytes.subarray(from, from + length));
    for (const other of this.network) {
      if (other !== this) setImmediate(() => other.emit("message", packet, { address, port }));
    }
    setImmediate(sent, null);
  }

  close(done?: () => void): void {
    this.network.delete(this);
    if (done) setImmediate(done);
  }

  addMembership(): void {}
  dropMembership(): void {}
  setMulticastTTL(): void {}
  setMulticastLoopback(): void {}
  setMulticastInterface(): void {}
}

const found = (phone: Bonjour, type: string): Promise<Service> =>
  new Promise((resolve) => phone.findOne({ type }, 30_000, (service: Service) => resolve(service)));

const NETWORK = (): Set<Line> => new Set<Line>();
const PACE = { probeIntervalMs: 5, yieldMs: 50 };

/** A server on a network; `names` are those that it had, in order. */
class Announcer {
  readonly names: (string | null)[] = [];
  readonly logged: string[] = [];
  readonly local: LocalName;
  private onChange: () => void = () => undefined;

  constructor(socket: Line, options: Partial<LocalNameOptions> = {}) {
    this.local = new LocalName({
      port: 9080,
      isTls: false,
      socket,
      ...PACE,
      onName: (name) => {
        this.names.push(name);
        this.onChange();
      },
      log: (line) => {
        this.logged.push(line);
        this.onChange();
      },
      ...options,
    });
  }

  until(isSo: (announcer: this) => boolean): Promise<void> {
    return new Promise((resolve) => {
      this.onChange = () => {
        if (isSo(this)) resolve();
      };
      this.onChange();
    });
  }

  async named(name: string): Promise<void> {
    await this.until(() => this.local.name === name);
  }
}

/** A device that sends arbitrary packets. */
const stranger = (network: Set<Line>): MulticastDns => multicastDns({ socket: new Line(network) });

describe("the name on the network", () => {
  it.each([
    ["http", false],
    ["https", true],
  ] as const)("is plotwright.local, with the port, for %s", async (type, isTls) => {
    const network = NETWORK();
    const phone = new Bonjour({ socket: new Line(network) } as object);
    const { local, logged } = new Announcer(new Line(network), { isTls });
    const service = await found(phone, type);
    expect([service.name, service.host, service.port]).toEqual(["plotwright", "plotwright.local", 9080]);
    expect(logged).toEqual([`the server's address on the network is ${type}://plotwright.local:9080`]);
    await local.close();
    phone.destroy();
    expect(network.size).toBe(0);
  });

  it("is withdrawn when the server stops", async () => {
    const network = NETWORK();
    const phone = new Bonjour({ socket: new Line(network) } as object);
    const seen = phone.find({ type: "http" });
    const { local } = new Announcer(new Line(network));
    await new Promise((resolve) => seen.once("up", resolve));
    const gone = new Promise<Service>((resolve) => seen.once("down", resolve));
    await local.close();
    expect((await gone).name).toBe("plotwright");
    phone.destroy();
  });

  it.each(["EADDRINUSE", "EACCES", "ENETUNREACH"])(
    "does no harm if the system refuses, and reports that once: %s",
    async (code) => {
      const fault = Object.assign(new Error(`bind ${code}`), { code });
      const server = new Announcer(new Line(new Set(), fault));
      await server.until(({ logged }) => logged.length > 0);
      expect(server.logged).toEqual([
        `plotwright.local cannot be announced on the network (bind ${code}); use the server's address until the next try succeeds`,
      ]);
      expect(server.local.name).toBe(null);
      await server.local.close();
    },
  );
});

describe("the answer to a question", () => {
  const records = recordsOf({
    host: "plotwright.local",
    type: "_http._tcp.local",
    fullName: "plotwright._http._tcp.local",
    port: 9080,
    addresses: ["192.168.1.4", "fd00::4"],
  });
  const typesOf = (name: string, type: string): (readonly string[])[] | null => {
    const answer = answerTo({ name, type }, records);
    const types = (list: readonly { type: string }[] = []): string[] => list.map((record) => record.type);
    return answer && [types(answer.answers), types(answer.additionals)];
  };

  it("has the addresses of the name, in capitals too", () => {
    expect(answerTo({ name: "Plotwright.local", type: "A" }, records)?.answers).toEqual([
      { name: "plotwright.local", type: "A", ttl: 120, data: "192.168.1.4" },
    ]);
    expect(typesOf("plotwright.local", "ANY")).toEqual([["A", "AAAA"], []]);
  });

  it("has port and addresses with the service, and nothing for other names", () => {
    expect(typesOf("_http._tcp.local", "PTR")).toEqual([["PTR"], ["PTR", "SRV", "TXT", "A", "AAAA"]]);
    expect(typesOf("plotwright._http._tcp.local", "SRV")).toEqual([["SRV"], []]);
    expect(typesOf("printer.local", "A")).toBeNull();
  });
});

describe("two servers on one network", () => {
  it("have two names: the second reports that the first is taken, and which one it has", async () => {
    const network = NETWORK();
    const first = new Announcer(new Line(network));
    await first.named("plotwright.local");
    const second = new Announcer(new Line(network), { port: 9081 });
    await second.named("plotwright-2.local");
    const third = new Announcer(new Line(network), { port: 9082 });
    await third.named("plotwright-3.local");
    expect(first.names).toEqual(["plotwright.local"]);
    expect(second.logged).toEqual([
      "plotwright.local is in use by another server on this network",
      "the server's address on the network is http://plotwright-2.local:9081",
    ]);
    for (const { local } of [first, second, third]) await local.close();
  });

  it("have two names if they probe in the same instant", async () => {
    const network = NETWORK();
    const servers = [9080, 9081, 9082].map((port) => new Announcer(new Line(network), { port }));
    await Promise.all(servers.map((server) => server.until(({ local }) => local.name !== null)));
    expect(new Set(servers.map(({ local }) => local.name)).size).toBe(3);
    for (const { local } of servers) await local.close();
  });

  it("have two names if their networks are joined later", async () => {
    const [here, there] = [NETWORK(), NETWORK()];
    const lines = [new Line(here), new Line(there)] as const;
    const servers = lines.map((line, index) => new Announcer(line, { port: 9080 + index }));
    await Promise.all(servers.map((server) => server.named("plotwright.local")));
    here.add(lines[1]);
    there.add(lines[0]);
    // Somebody queries the name, so that each receives the other's answer.
    const phone = new Bonjour({ socket: new Line(here) } as object);
    phone.find({ type: "http" });
    await Promise.race(servers.map((server) => server.until(({ names }) => names.includes(null))));
    await Promise.all(servers.map((server) => server.until(({ local }) => local.name !== null)));
    await Promise.race(servers.map((server) => server.named("plotwright-2.local")));
    expect(servers.map(({ local }) => local.name).sort()).toEqual(["plotwright-2.local", "plotwright.local"]);
    phone.destroy();
    for (const { local } of servers) await local.close();
  });

  it("keep their own names over a power cut, whichever is back first", async () => {
    const network = NETWORK();
    const second = new Announcer(new Line(network), { port: 9081, last: "plotwright-2.local" });
    await second.named("plotwright-2.local");
    const first = new Announcer(new Line(network), { last: "plotwright.local" });
    await first.named("plotwright.local");
    for (const { local } of [first, second]) await local.close();
  });

  it("do not use a stored name of an unknown form", async () => {
    const server = new Announcer(new Line(NETWORK()), { last: "evil.example.local" });
    await server.until(({ local }) => local.name !== null);
    expect(server.local.name).toBe("plotwright.local");
    await server.local.close();
  });

  it("are not disturbed by a device that withdraws the name, nor by one with another name", async () => {
    const network = NETWORK();
    const server = new Announcer(new Line(network));
    await server.named("plotwright.local");
    const device = stranger(network);
    const announce = (name: string, ttl: number): void =>
      device.respond({ answers: [{ name, type: "A", ttl, data: "203.0.113.7" }] });
    announce("plotwright.local", 0);
    announce("printer.local", 120);
    await new Promise((resolve) => setImmediate(() => setImmediate(() => setImmediate(resolve))));
    expect(server.names).toEqual(["plotwright.local"]);
    announce("Plotwright.local", 120);
    await server.until(({ names }) => names.length === 3);
    expect(server.names).toEqual(["plotwright.local", null, "plotwright.local"]);
    device.destroy();
    await server.local.close();
  });
});

describe("a flood on the network", () => {
  beforeEach(() => vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout", "performance"] }));
  afterEach(() => void vi.useRealTimers());

  /** Lets `seconds` pass, and calls `each` every 10 ms; packets need a few turns of the event loop. */
  async function pass(seconds: number, each: () => void = () => undefined): Promise<void> {
    for (let i = 0; i < seconds * 100; i++) {
      each();
      for (let turn = 0; turn < 4; turn++) await new Promise((resolve) => setImmediate(resolve));
      await vi.advanceTimersByTimeAsync(10);
    }
  }

  it.each([
    ["plotwright.local", "A"],
    ["plotwright.local", "ANY"],
    ["_http._tcp.local", "PTR"],
    ["plotwright._http._tcp.local", "SRV"],
  ])(
    "a flood of questions for %s %s is answered at most once a second",
    { timeout: 20_000 },
    async (name, type) => {
      const network = NETWORK();
      const announcer = new Announcer(new Line(network));
      const asking = stranger(network);
      await pass(10);
      expect(announcer.local.name).toBe("plotwright.local");
      const times = new Map<string, number>();
      asking.on("response", ({ answers = [], additionals = [] }: DnsPacket) => {
        for (const record of [...answers, ...additionals]) {
          const key = JSON.stringify([record.name, record.type, record.data]);
          times.set(key, (times.get(key) ?? 0) + 1);
        }
      });
      await pass(4.5, () => asking.query({ questions: [{ name, type }] }));
      expect(times.size).toBeGreaterThan(0);
      expect(Math.max(...times.values())).toBe(5);
      const closing = announcer.local.close();
      await pass(0.1);
      await closing;
      asking.destroy();
    },
  );

  it(
    "a flood of questions leaves the name defended against another server",
    { timeout: 20_000 },
    async () => {
      const network = NETWORK();
      const first = new Announcer(new Line(network), { probeIntervalMs: 250 });
      await pass(2);
      const asking = stranger(network);
      const second = new Announcer(new Line(network), { port: 9081, probeIntervalMs: 250 });
      await pass(3, () => asking.query({ questions: [{ name: "plotwright.local", type: "ANY" }] }));
      expect([first.local.name, second.local.name]).toEqual(["plotwright.local", "plotwright-2.local"]);
      const closing = Promise.all([first.local.close(), second.local.close()]);
      await pass(0.1);
      await closing;
      asking.destroy();
    },
  );

  it("a flood of claims for every name is probed against slowly", { timeout: 20_000 }, async () => {
    const network = NETWORK();
    const device = stranger(network);
    let probeCount = 0;
    device.on("query", ({ questions = [] }: DnsPacket) => {
      probeCount++;
      device.respond({ answers: [{ name: questions[0].name, type: "A", ttl: 120, data: "203.0.113.7" }] });
    });
    const announcer = new Announcer(new Line(network), { probeIntervalMs: 250 });
    await pass(20);
    expect(announcer.local.name).toBe(null);
    // 15 at once, then one each 5 s.
    expect(probeCount).toBe(15 + 3);
    const closing = announcer.local.close();
    await pass(0.1);
    await closing;
    device.destroy();
  });
});
