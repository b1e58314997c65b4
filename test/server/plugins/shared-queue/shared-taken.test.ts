/** Jobs that a server has taken from the shared queue: what it does with one that it can't add, and after a restart. */
import { beforeEach, describe, expect, it, onTestFinished } from "vitest";
import type { Planning } from "../../../../host/planning/planning.js";
import { SharedQueue } from "../../../../server/plugins/shared-queue/shared-queue.js";
import { SharedStore } from "../../../../server/plugins/shared-queue/shared-store.js";
import { DrawingFiles } from "../../../../server/storage/drawing-files.js";
import { PlotwrightError, type ErrorCode } from "../../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { folderOfTest } from "../../../support/processes/folders.js";
import { LED_PLANNING, LedPlotter } from "../../../support/jobs/led-plotter.js";
import { openQueueIn, type OpenQueue } from "../../../support/jobs/open-queue.js";
import { SharedDatabase, linesSvg } from "../../../support/servers/shared-servers.js";

interface Server extends OpenQueue {
  readonly shared: SharedQueue;
  readonly notices: string[];
  /** As "fern queued". */
  jobs(): string[];
  close(): Promise<void>;
}

let database: SharedDatabase;
beforeEach(async () => {
  database = await SharedDatabase.open();
  onTestFinished(() => database.close());
});
async function open(
  dir: string,
  { planning, before }: { planning?: Planning; before?: (server: OpenQueue) => void } = {},
): Promise<Server> {
  const opened = openQueueIn(dir, planning && { planning });
  const { queue, store, plotter, logged } = opened;
  before?.(opened);
  const notices: string[] = [];
  const shared = new SharedQueue({
    shared: await SharedStore.open(database.url, () => undefined),
    serverId: dir,
    serverName: dir,
    store,
    queue,
    files: new DrawingFiles(dir, 1_000_000),
    plotters: new Map([[plotter.id, plotter]]),
    log: (line) => logged.push(line),
    notice: (message) => notices.push(message),
    pollMs: 50,
  });
  let isClosed = false;
  const close = async (): Promise<void> => {
    if (isClosed) return;
    isClosed = true;
    await shared.close();
    await queue.close();
    store.close();
  };
  onTestFinished(close);
  const jobs = (): string[] => queue.list().map(({ name, state }) => `${name} ${state}`);
  return { ...opened, shared, notices, jobs, close };
}

async function send({ shared }: Server, name: string): Promise<void> {
  const target = { plotter: new LedPlotter().snapshot().name };
  await shared.send({ name, drawing: linesSvg(1), settings: DEFAULT_PLOT_SETTINGS, target });
}

/** Fails for the first drawing. */
function failingOnce(code: ErrorCode): { readonly planning: Planning; readonly measured: () => number } {
  let count = 0;
  const measure: Planning["measure"] = (...args) =>
    count++ === 0 ? Promise.reject(new PlotwrightError(code, "No.")) : LED_PLANNING.measure(...args);
  return { planning: { ...LED_PLANNING, measure }, measured: () => count };
}

describe("a taken job that the server can't add to its queue", () => {
  it.each(["too-large", "internal"] as const)(
    "is put back after %s: this server continues with the next one, and another server gets it",
    async (code) => {
      const { planning, measured } = failingOnce(code);
      const small = await open(folderOfTest(), { planning });
      await send(small, "fern");
      await expect
        .poll(() => small.notices)
        .toEqual(["A job of the shared queue was put back, because it can't be plotted here now: No."]);
      await send(small, "moss");
      await expect.poll(() => small.jobs()).toEqual(["moss queued"]);
      expect(measured()).toBe(2);
      expect(await small.shared.list()).toMatchObject([
        { name: "moss", state: "stored" },
        { name: "fern", state: "waiting", server: null },
      ]);
      // The pause has passed.
      await database.query("UPDATE pgboss.job SET start_after = now() WHERE state = 'created'");
      const large = await open(folderOfTest());
      await expect.poll(() => large.jobs()).toEqual(["fern queued"]);
    },
  );

  it("is refused for good if the drawing is at fault", async () => {
    const server = await open(folderOfTest(), failingOnce("bad-file"));
    await send(server, "fern");
    await expect
      .poll(() => server.shared.list())
      .toMatchObject([{ name: "fern", state: "refused", message: "No." }]);
    expect(server.notices).toEqual(["A job of the shared queue can't be plotted: No."]);
  });
});

