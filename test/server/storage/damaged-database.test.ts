/**
 * A database that is emptied or damaged: no drawing is lost, jobs are restored from the backup, and the user
 * is notified.
 */
import { copyFileSync, existsSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { beforeEach, describe, expect, it } from "vitest";
import { prepareDataDir } from "../../../server/storage/data-dir.js";
import { createServer } from "../../../server/index.js";
import { DrawingFiles } from "../../../server/storage/drawing-files.js";
import { Store } from "../../../server/storage/store.js";
import { PlotwrightError } from "../../../src/index.js";
import { snapshotSchema } from "../../../src/schema/index.js";
import { seeded } from "../../support/plots/live-plot.js";
import { makeJob } from "../../support/jobs/jobs.js";
import { countFor } from "../../support/runs/full-run.js";
import { folderOfTest } from "../../support/processes/folders.js";

const FLIP_COUNT = countFor("PLOTWRIGHT_FLIPS", 120, 40);
const JOB_COUNT = 12;

let dir: string;
beforeEach(() => {
  dir = folderOfTest();
  prepareDataDir(dir);
});

const inDir = (...names: string[]): string => join(dir, ...names);
const databasePath = (): string => inDir("plotwright.db");
const idsOf = (store: Store): string[] => store.jobs().map(({ id }) => id);

/** Jobs with their drawings on disk; the backup of the database has all but the last `sinceCopy` of them. */
async function fill(sinceCopy = 0): Promise<{ ids: string[]; close: () => void }> {
  const files = new DrawingFiles(dir, 1_000);
  const ids = Array.from({ length: JOB_COUNT }, (_, i) => `job-${i}`);
  let store = Store.open(dir);
  for (const [i, id] of ids.entries()) {
    if (i === JOB_COUNT - sinceCopy) {
      store.close();
      store = Store.open(dir);
    }
    store.addJob(makeJob(id), await files.add([Buffer.from(`drawing of ${id}`)]));
    store.saveJournal(id, { place: { stroke: i, alongMm: i } });
    store.saveSetting(`setting ${i}`, { i });
  }
  if (sinceCopy > 0) return { ids, close: () => store.close() };
  store.close();
  Store.open(dir).close();
  return { ids, close: () => undefined };
}

/** The content of every drawing that the server has anywhere. */
function drawings(): string[] {
  return ["drawings", "unclaimed-drawings"]
    .filter((folder) => existsSync(inDir(folder)))
    .flatMap((folder) => readdirSync(inDir(folder)).map((name) => readFileSync(inDir(folder, name), "utf8")))
    .sort();
}

/** As a server starts; null: it refuses, with an explanation. */
async function start(): Promise<Store | null> {
  try {
    const store = Store.open(dir);
    await new DrawingFiles(dir, 1_000).sweep((id) => store.isUsed(id));
    return store;
  } catch (error) {
    expect(error).toBeInstanceOf(PlotwrightError);
    expect((error as PlotwrightError).message).toContain(databasePath());
    return null;
  }
}

describe("a damaged database", () => {
  it("never loses a drawing, whichever byte of it or of its log is wrong", async () => {
    const random = seeded(20261122);
    const { ids, close } = await fill(4);
    // As a killed server leaves it: partly in the log.
    const names = readdirSync(dir).filter((name) => /^plotwright\.db(-wal|\.backup)?$/.test(name));
    expect(names).toHaveLength(3);
    const whole = new Map(names.map((name) => [name, readFileSync(inDir(name))]));
    close();
    const all = drawings();
    expect(all).toHaveLength(JOB_COUNT);
    let repairCount = 0;
    for (let i = 0; i < FLIP_COUNT; i++) {
      for (const name of readdirSync(dir)) if (name.startsWith("plotwright")) rmSync(inDir(name));
      for (const [name, bytes] of whole) writeFileSync(inDir(name), bytes);
      const name = random() < 0.3 ? "plotwright.db-wal" : "plotwright.db";
      const bytes = Buffer.from(whole.get(name)!);
      bytes[Math.floor(random() * bytes.length)] ^= 1 << Math.floor(random() * 8);
      writeFileSync(inDir(name), bytes);
      const store = await start();
      expect(drawings()).toEqual(all);
      if (store === null) continue;
      if (store.opened.repair !== null) {
        repairCount++;
        expect(idsOf(store)).toEqual(ids.slice(0, JOB_COUNT - 4));
      }
      store.close();
    }
    expect(repairCount).toBeGreaterThan(0);
  }, 120_000);

  it("is replaced by its backup and set aside, with a notice; drawings missing from the backup are set aside", async () => {
    const { ids, close } = await fill(2);
    close();
    const bytes = readFileSync(databasePath());
    bytes.fill(0xff, 4_096, 8_192);
    writeFileSync(databasePath(), bytes);
    const store = (await start())!;
    expect(idsOf(store)).toEqual(ids.slice(0, -2));
    expect(store.opened.repair).toMatch(/could not be used: .*It was replaced with the copy from /);
    store.close();
    const kept = readdirSync(dir).find((name) => name.startsWith("plotwright-damaged-"))!;
    expect(readFileSync(inDir(kept))).toEqual(bytes);
    expect(readdirSync(inDir("unclaimed-drawings"))).toHaveLength(2);
    expect(drawings()).toHaveLength(JOB_COUNT);
  });

  it("gets its drawings back when the user restores a good one", async () => {
    const { ids, close } = await fill(2);
    close();
    const good = inDir("good");
    copyFileSync(databasePath(), good);
    writeFileSync(databasePath(), "");
    (await start())!.close();
    copyFileSync(good, databasePath());
    const store = (await start())!;
    expect(idsOf(store)).toEqual(ids);
    store.close();
    expect(readdirSync(inDir("unclaimed-drawings"))).toEqual([]);
    expect(readdirSync(inDir("drawings"))).toHaveLength(JOB_COUNT);
  });

  it("is left unchanged if there is no good backup, and the server says what to do", async () => {
    await fill();
    for (const name of ["plotwright.db", "plotwright.db.backup"]) {
      writeFileSync(inDir(name), Buffer.alloc(20_000, name));
    }
    const before = readFileSync(databasePath());
    for (let tries = 0; tries < 2; tries++) {
      expect(() => Store.open(dir)).toThrow(
        /can't be opened .*its copy .* can't be used either.*start with an empty queue/,
      );
    }
    expect(readFileSync(databasePath())).toEqual(before);
    expect(readdirSync(dir).filter((name) => name.startsWith("plotwright-damaged-"))).toEqual([]);
    expect(drawings()).toHaveLength(JOB_COUNT);
  });
});

describe("an emptied database", () => {
  it.each(["emptied", "missing"])("is restored from its backup (%s)", async (how) => {
    const { ids } = await fill();
    if (how === "emptied") writeFileSync(databasePath(), "");
    else rmSync(databasePath());
    const store = (await start())!;
    expect(idsOf(store)).toEqual(ids);
    expect(store.journal("job-3")).toEqual({ place: { stroke: 3, alongMm: 3 } });
    expect(store.opened.repair).toContain("empty or missing");
    store.close();
    expect(readdirSync(inDir("drawings"))).toHaveLength(JOB_COUNT);
  });

  it("an emptied database without a backup sets all drawings aside", async () => {
    await fill();
    writeFileSync(databasePath(), "");
    rmSync(inDir("plotwright.db.backup"));
    (await start())!.close();
    expect(readdirSync(inDir("unclaimed-drawings"))).toHaveLength(JOB_COUNT);
  });

  it("is reported to the user by the server, once", async () => {
    await fill();
    writeFileSync(databasePath(), "");
    for (const count of [1, 1]) {
      const server = await createServer({ port: 0, device: "virtual", dataDir: dir });
      const answer: unknown = await (await fetch(`${server.url}/api/v1/state`)).json();
      await server.close();
      const { jobs, serverNotices } = snapshotSchema.parse(answer);
      expect(jobs).toHaveLength(JOB_COUNT);
      expect(serverNotices.map(({ message }) => message)).toEqual(
        Array.from(
          { length: count },
          () => expect.stringContaining("Check the queue before you plot") as string,
        ),
      );
    }
  });
});
