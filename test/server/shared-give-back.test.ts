/**
 * Jobs that a server claimed from the shared queue and abandoned: another one can have them, as long as
 * nothing was drawn.
 */
import { afterEach, describe, expect, it } from "vitest";
import type { PlotwrightServer } from "../../server/index.js";
import { temporaryFolder } from "../support/folders.js";
import {
  MACHINE,
  SharedDatabase,
  introduce,
  jobsOf,
  noticesOf,
  send,
  shareAndTake,
  sharedOf,
  startOf,
  stateOf,
} from "./support/shared-servers.js";

const undo: (() => unknown)[] = [];
afterEach(async () => {
  for (const step of undo.splice(0).reverse()) await step();
});

/** Three servers and a database start in turn. */
const LIMIT_MS = 120_000;

describe("a job claimed by a server", { timeout: LIMIT_MS }, () => {
  it("is returned when that server has gone and has not begun it, and is added once", async () => {
    const database = await SharedDatabase.open();
    undo.push(() => database.close());
    const open = async (dataDir: string, name: string): Promise<PlotwrightServer> => {
      const server = await database.serve(dataDir);
      undo.push(() => server.close());
      await introduce(server, name, MACHINE);
      return server;
    };
    const [leftData, rightData] = [temporaryFolder("give-left"), temporaryFolder("give-right")];
    undo.push(leftData.remove, rightData.remove);

    const left = await open(leftData.path, "Left");
    const id = await shareAndTake(left, "fern", { machine: MACHINE });
    const right = await open(rightData.path, "Right");
    const giveBack = (): Promise<Response> => send(right.url, "POST", `/shared-jobs/${id}/give-back`);
    const refused = await giveBack();
    expect([refused.status, await refused.text()]).toEqual([
      409,
      expect.stringContaining("is running and will plot"),
    ]);

    await left.close();
    expect((await giveBack()).status).toBe(409);
    await database.age("fern");
    await expect
      .poll(() => noticesOf(right))
      .toEqual([expect.stringMatching(/^"fern" was taken by .*, which can't be reached/)]);
    expect((await giveBack()).status).toBe(200);
    await expect.poll(() => jobsOf(right)).toEqual(["fern queued"]);

    const back = await open(leftData.path, "Left");
    await expect.poll(() => jobsOf(back)).toEqual([]);
    expect(await noticesOf(back)).toEqual(['"fern" was given to another server while this one was away.']);

    const { jobs } = await stateOf(right);
    await expect.poll(() => startOf(right, jobs[0].id)).toBe("200");
    await expect.poll(() => jobsOf(right)).toEqual(["fern done"]);
    await expect.poll(() => sharedOf(back, "fern")).toMatchObject({ state: "stored", hasBegun: true });
    await right.close();
    const tooLate = await send(back.url, "POST", `/shared-jobs/${id}/give-back`);
    expect([tooLate.status, await tooLate.text()]).toEqual([409, expect.stringContaining("has begun")]);
  });
});