describe("rows of the shared queue that no server can understand", () => {
  const PAYLOADS = ["'no JSON'", "NULL", "'null'", "'[]'", `'{"name":7}'`];
  /** What pg-boss hands out instead of a job's id. */
  const HANDED_OUT = ["'{}'", "'null'", "'7'", `'{"id": 7}'`, `'{"id": "gone"}'`];

  it("are refused or passed over, and the job behind them is taken", { timeout: 180_000 }, async () => {
    const server = await open(folderOfTest());
    server.plotter.connection = "absent";
    for (const [i, data] of HANDED_OUT.entries()) {
      await send(server, `handed ${i}`);
      await database.query(
        `UPDATE pgboss.job SET data = ${data}::jsonb WHERE data->>'id' = (SELECT id FROM plotwright_jobs WHERE name = 'handed ${i}')`,
      );
    }
    for (const [i, payload] of PAYLOADS.entries()) {
      await send(server, `bad ${i}`);
      await database.query(`UPDATE plotwright_jobs SET payload = ${payload} WHERE name = 'bad ${i}'`);
    }
    await send(server, "moss");
    server.plotter.connection = "idle";
    await expect.poll(() => server.jobs(), { timeout: 120_000 }).toEqual(["moss queued"]);
    const bad = (await server.shared.list()).filter(({ name }) => name.startsWith("bad"));
    const message = "It was sent by another version of plotwright.";
    expect(bad.map((job) => [job.state, job.message])).toEqual(PAYLOADS.map(() => ["refused", message]));
  });

  it(
    "taken before a restart do not stop the jobs behind them, nor the list",
    { timeout: 180_000 },
    async () => {
      const dir = folderOfTest();
      const first = await open(dir);
      first.plotter.connection = "absent";
      for (const name of ["fern", "moss", "dreaming", "endless"]) await send(first, name);
      await first.close();
      await database.query(
        `UPDATE plotwright_jobs SET state = 'taken', plotter_id = 'virtual', server_id = '${dir}' WHERE name IN ('fern', 'moss')`,
      );
      await database.query("UPDATE plotwright_jobs SET payload = '{' WHERE name = 'fern'");
      await database.query("UPDATE plotwright_jobs SET state = 'dreaming' WHERE name = 'dreaming'");
      await database.query("UPDATE plotwright_jobs SET created_at = 'infinity' WHERE name = 'endless'");
      const again = await open(dir);
      await expect.poll(() => again.jobs(), { timeout: 120_000 }).toEqual(["moss queued"]);
      await expect
        .poll(() => again.shared.list())
        .toMatchObject([
          { name: "moss", state: "stored" },
          { name: "fern", state: "refused" },
        ]);
    },
  );
});

describe("a taken job that has not started when the server restarts", () => {
  it("starts as soon as the board is there, if the queue runs automatically", async () => {
    const dir = folderOfTest();
    const first = await open(dir);
    await send(first, "fern");
    await expect.poll(() => first.jobs()).toEqual(["fern queued"]);
    await first.close();
    const again = await open(dir, {
      before: ({ queue, plotter }) => {
        queue.saveSettings({ runOn: true });
        plotter.connection = "absent";
      },
    });
    await expect.poll(() => again.shared.list()).toMatchObject([{ state: "stored" }]);
    expect(again.jobs()).toEqual(["fern queued"]);
    again.plotter.connection = "idle";
    await expect.poll(() => again.jobs()).toEqual(["fern plotting"]);
  });
});
