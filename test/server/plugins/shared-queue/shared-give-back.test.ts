/**
 * Jobs that a server claimed from the shared queue and abandoned: another one can have them, as long as
 * nothing was drawn.
 */
import { describe, expect, it, onTestFinished } from "vitest";
import type { PlotwrightServer } from "../../../../server/index.js";
import { folderOfTest } from "../../../support/processes/folders.js";
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
} from "../../../support/servers/shared-servers.js";

/** Three servers and a database start in turn. */
const LIMIT_MS = 120_000;

describe("a job claimed by a server", { timeout: LIMIT_MS }, () => {
  it("is returned when that server has gone and has not begun it, and is added once", async () => {
    const database = await SharedDatabase.open();
    onTestFinished(() => database.close());
    const open = async (dataDir: string, name: string): Promise<PlotwrightServer> => {
      const server = await database.serve(dataDir);
      onTestFinished(() => server.close());
      await introduce(server, name, MACHINE);
      return server;
    };
    const leftData = folderOfTest();
    const left = await open(leftData, "Left");
    const id = await shareAndTake(left, "fern", { machine: MACHINE });
    const right = await open(folderOfTest(), "Right");
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

    const back = await open(leftData, "Left");
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
