/** The pictures of jobs on disk: their limits, and what happens to them. */
import fc from "fast-check";
import { existsSync, mkdirSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { PictureFiles, thinned, type PictureFile } from "../../../../server/plugins/camera/picture-files.js";
import { BLUE, RED } from "../../../support/camera/fake-camera.js";
import { folderOfTest } from "../../../support/processes/folders.js";

const LIMITS = { maxCount: 10, maxJobBytes: 1_000_000, maxTotalBytes: 1_000_000 };
const picture = (bytes: Uint8Array) => ({ kind: "jpg" as const, bytes });

describe("the pictures that a job keeps", () => {
  it("are within the limits and evenly spread, however many were taken, with the first and the newest", () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 10, max: 60 }),
        fc.integer({ min: 1, max: 600 }),
        fc.integer({ min: 1, max: 60_000 }),
        (maxCount, taken, everyMs) => {
          let kept: PictureFile[] = [];
          for (let i = 0; i < taken; i++) {
            const file = { atMs: i * everyMs, bytes: 10, kind: "jpg" as const };
            ({ kept } = thinned([...kept, file], { maxCount, maxJobBytes: 1e9 }));
          }
          expect(kept.length).toBe(Math.min(taken, maxCount));
          expect([kept[0].atMs, kept[kept.length - 1].atMs]).toEqual([0, (taken - 1) * everyMs]);
          const gaps = kept.slice(1).map(({ atMs }, i) => atMs - kept[i].atMs);
          // The newest may have come just now.
          const whole = gaps.slice(0, -1);
          expect(Math.max(...gaps)).toBeLessThanOrEqual(4 * Math.min(...(whole.length > 0 ? whole : gaps)));
        },
      ),
    );
  });

  it("take no more bytes than they may", () => {
    fc.assert(
      fc.property(fc.array(fc.integer({ min: 1, max: 500 }), { minLength: 2, maxLength: 60 }), (sizes) => {
        const files = sizes.map((bytes, i) => ({ atMs: i, bytes, kind: "jpg" as const }));
        const { kept, dropped } = thinned(files, { maxCount: 1_000, maxJobBytes: 2_000 });
        expect([...kept, ...dropped].sort((a, b) => a.atMs - b.atMs)).toEqual(files);
        expect(kept.reduce((sum, { bytes }) => sum + bytes, 0)).toBeLessThanOrEqual(2_000);
      }),
    );
  });

  it("are on disk, and there for the next server; what was being written is not", async () => {
    const dir = folderOfTest();
    const files = new PictureFiles(dir, LIMITS);
    for (let i = 0; i < 25; i++) await files.add("job-a", picture(i % 2 === 0 ? RED : BLUE), 1_000 + i);
    await files.add("job-b", picture(BLUE), 5_000);
    writeFileSync(join(dir, "pictures", "job-a", "9999.jpg.new"), "half");
    writeFileSync(join(dir, "pictures", "job-a", "notes.txt"), "of someone else");
    const next = new PictureFiles(dir, LIMITS);
    expect(await next.list("job-a")).toEqual(await files.list("job-a"));
    expect(readdirSync(join(dir, "pictures", "job-a")).sort()).toEqual(
      [...(await next.list("job-a")).map(({ atMs }) => `${atMs}.jpg`), "notes.txt"].sort(),
    );
    expect(Buffer.from(await next.read("job-b", 5_000)).equals(BLUE)).toBe(true);
    await expect(next.read("job-b", 5_001)).rejects.toThrow("There is no such picture");
    await expect(next.add("../up", picture(RED), 1)).rejects.toThrow("Not a job's id");
  });

  it("that are missing are counted, also by the next server, and forgotten with the job's pictures", async () => {
    const dir = folderOfTest();
    const files = new PictureFiles(dir, LIMITS);
    expect(await files.missing("job-a")).toBe(0);
    for (let i = 0; i < 3; i++) await files.addMissing("job-a");
    await files.add("job-a", picture(RED), 1_000);
    const next = new PictureFiles(dir, LIMITS);
    expect([await next.missing("job-a"), (await next.list("job-a")).length]).toEqual([3, 1]);
    await next.addMissing("job-a");
    expect(await next.missing("job-a")).toBe(4);
    await next.remove("job-a");
    expect(await next.missing("job-a")).toBe(0);
    expect(existsSync(join(dir, "pictures", "job-a"))).toBe(false);
    // Of a job without any picture, too.
    await next.addMissing("job-b");
    await new PictureFiles(dir, LIMITS).sweep(() => false);
    expect(existsSync(join(dir, "pictures", "job-b"))).toBe(false);
  });

  it("go with the job, and those of the oldest plots when there is no more room", async () => {
    const dir = folderOfTest();
    const files = new PictureFiles(dir, { ...LIMITS, maxTotalBytes: 3 * RED.length });
    for (const [i, id] of ["old", "newer", "newest"].entries()) await files.add(id, picture(RED), 1_000 * i);
    await files.add("newest", picture(RED), 9_000);
    expect(readdirSync(join(dir, "pictures")).sort()).toEqual(["newer", "newest"]);
    await files.remove("newer");
    expect(existsSync(join(dir, "pictures", "newer"))).toBe(false);
    expect(await files.list("newer")).toEqual([]);
  });

  it("of missing jobs are removed only after a month", async () => {
    const dir = folderOfTest();
    mkdirSync(join(dir, "pictures"));
    const files = new PictureFiles(dir, LIMITS);
    for (const id of ["kept", "missing"]) await files.add(id, picture(RED), 1_000);
    const isJob = (id: string): boolean => id === "kept";
    await files.sweep(isJob, 86_400_000);
    expect((await files.list("missing")).length).toBe(1);
    await files.sweep(isJob, 31 * 86_400_000);
    expect([(await files.list("missing")).length, (await files.list("kept")).length]).toEqual([0, 1]);
  });
});
