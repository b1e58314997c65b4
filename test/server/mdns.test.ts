/** plotwright.local, on a network inside this process: what is announced is found, and taken back in the end. */
import { EventEmitter } from "node:events";
import { Bonjour, type Service } from "bonjour-service";
import { describe, expect, it } from "vitest";
import { announceOnLan } from "../../server/security/network.js";

type Sent = (error: Error | null) => void;

/** As much of a UDP socket as mDNS uses; what one sends, all others of its network hear. */
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

describe("the name on the network", () => {
  it.each([
    ["http", false],
    ["https", true],
  ] as const)("is plotwright.local, with the port, for %s", async (type, isTls) => {
    const network = new Set<Line>();
    const phone = new Bonjour({ socket: new Line(network) } as object);
    const takeBack = announceOnLan(9080, isTls, { socket: new Line(network) });
    const service = await found(phone, type);
    expect([service.name, service.host, service.port]).toEqual(["plotwright", "plotwright.local", 9080]);
    await takeBack();
    phone.destroy();
    expect(network.size).toBe(0);
  });

  it("is taken back when the server stops", async () => {
    const network = new Set<Line>();
    const phone = new Bonjour({ socket: new Line(network) } as object);
    const seen = phone.find({ type: "http" });
    const takeBack = announceOnLan(9080, false, { socket: new Line(network) });
    await new Promise((resolve) => seen.once("up", resolve));
    const gone = new Promise<Service>((resolve) => seen.once("down", resolve));
    await takeBack();
    expect((await gone).name).toBe("plotwright");
    phone.destroy();
  });

  it.each(["EADDRINUSE", "EACCES", "ENETUNREACH"])(
    "disturbs nothing where the system refuses: %s",
    async (code) => {
      const fault = Object.assign(new Error(`bind ${code}`), { code });
      const line = new Line(new Set(), fault);
      const refused = new Promise((resolve) => line.once("error", resolve));
      const takeBack = announceOnLan(9080, false, { socket: line });
      expect(await refused).toBe(fault);
      await takeBack();
    },
  );
});
