import { spawn } from "node:child_process";
import { readFileSync, readdirSync, utimesSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";
import sqlite from "node-sqlite3-wasm";
import { beforeEach, describe, expect, it, vi } from "vitest";
import { prepareDataDir } from "../../../server/storage/data-dir.js";
import { DrawingFiles } from "../../../server/storage/drawing-files.js";
import { Store } from "../../../server/storage/store.js";
import { drawingOf, makeJob } from "../../support/jobs/jobs.js";
import { pictureOf } from "../../support/processes/store-picture.js";
import { childScript } from "../../support/processes/child-script.js";
import { cases } from "../../support/runs/full-run.js";
import { folderOfTest } from "../../support/processes/folders.js";

let dir: string;
beforeEach(() => {
  dir = folderOfTest();
  prepareDataDir(dir);
});

/** "jobs.id" and so on. */
const ids = (store: Store): string[] => store.jobs().map((job) => job.id);

describe("a store", () => {
  it("returns after reopening exactly the stored jobs, in their order", () => {
    const first = Store.open(dir);
    const jobs = ["a", "b", "c"].map((id) => makeJob(id, { message: `über ${id} 🖊`, warnings: ["x", "y"] }));
    for (const job of jobs) first.addJob(job, drawingOf(job.id));
    first.moveJob("c", "a");
    first.close();
    const second = Store.open(dir);
    expect(second.jobs()).toEqual([jobs[2], jobs[0], jobs[1]]);
    second.close();
  });

  it("lists history after the queue, newest end first", () => {
    const store = Store.open(dir);
    for (const id of ["a", "b", "c", "d"]) store.addJob(makeJob(id), drawingOf(id));
    store.saveJob(makeJob("a", { state: "done", endedAt: "2026-01-02T00:00:00.000Z" }));
    store.saveJob(makeJob("c", { state: "failed", endedAt: "2026-01-03T00:00:00.000Z" }));
    expect(ids(store)).toEqual(["b", "d", "c", "a"]);
    expect(store.order()).toEqual(ids(store));
    store.close();
  });

  it("keeps a drawing as long as any job needs it", () => {
    const store = Store.open(dir);
    const drawing = drawingOf("shared");
    store.addJob(makeJob("a"), drawing);
    store.addJob(makeJob("b"), drawing);
    expect(store.removeJob("a")).toBeNull();
    expect(store.isUsed(drawing.id)).toBe(true);
    expect(store.removeJob("b")).toBe(drawing.id);
    expect(store.isUsed(drawing.id)).toBe(false);
    store.close();
  });

  it("changes nothing when a job is moved before one that is not in the queue", () => {
    const store = Store.open(dir);
    for (const id of ["a", "b"]) store.addJob(makeJob(id), drawingOf(id));
    expect(() => store.moveJob("a", "gone")).toThrow(/no job gone/);
    expect(ids(store)).toEqual(["a", "b"]);
    store.close();
  });

  it("stores settings by name, and distinguishes a missing one from null", () => {
    const store = Store.open(dir);
    store.saveSetting("page", { dark: true });
    store.saveSetting("page", { dark: false });
    store.saveSetting("nothing", null);
    expect(store.setting("page")).toEqual({ dark: false });
    expect(store.setting("nothing")).toBeNull();
    expect(store.setting("missing")).toBeUndefined();
    store.close();
  });

  it("refuses a folder that another server uses, without disturbing it", () => {
    const store = Store.open(dir);
    expect(() => Store.open(dir)).toThrow(/Another plotwright server \(process \d+\) uses the data folder/);
    store.addJob(makeJob("a"), drawingOf("a"));
    store.close();
    const again = Store.open(dir);
    expect(ids(again)).toEqual(["a"]);
    again.close();
  });

  it("takes over a lock whose owner is gone, or whose process number is reused", () => {
    for (const owner of [
      '{"pid":999999999,"began":""}',
      `{"pid":${process.pid},"began":"0@another-boot"}`,
      "{",
    ]) {
      writeFileSync(join(dir, "server.lock"), owner);
      Store.open(dir).close();
      expect(readdirSync(dir).filter((name) => name.startsWith("server.lock"))).toEqual([]);
    }
  });

  it("leaves the lock to a server that took over the stale one first", () => {
    writeFileSync(join(dir, "server.lock"), '{"pid":999999999,"began":""}');
    const isRunning = process.kill.bind(process);
    let other: Store | null = null;
    // The other server takes it over while this one asks whether the owner still runs.
    const asked = vi.spyOn(process, "kill").mockImplementationOnce((...args) => {
      asked.mockRestore();
      other = Store.open(dir);
      return isRunning(...args);
    });
    expect(() => Store.open(dir)).toThrow(/Another plotwright server \(process \d+\) uses the data folder/);
    expect(() => Store.open(dir)).toThrow(/Another plotwright server/);
    expect(readdirSync(dir).filter((name) => name.startsWith("server.lock"))).toEqual(["server.lock"]);
    other!.close();
    Store.open(dir).close();
  });

  it.each([
    ["a newer", 999],
    ["an older", 9],
  ])("refuses a database of %s version without touching it", (which, version) => {
    Store.open(dir).close();
    const path = join(dir, "plotwright.db");
    const db = new sqlite.Database(path);
    db.exec(`PRAGMA locking_mode = EXCLUSIVE; PRAGMA user_version = ${version}`);
    db.close();
    expect(() => Store.open(dir)).toThrow(`made by ${which} plotwright (version ${version};`);
    const after = new sqlite.Database(path);
    after.exec("PRAGMA locking_mode = EXCLUSIVE");
    expect(after.get("PRAGMA user_version")).toEqual({ user_version: version });
    after.close();
  });

  it("names a file that is not a database and leaves the folder free", () => {
    writeFileSync(
      join(dir, "plotwright.db"),
      "this is not SQLite, but long enough to have a header".repeat(40),
    );
    expect(() => Store.open(dir)).toThrow(/can't be opened/);
    expect(() => Store.open(dir)).toThrow(/can't be opened/);
  });

  it("has every change that it reported, whenever it is killed", async () => {
    // Two folders side by side: a process spends most of its time starting, and waiting for the disk.
    const inOne = async (folder: string, firstSeed: number): Promise<void> => {
      for (let seed = firstSeed; seed <= cases(10, 4); seed += 2) {
        const possible = await changeUntilKilled(folder, seed, 3 + ((seed * 37) % 90));
        const store = Store.open(folder);
        const found = pictureOf(store.jobs());
        store.close();
        expect(possible).toContain(found);
      }
    };
    const second = folderOfTest();
    await Promise.all([inOne(dir, 1), inOne(second, 2)]);
  });
});

/** What may be on disk after the kill: the last reported state, or the one in progress. */
async function changeUntilKilled(folder: string, seed: number, lines: number): Promise<string[]> {
  const script = childScript("store-child");
  const child = spawn(process.execPath, [script, folder, String(seed)], {
    stdio: ["ignore", "pipe", "inherit"],
  });
  let done = "";
  let tried = "";
  let count = 0;
  const ended = new Promise((resolve) => child.once("exit", resolve));
  for await (const line of createInterface({ input: child.stdout })) {
    const [what, ...picture] = line.split(" ");
    if (what === "done") done = picture.join(" ");
    else tried = picture.join(" ");
    if (++count === lines) child.kill("SIGKILL");
  }
  await ended;
  expect(count).toBeGreaterThanOrEqual(lines);
  return [done, tried];
}

describe("drawing files", () => {
  it("stores the bytes unchanged, each upload separately", async () => {
    const files = new DrawingFiles(dir, 1_000);
    const parts = [Buffer.from("<svg "), Buffer.from("/>\r\n\0ü")];
    const first = await files.add(parts);
    const second = await files.add([Buffer.concat(parts)]);
    await files.remove(second.id);
    expect(first.bytes).toBe(12);
    expect(readdirSync(join(dir, "drawings"))).toEqual([`${first.id}.svg`]);
    expect(readFileSync(files.path(first.id))).toEqual(Buffer.concat(parts));
  });

  it("stops an upload at the limit and leaves nothing of it", async () => {
    const files = new DrawingFiles(dir, 1_000);
    let given = 0;
    async function* endless(): AsyncGenerator<Uint8Array> {
      for (;;) {
        given += 400;
        yield new Uint8Array(400);
      }
    }
    await expect(files.add(endless())).rejects.toMatchObject({ code: "too-large" });
    expect(given).toBe(1_200);
    expect(readdirSync(join(dir, "drawings"))).toEqual([]);
  });

  it("leaves nothing of an upload that is cut off", async () => {
    const files = new DrawingFiles(dir, 1_000);
    async function* broken(): AsyncGenerator<Uint8Array> {
      yield new Uint8Array(10);
      throw new Error("connection lost");
    }
    await expect(files.add(broken())).rejects.toThrow("connection lost");
    expect(readdirSync(join(dir, "drawings"))).toEqual([]);
  });

  it("moves away what no job needs, and nothing else", async () => {
    const files = new DrawingFiles(dir, 1_000);
    const kept = await files.add([Buffer.from("kept")]);
    const unused = await files.add([Buffer.from("unused")]);
    writeFileSync(join(dir, "drawings", "incoming-1234"), "cut off");
    writeFileSync(join(dir, "drawings", "notes.txt"), "the user's own");
    expect(await files.sweep((id) => id === kept.id)).toBe(1);
    expect(readdirSync(join(dir, "drawings")).sort()).toEqual([`${kept.id}.svg`, "notes.txt"].sort());
    expect(readdirSync(files.unclaimedDir)).toEqual([`${unused.id}.svg`]);
    expect(await files.sweep(() => true)).toBe(0);
    expect(readdirSync(files.unclaimedDir)).toEqual([]);
  });

  it("deletes what no job has needed for 30 days since it was moved away, and nothing else", async () => {
    const files = new DrawingFiles(dir, 1_000);
    const needed = await files.add([Buffer.from("needed again")]);
    const unused = await files.add([Buffer.from("unused")]);
    const uploadedAt = new Date("2020-01-01");
    for (const { id } of [needed, unused]) utimesSync(files.path(id), uploadedAt, uploadedAt);
    await files.sweep(() => false);
    writeFileSync(join(files.unclaimedDir, "notes.txt"), "the user's own");
    const inDays = (days: number): number => Date.now() + days * 86_400_000;
    const [ofNeeded, ofUnused] = [`${needed.id}.svg`, `${unused.id}.svg`];
    await files.sweep(() => false, inDays(29));
    expect(readdirSync(files.unclaimedDir).sort()).toEqual([ofNeeded, ofUnused, "notes.txt"].sort());
    await files.sweep((id) => id === needed.id, inDays(31));
    expect(readdirSync(files.unclaimedDir)).toEqual(["notes.txt"]);
    expect(readdirSync(join(dir, "drawings"))).toEqual([ofNeeded]);
  });
});
