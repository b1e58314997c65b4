/** The queue agrees with a simple model of it. */
import fc from "fast-check";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { folderOfTest } from "../../support/processes/folders.js";
import { openQueueIn, settled, type OpenQueue } from "../../support/jobs/open-queue.js";
import { cases } from "../../support/runs/full-run.js";

let dir: string;
let parts: OpenQueue;
beforeEach(() => {
  dir = folderOfTest();
  parts = openQueueIn(dir);
});
afterEach(() => parts.close());

describe("the queue", () => {
  it("agrees with a simple list on the queued jobs and their order, after any requests", async () => {
    const step = fc.record({
      ask: fc.constantFrom("add", "move", "remove", "start", "end", "fail", "cancel", "requeue", "reopen"),
      at: fc.nat(7),
      to: fc.nat(7),
    });
    await fc.assert(
      fc.asyncProperty(fc.array(step, { maxLength: 25 }), async (steps) => {
        await parts.queue.close();
        for (const job of parts.queue.list()) await parts.queue.remove(job.id);
        parts.store.close();
        parts = openQueueIn(dir);
        // The model: ids of unfinished jobs in order, the one that plots, and the finished ones.
        let open: string[] = [];
        let plotting: string | null = null;
        let ended: string[] = [];
        for (const { ask, at, to } of steps) {
          const waiting = open.filter((id) => id !== plotting);
          const one = waiting[at % (waiting.length || 1)];
          if (ask === "add") open.push((await parts.add(`job ${open.length}`)).id);
          if (ask === "move" && one !== undefined) {
            const rest = open.filter((id) => id !== one);
            const index = to % (rest.length + 1);
            parts.queue.move(one, rest[index] ?? null);
            rest.splice(index, 0, one);
            open = rest;
          }
          if (ask === "remove" && one !== undefined) {
            await parts.queue.remove(one);
            open = open.filter((id) => id !== one);
          }
          if (ask === "start" && one !== undefined && plotting === null) {
            await parts.queue.start(one);
            plotting = one;
          }
          if ((ask === "end" || ask === "fail") && plotting !== null) {
            const run = await parts.nextRun();
            if (ask === "end") run.end({ kind: "done" });
            else run.fail(new Error("broken"));
            await settled();
            open = open.filter((id) => id !== plotting);
            ended.push(plotting);
            plotting = null;
          }
          if (ask === "cancel" && one !== undefined) {
            parts.queue.plots.cancel(one);
            open = open.filter((id) => id !== one);
            ended.push(one);
          }
          const again = ended[at % (ended.length || 1)];
          if (ask === "requeue" && again !== undefined) {
            parts.queue.requeue(again);
            ended = ended.filter((id) => id !== again);
            open.push(again);
          }
          if (ask === "reopen") {
            parts.store.close();
            parts = openQueueIn(dir);
            // Interrupted, and the user discards it.
            if (plotting !== null) parts.queue.plots.cancel(plotting);
            if (plotting !== null) ended.push(plotting);
            open = open.filter((id) => id !== plotting);
            plotting = null;
          }
          const listed = parts.queue.list();
          expect(listed.slice(0, open.length).map((job) => job.id)).toEqual(open);
          expect(new Set(listed.slice(open.length).map((job) => job.id))).toEqual(new Set(ended));
          expect(listed.filter((job) => job.state === "plotting").map((job) => job.id)).toEqual(
            plotting === null ? [] : [plotting],
          );
        }
      }),
      { numRuns: cases(40) },
    );
  });
});
