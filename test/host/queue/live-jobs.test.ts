/** Live drawings as jobs, and how they are stored. */
import fc from "fast-check";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { importDrawing } from "../../../src/index.js";
import { machineOf, prepareJob } from "../../../src/internal.js";
import { folderOfTest } from "../../support/processes/folders.js";
import { openQueueIn, settled } from "../../support/jobs/open-queue.js";
import { cases } from "../../support/runs/full-run.js";

describe("a live job", () => {
  it("is stored as the strokes were received, in their order and place, whatever is taken back", async () => {
    const coordinate = fc.oneof(
      fc.integer({ min: 0, max: 200 }),
      fc.double({ min: 0, max: 200, noNaN: true }),
    );
    const points = fc.array(fc.tuple(coordinate, coordinate), { minLength: 1, maxLength: 5 });
    const step = fc.oneof(
      fc.record({ what: fc.constantFrom("stroke" as const, "grow" as const), points }),
      fc.record({ what: fc.constantFrom("lift" as const, "undo" as const, "wait" as const) }),
    );
    await fc.assert(
      fc.asyncProperty(fc.array(step, { maxLength: 12 }), async (steps) => {
        const dir = folderOfTest();
        const opened = openQueueIn(dir);
        const { strokes, job, ended } = await opened.queue.live.begin("virtual", {});
        const run = await opened.nextRun();
        for (const one of steps) {
          if (one.what === "stroke") strokes.stroke(one.points);
          if (one.what === "grow") for (const [x, y] of one.points) strokes.lineTo(x, y);
          if (one.what === "lift") strokes.penUp();
          if (one.what === "undo") strokes.undo();
          if (one.what === "wait") await new Promise((resolve) => setTimeout(resolve, 120));
        }
        const { xy, offsets } = strokes.strokes;
        const expected = [...xy];
        const stored = opened.queue.drawingOf(job.id);
        strokes.end();
        run.end({ kind: "done" });
        const { settings } = await ended;
        await opened.close();
        const text = readFileSync(join(dir, "drawings", `${stored}.svg`), "utf8");
        if (expected.length === 0) {
          expect(text).not.toContain("<path");
          return;
        }
        const { prepared } = prepareJob(await importDrawing("x.svg", text), settings, machineOf(settings));
        expect(prepared.strokes.xy.length).toBe(expected.length);
        prepared.strokes.xy.forEach((value, i) => expect(value).toBeCloseTo(expected[i], 3));
        expect([...prepared.strokes.offsets]).toEqual([...offsets]);
      }),
      { numRuns: cases(200, 15) },
    );
  }, 200_000);

  it.each(["emergency stop", "resume and pause"])(
    "stays as it is after a %s while its sender did not answer, when that answers again",
    async (what) => {
      const opened = openQueueIn(folderOfTest());
      const live = await opened.queue.live.begin("virtual", {});
      const { id } = live.job;
      const run = await opened.nextRun();
      live.hold(true);
      expect(opened.queue.get(id).state).toBe("paused");
      if (what === "emergency stop") await opened.queue.plots.emergencyStop(id);
      else {
        opened.queue.plots.resume(id);
        await settled();
        live.hold(false);
        opened.queue.plots.pause(id);
      }
      const asked = run.asked.length;
      live.hold(false);
      await settled();
      expect(run.asked.slice(asked)).toEqual([]);
      expect(opened.queue.get(id).state).toBe("paused");
      run.end({ kind: "done" });
      await opened.close();
    },
  );

  it("goes on when its sender answers again, also if that is while the pen is still coming to rest", async () => {
    const opened = openQueueIn(folderOfTest());
    const live = await opened.queue.live.begin("virtual", {});
    const run = await opened.nextRun();
    run.pause = () => {
      run.asked.push("pause");
      return Promise.resolve();
    };
    live.hold(true);
    live.hold(true);
    live.hold(false);
    run.held(true);
    expect(opened.queue.get(live.job.id)).toMatchObject({
      state: "paused",
      message: expect.stringMatching(/does not answer/) as string,
    });
    live.hold(false);
    await settled();
    expect(run.asked).toEqual(["pause", "resume"]);
    expect(opened.queue.get(live.job.id).state).toBe("plotting");
    // A user's own pause stays.
    opened.queue.plots.pause(live.job.id);
    run.held(true);
    live.hold(false);
    expect(opened.queue.get(live.job.id).state).toBe("paused");
    run.end({ kind: "done" });
    await opened.close();
  });

  it("is not begun on a plotter that is plotting or gone, and leaves nothing behind", async () => {
    const opened = openQueueIn(folderOfTest());
    await opened.plotting();
    await expect(opened.queue.live.begin("virtual", {})).rejects.toMatchObject({ code: "busy" });
    await expect(opened.queue.live.begin("none", {})).rejects.toMatchObject({ code: "not-found" });
    expect(opened.queue.list()).toHaveLength(1);
    await opened.close();
  });
});
