/** The table of operations: its rows, and the requests that clients make from them. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  API_PATH,
  clientOf,
  OPERATIONS,
  requestOf,
  type Operation,
  type OperationInput,
} from "../../../src/schema/index.js";

const ROWS = Object.values<Readonly<Record<string, Operation>>>(OPERATIONS).flatMap((group) =>
  Object.values(group),
);
const titleOf = ({ method, path }: Operation): string => `${method} ${path}`;
const withRole = (...roles: Operation["role"][]): string[] =>
  ROWS.filter(({ role }) => roles.includes(role)).map(titleOf);

describe("the table of operations", () => {
  it("has each method and path once, with at most one id", () => {
    const titles = ROWS.map(titleOf);
    expect(new Set(titles).size).toBe(titles.length);
    expect(ROWS.filter(({ path }) => (path.match(/:/g) ?? []).length > 1)).toEqual([]);
  });

  it("lets those who only watch read everything but secrets, and stop a plot", () => {
    expect(withRole("stop")).toEqual([
      "post /jobs/:id/pause",
      "post /jobs/:id/cancel",
      "post /jobs/:id/emergency-stop",
      "post /plotters/:id/stop",
    ]);
    const isForWatchers = ({ role }: Operation): boolean => role === "all" || role === "watch";
    const notForWatchers = ROWS.filter((one) => one.method === "get" && !isForWatchers(one));
    expect(notForWatchers.map(titleOf)).toEqual([
      // A WebSocket that draws.
      "get /plotters/:id/live",
      "get /logs",
      "get /access",
      "get /webhooks",
      "get /plotters/:id/camera",
    ]);
    expect(ROWS.filter((one) => one.method !== "get" && isForWatchers(one))).toEqual([]);
  });

  it("lets those who only submit jobs add them and change their own, and see nothing of others", () => {
    expect(withRole("submit")).toEqual([
      "post /drawings",
      "post /jobs",
      "patch /jobs/:id",
      "post /jobs/:id/requeue",
      "post /jobs/:id/duplicate",
      "delete /jobs/:id",
    ]);
    expect(withRole("watch")).toEqual([
      "get /jobs/:id/place",
      "get /plotters/:id/log",
      "get /library",
      "get /library/:path",
      "get /shared-jobs",
    ]);
  });

  it("shows the links that pair a device only on the server's computer", () => {
    expect(withRole("local")).toEqual(["post /pairing"]);
  });
});

describe("a client of the table", () => {
  const sent: { one: Operation; input: OperationInput; name: string }[] = [];
  const client = clientOf(OPERATIONS, (one, input, group, name) => {
    sent.push({ one, input, name: `${group} ${name}` });
    return Promise.resolve(null);
  });

  it("passes the id in the path, then the body", async () => {
    sent.length = 0;
    await client.jobs.pause("a");
    await client.jobs.move("b", { beforeId: null });
    await client.state.setQueue({ runOn: true });
    await client.state.me();
    expect(sent.map(({ name, input }) => ({ name, ...input }))).toEqual([
      { name: "jobs pause", id: "a", sent: undefined },
      { name: "jobs move", id: "b", sent: { beforeId: null } },
      { name: "state setQueue", sent: { runOn: true } },
      { name: "state me", sent: undefined },
    ]);
  });

  it("makes the request that the HTTP reference describes", () => {
    const json = { "content-type": "application/json" };
    const request = { method: "POST", headers: {} };
    expect(requestOf(OPERATIONS.jobs.pause, { id: "a" })).toEqual({
      ...request,
      path: "/api/v1/jobs/a/pause",
    });
    expect(requestOf(OPERATIONS.jobs.move, { id: "a", sent: { beforeId: "b" } })).toEqual({
      method: "POST",
      path: "/api/v1/jobs/a/move",
      headers: json,
      body: '{"beforeId":"b"}',
    });
    expect(requestOf(OPERATIONS.drawings.upload, { sent: "<svg/>" })).toEqual({
      ...request,
      path: "/api/v1/drawings",
      body: "<svg/>",
    });
    const after = { after: "a&b", plotterId: undefined };
    expect(requestOf(OPERATIONS.state.history, { sent: after }).path).toBe("/api/v1/history?after=a%26b");
    expect(requestOf(OPERATIONS.state.history, { sent: {} }).path).toMatch(/^\/api\/v1\/history\??$/);
  });

  it("keeps any id inside its part of the path", () => {
    fc.assert(
      fc.property(fc.string({ minLength: 1 }), (id) => {
        const { path } = requestOf(OPERATIONS.jobs.pause, { id });
        const parts = path.slice(API_PATH.length).split("/");
        expect(parts).toHaveLength(4);
        expect(decodeURIComponent(parts[2])).toBe(id);
      }),
    );
  });
});
