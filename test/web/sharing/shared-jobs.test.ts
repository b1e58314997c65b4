/** The actions that the page offers for a job of a shared queue. */
import { describe, expect, it } from "vitest";
import {
  SERVER_LOST_AFTER_MS,
  sharedJobSchema,
  type Plotter,
  type SharedJob,
} from "../../../src/schema/index.js";
import { isServerGone, leftOut, machineWanted, possibleAction } from "../../../web/sharing/shared-section.js";

const NOW_MS = Date.parse("2026-11-21T12:00:00Z");
const ago = (ms: number): string => new Date(NOW_MS - ms).toISOString();
const job = (change: Partial<SharedJob>): SharedJob =>
  sharedJobSchema.parse({
    id: "one",
    name: "fern",
    target: "any axidraw-v3",
    state: "waiting",
    server: null,
    message: null,
    createdAt: ago(600_000),
    ...change,
  });
const TAKEN = { state: "stored", server: "Left" } as const;

describe("a shared job", () => {
  it("can be withdrawn while it waits, and not when it was refused or withdrawn", () => {
    expect(possibleAction(job({}), NOW_MS)).toBe("withdraw");
    expect(possibleAction(job({ state: "refused" }), NOW_MS)).toBeNull();
    expect(possibleAction(job({ state: "withdrawn" }), NOW_MS)).toBeNull();
  });

  it("is left with a server that is running", () => {
    const there = job({ ...TAKEN, serverSeenAt: ago(SERVER_LOST_AFTER_MS - 1_000) });
    expect(isServerGone(there, NOW_MS)).toBe(false);
    expect(possibleAction(there, NOW_MS)).toBeNull();
  });

  it("can be given to another server when its own does not answer, unless its plot has begun", () => {
    const lost = { ...TAKEN, serverSeenAt: ago(SERVER_LOST_AFTER_MS + 1_000) };
    expect(possibleAction(job(lost), NOW_MS)).toBe("give-back");
    expect(possibleAction(job({ ...TAKEN, serverSeenAt: null }), NOW_MS)).toBe("give-back");
    expect(isServerGone(job({ ...lost, hasBegun: true }), NOW_MS)).toBe(true);
    expect(possibleAction(job({ ...lost, hasBegun: true }), NOW_MS)).toBeNull();
  });

  it("names the plotters that are left out only because their model is not set", () => {
    const plotter = (id: string, machine: string | null): Plotter =>
      ({ id, name: id, machine }) as Partial<Plotter> as Plotter;
    const plotters = [plotter("new", null), plotter("big", "axidraw-v3-a3"), plotter("fits", "axidraw-v3")];
    const idsFor = (change: Partial<SharedJob>): string[] =>
      leftOut(job({ target: "machine axidraw-v3", ...change }), plotters).map(({ id }) => id);
    expect(idsFor({})).toEqual(["new"]);
    expect(idsFor({ target: "plotter new" })).toEqual([]);
    expect(idsFor({ state: "withdrawn" })).toEqual([]);
    expect(machineWanted(job({ target: "machine axidraw-v3" }))).toBe("axidraw-v3");
    expect(machineWanted(job({ target: "plotter machine" }))).toBe(null);
  });
});
