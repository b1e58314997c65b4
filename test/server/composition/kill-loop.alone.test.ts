/**
 * The real server process, killed without warning many times while jobs are added, moved, removed and plotted
 * over HTTP. What it has answered holds after every restart: no job is lost or doubled, and the order stays.
 *
 * 100 times in the full run; PLOTWRIGHT_KILLS=20 sets the count.
 */
import { once } from "node:events";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ENDED_STATES, jobSchema, snapshotSchema, type Job } from "../../../src/schema/index.js";
import { temporaryFolder } from "../../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../../support/processes/server-process.js";
import { countFor } from "../../support/runs/full-run.js";

const KILL_COUNT = countFor("PLOTWRIGHT_KILLS", 100, 3);
const SEED = Number(process.env["PLOTWRIGHT_SEED"] ?? "20261121");

const lines = (count: number): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60" stroke="black">${Array.from(
    { length: count },
    (_, i) => `<path d="M5 ${2 + i / 4}h50"/>`,
  ).join("")}</svg>`;
const SHORT = lines(2);
const LONG = lines(200);

/** One request to the server, and its effect on the order of all jobs ever accepted. */
interface Action {
  readonly method: string;
  readonly path: string;
  readonly body?: string;
  readonly isJson?: boolean;
  /** `answer`: the body of a 2xx answer; null if the server was killed before it could answer. */
  readonly becomes: (order: readonly string[], answer: Job | null) => readonly string[];
}

class Client {
  /** Ids in queue order, including those that have ended since. */
  order: readonly string[] = [];
  /** The alternative order, if the request in progress took effect when the server was killed. */
  maybe: readonly string[] | null = null;
  /** Its name may be there once, with an unknown id. */
  maybeName: string | null = null;
  readonly removed = new Set<string>();
  maybeRemoved: string | null = null;
  readonly done = new Map<string, number | null>();
  private readonly random: () => number;
  private nameCount = 0;
  url = "";

  constructor(seed: number) {
    let state = seed;
    this.random = () => {
      state = (Math.imul(state, 1_664_525) + 1_013_904_223) >>> 0;
      return state / 2 ** 32;
    };
  }

  below(count: number): number {
    return Math.floor(this.random() * count);
  }

  async state(): Promise<Job[]> {
    return snapshotSchema.parse(await (await fetch(`${this.url}/api/v1/state`)).json()).jobs;
  }

  /** Waits, with a limit, until nothing is plotting. */
  async plotted(): Promise<void> {
    for (let look = 0; look < 50; look++) {
      if (!(await this.state()).some(({ state }) => state === "plotting")) return;
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
  }

  /** An action that a user may do in the current state of the jobs. */
  choose(jobs: readonly Job[]): Action {
    const queued = jobs.filter(({ state }) => state === "queued");
    const any = queued[this.below(queued.length)];
    const broken = jobs.find(({ state }) => state === "interrupted");
    const held = jobs.find(({ state }) => state === "paused");
    const choice = this.below(10);
    if (held !== undefined) return this.simple(held.id, "resume");
    if (broken !== undefined && choice < 9) return this.simple(broken.id, "recover");
    if (any === undefined || (choice < 4 && queued.length < 8)) return this.add();
    if (choice === 4) return this.remove(any.id);
    if (choice < 7) return this.simple(any.id, "start");
    return this.move(any.id, this.below(3) === 0 ? null : (queued[this.below(queued.length)]?.id ?? null));
  }

  /** Returns false if the server ended before it answered: then both orders are possible. */
  async carryOut({ method, path, body, isJson, becomes }: Action): Promise<boolean> {
    const name = method === "POST" && body !== undefined && isJson !== true ? this.lastName() : null;
    const removed = method === "DELETE" ? path.replace("/jobs/", "") : null;
    try {
      const response = await fetch(`${this.url}/api/v1${path}`, {
        method,
        ...(body === undefined ? {} : { body }),
        ...(isJson === true ? { headers: { "Content-Type": "application/json" } } : {}),
      });
      const answer: unknown = await response.json();
      const job = jobSchema.safeParse(answer);
      if (response.ok) this.order = becomes(this.order, job.success ? job.data : null);
      if (response.ok && removed !== null) this.removed.add(removed);
      expect([path, [200, 201, 404, 409, 503].includes(response.status)]).toEqual([path, true]);
      return true;
    } catch (error) {
      if (!(error instanceof TypeError || (error as Error).name === "SyntaxError")) throw error;
      this.maybe = becomes(this.order, null);
      this.maybeName = name;
      this.maybeRemoved = removed;
      return false;
    }
  }

  /** Plots one job to its end, whatever happened to it before. */
  async finishOne(): Promise<void> {
    for (let tries = 0; tries < 100 && this.done.size === 0; tries++) {
      const jobs = await this.state();
      const job = jobs.find(({ state }) => !ENDED_STATES.includes(state));
      const next = { interrupted: "recover", paused: "resume", queued: "start" } as const;
      if (job === undefined) await this.carryOut(this.add());
      else if (job.state in next)
        await this.carryOut(this.simple(job.id, next[job.state as keyof typeof next]));
      await this.plotted();
      this.check(await this.state());
    }
  }

  /** Compares the server's jobs after its restart, and continues from there. */
  check(jobs: readonly Job[]): void {
    const known = new Set(this.order);
    const strangers = jobs.filter(({ id }) => !known.has(id));
    expect(strangers.map(({ name }) => name)).toEqual(strangers.length === 0 ? [] : [this.maybeName]);
    expect(new Set(jobs.map(({ id }) => id)).size).toBe(jobs.length);
    expect(new Set(jobs.map(({ name }) => name)).size).toBe(jobs.length);
    const found = new Set(jobs.map(({ id }) => id));
    const missing = this.order.filter((id) => !found.has(id) && !this.removed.has(id));
    expect(missing.filter((id) => id !== this.maybeRemoved)).toEqual([]);
    expect([...this.removed].filter((id) => found.has(id))).toEqual([]);

    const live = jobs.filter(({ state }) => !ENDED_STATES.includes(state)).map(({ id }) => id);
    const old = live.filter((id) => known.has(id));
    const fits = [this.order, this.maybe ?? this.order].map((order) =>
      order.filter((id) => live.includes(id)),
    );
    expect(fits).toContainEqual(old);
    // One that was added without an answer is last.
    if (strangers.length > 0) expect(live.slice(-1)).toEqual([strangers[0]?.id]);

    for (const { id, plottedS } of jobs.filter(({ state }) => state === "done")) {
      if (!this.done.has(id)) this.done.set(id, plottedS);
    }
    const states = new Map(jobs.map(({ id, state, plottedS }) => [id, `${state} ${plottedS}`]));
    const kept = [...this.done].filter(([id]) => !this.removed.has(id) && id !== this.maybeRemoved);
    expect(kept.map(([id]) => states.get(id))).toEqual(kept.map(([, plottedS]) => `done ${plottedS}`));

    for (const id of missing) this.removed.add(id);
    const ended = this.order.filter((id) => !live.includes(id));
    this.order = [...ended, ...live];
    [this.maybe, this.maybeName, this.maybeRemoved] = [null, null, null];
  }

  private lastName = (): string => `job ${this.nameCount}`;

  private add(): Action {
    this.nameCount++;
    return {
      method: "POST",
      path: `/jobs?name=${encodeURIComponent(this.lastName())}`,
      body: this.below(3) === 0 ? LONG : SHORT,
      becomes: (order, answer) => (answer === null ? order : [...order, answer.id]),
    };
  }

  private simple(id: string, name: string): Action {
    return { method: "POST", path: `/jobs/${id}/${name}`, becomes: (order) => order };
  }

  private remove(id: string): Action {
    return { method: "DELETE", path: `/jobs/${id}`, becomes: (order) => order };
  }

  private move(id: string, beforeId: string | null): Action {
    return {
      method: "POST",
      path: `/jobs/${id}/move`,
      body: JSON.stringify({ beforeId: beforeId === id ? null : beforeId }),
      isJson: true,
      becomes: (order) => {
        const others = order.filter((one) => one !== id);
        const at = beforeId === null || beforeId === id ? others.length : others.indexOf(beforeId);
        return [...others.slice(0, at), id, ...others.slice(at)];
      },
    };
  }
}

describe("a server that is killed without warning", () => {
  const folder = temporaryFolder("kills");
  let server: ServerProcess;
  const start = async (client: Client): Promise<void> => {
    server = await startServerProcess({ dataDir: folder.path, virtualSpeed: 200 });
    client.url = server.url;
  };
  const client = new Client(SEED);
  beforeAll(async () => {
    await start(client);
    const body = JSON.stringify({ runOn: true });
    const headers = { "Content-Type": "application/json" };
    await fetch(`${client.url}/api/v1/queue`, { method: "PATCH", body, headers });
  });
  afterAll(async () => {
    await server.stop();
    folder.remove();
  });

  it(
    `loses no job, doubles none and keeps their order, ${KILL_COUNT} times`,
    async () => {
      let cutOffCount = 0;
      const isEnough = (): boolean => cutOffCount > KILL_COUNT / 10;
      // Whether a kill meets a request in progress is random: a few more if there were too few.
      for (let kill = 0; kill < KILL_COUNT || (kill < 4 * KILL_COUNT && !isEnough()); kill++) {
        for (let step = client.below(7); step > 0; step--) {
          expect(await client.carryOut(client.choose(await client.state()))).toBe(true);
        }
        // Every other time the running plot gets time to end.
        if (kill % 2 === 0) await client.plotted();
        // The last request is in progress when the server is killed, at its beginning or in the middle.
        const last = client.carryOut(client.choose(await client.state()));
        await new Promise((resolve) =>
          setTimeout(resolve, client.below(4) === 0 ? client.below(150) : client.below(12)),
        );
        const gone = once(server.process, "exit");
        server.process.kill("SIGKILL");
        await gone;
        if (!(await last)) cutOffCount++;
        await start(client);
        client.check(await client.state());
      }
      // By chance the kills may have left no plot the time to end.
      await client.finishOne();
      console.info(
        `${KILL_COUNT} kills, ${cutOffCount} within a request; ${client.order.length} jobs taken, ${client.done.size} plotted to the end`,
      );
      expect(isEnough()).toBe(true);
      expect(client.done.size).toBeGreaterThan(0);
    },
    Math.max(120_000, KILL_COUNT * 30_000),
  );
});
