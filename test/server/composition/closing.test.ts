/**
 * Shutting down a server: running plots come first, a part that hangs does not delay the rest, and no timer
 * remains.
 */
import { once } from "node:events";
import { connect } from "node:net";
import { describe, expect, it, onTestFinished } from "vitest";
import { Closing } from "../../../server/composition/closing.js";
import { createServer } from "../../../server/index.js";
import { jobSchema, snapshotSchema } from "../../../src/schema/index.js";
import { seeded } from "../../support/plots/live-plot.js";
import { folderOfTest } from "../../support/processes/folders.js";
import { EventStream } from "../../support/servers/event-stream.js";

/** Longer than the test plots in total, because it plots slowly. */
const SVG =
  '<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="60mm" viewBox="0 0 90 60" stroke="black">' +
  `${Array.from({ length: 500 }, (_, i) => `<path d="M5 ${5 + i / 10}h80"/>`).join("")}</svg>`;

describe("closing", () => {
  it("begins with the running plot, then closes the parts from the latest to the first", async () => {
    const order: string[] = [];
    const closing = new Closing(() => undefined);
    for (const name of ["a", "b"]) closing.add(name, () => void order.push(name));
    closing.addUrgent("plots", () => void order.push("plots"));
    closing.add("c", () => void order.push("c"));
    await Promise.all([closing.run(), closing.run()]);
    expect(order).toEqual(["plots", "c", "b", "a"]);
  });

  it("names what hangs or fails, and closes the rest anyway", async () => {
    const logged: string[] = [];
    const closing = new Closing((line) => logged.push(line), { partMs: 20, plotsMs: 20 });
    let isClosed = false;
    closing.add("the database", () => void (isClosed = true));
    closing.add("the net", () => Promise.reject(new Error("no route")));
    closing.addUrgent("what plots", () => new Promise(() => undefined));
    await closing.run();
    expect(isClosed).toBe(true);
    expect(logged).toEqual([
      "closing: what plots did not close within 0.02 s; continuing without it",
      "closing: the net: no route",
    ]);
  });
});

describe("a server that is closed", () => {
  async function start() {
    const data = folderOfTest();
    const logged: string[] = [];
    const options = { port: 0, device: "virtual", virtualSpeed: 30, dataDir: data };
    const server = await createServer({ ...options, log: (line) => logged.push(line) });
    onTestFinished(() => server.close());
    return { server, options, logged };
  }

  it("does not wait for a refused connection that is left half open", async () => {
    const { server, logged } = await start();
    for (const text of [
      "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\r\n",
      "NONSENSE\r\n\r\n",
    ]) {
      const socket = connect({
        port: Number(new URL(server.url).port),
        host: "127.0.0.1",
        allowHalfOpen: true,
      });
      onTestFinished(() => void socket.destroy());
      socket.on("error", () => undefined);
      socket.write(text);
      await once(socket, "data");
    }
    await server.close();
    expect(logged.filter((line) => line.startsWith("closing"))).toEqual([]);
  });

  it("a server that is closed at any instant of a plot or a hold leaves no timer, and a plot that can be resumed", async () => {
    const timers = watchTimers();
    onTestFinished(() => timers.end());
    const { server: first, options, logged } = await start();
    let server = first;
    const random = seeded(7);
    const added = await fetch(`${server.url}/api/v1/jobs?name=lines.svg`, { method: "POST", body: SVG });
    const { id } = jobSchema.parse(await added.json());
    const post = (action: string): Promise<Response> =>
      fetch(`${server.url}/api/v1/jobs/${id}/${action}`, { method: "POST" });
    await post("start");
    for (let i = 0; i < 12; i++) {
      const events = await EventStream.open(server.url);
      for (const action of ["pause", "resume", "pause", "resume"].slice(0, i % 5)) {
        await post(action);
        // While it slows down or starts moving.
        const count = events.seen.length + Math.floor(4 * random());
        await expect
          .poll(() => events.seen.length, { interval: 3, timeout: 300 })
          .toBeGreaterThan(count)
          .catch(() => 0);
      }
      events.close();
      await server.close();
      expect(timers.left()).toEqual([]);
      server = await createServer({ ...options, log: (line) => logged.push(line) });
      onTestFinished(() => server.close());
      const snapshot: unknown = await (await fetch(`${server.url}/api/v1/state`)).json();
      expect(snapshotSchema.parse(snapshot).jobs[0]).toMatchObject({ state: "interrupted" });
      expect((await post("recover")).status).toBe(200);
      await post("resume");
    }
    expect(logged.filter((line) => line.startsWith("closing"))).toEqual([]);
  });
});

/** The pending timers of our own code, each by where it was set. */
function watchTimers(): { left(): string[]; end(): void } {
  const { setTimeout: set, clearTimeout: clear } = globalThis;
  const left = new Map<unknown, string>();
  const watched = (
    callback: (...args: unknown[]) => void,
    ms?: number,
    ...args: unknown[]
  ): NodeJS.Timeout => {
    const timer = set(
      (...given: unknown[]) => {
        left.delete(timer);
        callback(...given);
      },
      ms,
      ...args,
    );
    const from = new Error()
      .stack!.split("\n")
      .find((line) => /\/(server|src)\//.test(line) && !/\/test\//.test(line));
    if (from !== undefined) left.set(timer, from.trim());
    return timer;
  };
  globalThis.setTimeout = watched as unknown as typeof setTimeout;
  globalThis.clearTimeout = (timer) => {
    left.delete(timer);
    clear(timer);
  };
  return {
    left: () => [...left.values()],
    end: () => {
      globalThis.setTimeout = set;
      globalThis.clearTimeout = clear;
    },
  };
}
