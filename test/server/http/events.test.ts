/** The event stream to clients that read slowly or not at all. */
import express from "express";
import { createServer, type Server } from "node:http";
import { connect, type AddressInfo, type Socket } from "node:net";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { EventHub } from "../../../server/http/events.js";
import type { Snapshot } from "../../../src/schema/index.js";
import { makeJob } from "../../support/jobs/jobs.js";

let http: Server;
let hub: EventHub;
let client: Socket;
let received: number;
let isOpen: boolean;

/** More than the system's own buffers and the limit together. */
const LARGE = 30_000_000;

beforeEach(() => {
  hub = new EventHub();
});
afterEach(async () => {
  client.destroy();
  hub.close();
  await new Promise((resolve) => http.close(resolve));
});

/** A client that does not read yet, after the server has written its snapshot. */
async function open(snapshotBytes: number): Promise<void> {
  const snapshot: Snapshot = {
    ...{ version: "x".repeat(snapshotBytes), plotters: [], plotterSettings: {}, localName: null },
    ...{ jobs: [], hasOlderJobs: false },
    ...{ queue: { runOn: false }, queues: {}, operator: null, serverNotices: [], machines: [] },
  };
  const app = express();
  const opened = new Promise<void>((resolve) => {
    app.get("/", (request, response) => {
      void hub.open(request, response, { id: "me", seesOnlyOwn: false }, () => snapshot);
      isOpen = true;
      response.on("close", () => (isOpen = false));
      resolve();
    });
  });
  http = createServer(app);
  await new Promise<void>((resolve) => http.listen(0, "127.0.0.1", resolve));
  client = connect((http.address() as AddressInfo).port, "127.0.0.1", () => {
    client.write("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
  });
  client.on("error", () => undefined);
  received = 0;
  await opened;
}

const read = (): void => void client.on("data", (chunk: Buffer) => (received += chunk.length));
const announce = (bytes: number): void =>
  hub.announce({ type: "job", job: makeJob("a", { message: "x".repeat(bytes) }) });
const settled = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 20));

describe("the event stream", () => {
  it("sends a client all of a large snapshot, with the events that come meanwhile", async () => {
    await open(LARGE);
    for (let count = 0; count < 3; count++) {
      announce(1_000_000);
      await settled();
    }
    expect(isOpen).toBe(true);
    read();
    await expect.poll(() => received).toBeGreaterThan(LARGE + 3_000_000);
    expect(isOpen).toBe(true);
  });

  it("disconnects a client that does not read the events after a large snapshot", async () => {
    await open(LARGE);
    for (let count = 0; count < 6; count++) announce(1_000_000);
    await expect.poll(() => isOpen).toBe(false);
  });

  it("no longer allows for the snapshot once it has been sent", async () => {
    await open(LARGE);
    read();
    await expect.poll(() => received).toBeGreaterThan(LARGE);
    client.pause();
    // What the system buffers is sent too, so it does not count. Linux buffers up to 36 MB for a fast client.
    for (let count = 0; count < 100 && isOpen; count++) {
      announce(1_000_000);
      await settled();
    }
    expect(isOpen).toBe(false);
  });
});
