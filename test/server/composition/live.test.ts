/** Live drawings through a whole server: jobs in its queue, whose strokes come while they are drawn. */
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { openPlotter, type PlotterHandle } from "../../../server/plotter/open-plotter.js";
import { createServer, type PlotwrightServer } from "../../../server/index.js";
import type { Line } from "../../../src/index.js";
import { isLiveJob, liveSentSchema, snapshotSchema, type Job } from "../../../src/schema/index.js";
import { folderOfTest } from "../../support/processes/folders.js";

const LIMIT_MS = 60_000;
const wave = (yMm: number, lengthMm: number): Line =>
  Array.from({ length: 2 * lengthMm + 1 }, (_, i) => [20 + i / 2, yMm + 4 * Math.sin(i / 8)]);

let dataDir: string;
let server: PlotwrightServer;
let plotter: PlotterHandle;
beforeEach(async () => {
  dataDir = folderOfTest();
  await start();
});
afterEach(async () => {
  await plotter.close();
  await server.close();
});

async function start(virtualSpeed = 20): Promise<void> {
  server = await createServer({ port: 0, device: "virtual", virtualSpeed, dataDir });
  plotter = await openPlotter({ url: server.url });
}

const plotterId = async (): Promise<string> =>
  snapshotSchema.parse(await (await fetch(`${server.url}/api/v1/state`)).json()).plotters[0].id;
const jobs = async (): Promise<Job[]> =>
  snapshotSchema.parse(await (await fetch(`${server.url}/api/v1/state`)).json()).jobs;
const post = async (path: string, body?: string): Promise<unknown> =>
  (await fetch(`${server.url}/api/v1${path}`, { method: "POST", ...(body && { body }) })).json();
const drawingText = (): string => {
  const [name] = readdirSync(join(dataDir, "drawings"));
  return readFileSync(join(dataDir, "drawings", name), "utf8");
};

describe("a live drawing on a server", () => {
  it(
    "is a job while it lasts, and at the end one in the history that can be plotted again",
    async () => {
      const live = await plotter.live({ name: "Dance" });
      const [job] = await jobs();
      expect(job).toMatchObject({ name: "Dance", state: "plotting", stats: null });
      expect(isLiveJob(job)).toBe(true);
      expect(plotter.state.plot).not.toBeNull();
      await live.stroke(wave(30, 40));
      for (const [x, y] of wave(60, 40)) await live.lineTo(x, y);
      live.penUp();
      await live.stroke([[100, 100]]);
      await live.idle();
      const other = await openPlotter({ url: server.url });
      await expect(other.live()).rejects.toMatchObject({
        code: "busy",
        message: expect.stringMatching(/"Dance" is being plotted/) as string,
      });
      await expect(other.moveTo(10, 10)).rejects.toMatchObject({ code: "busy" });
      await other.close();
      const { plottedS } = await live.end();
      expect(plottedS).toBeGreaterThan(0);
      await expect.poll(async () => (await jobs())[0].stats).toMatchObject({ strokeCount: 3 });
      const [ended] = await jobs();
      expect(ended).toMatchObject({ state: "done", progress: 1 });
      expect(drawingText().match(/<path/g)).toHaveLength(3);
      await post(`/jobs/${job.id}/requeue`);
      await post(`/jobs/${job.id}/start`);
      await expect.poll(async () => (await jobs())[0].state, { timeout: 20_000 }).toBe("done");
    },
    LIMIT_MS,
  );

  it(
    "can be paused, resumed, taken back and cancelled as any job",
    async () => {
      const live = await plotter.live();
      const [{ id }] = await jobs();
      await live.stroke(wave(30, 200));
      await live.stroke(wave(60, 200));
      expect(await live.undo()).toEqual({ takenBack: 401, left: 0 });
      await plotter.pause();
      await expect.poll(async () => (await jobs())[0].state).toBe("paused");
      await expect(post(`/jobs/${id}/check-place`)).resolves.toMatchObject({ error: { code: "conflict" } });
      await plotter.resume();
      await post(`/jobs/${id}/cancel`);
      await expect(live.end()).rejects.toMatchObject({ code: "cancelled" });
      await expect(live.lineTo(1, 1)).rejects.toMatchObject({ code: "cancelled" });
      await expect.poll(async () => (await jobs())[0]).toMatchObject({ state: "cancelled" });
    },
    LIMIT_MS,
  );

  it(
    "waits with its pen up when the program closes the plotter, which then begins nothing more",
    async () => {
      await plotter.close();
      await server.close();
      await start(1);
      const live = await plotter.live();
      await live.stroke(wave(30, 200));
      await plotter.close();
      const words = {
        code: "disconnected",
        message: expect.stringMatching(/closed. Its job waits/) as string,
      };
      await expect(live.lineTo(1, 1)).rejects.toMatchObject(words);
      await expect(live.end()).rejects.toMatchObject(words);
      await expect.poll(async () => (await jobs())[0].state).toBe("paused");
      await expect(plotter.live()).rejects.toMatchObject({ code: "disconnected" });
      expect(await jobs()).toHaveLength(1);
      await post(`/jobs/${(await jobs())[0].id}/cancel`);
      await expect.poll(async () => (await jobs())[0].state).toBe("cancelled");
      plotter = await openPlotter({ url: server.url });
      const begun = plotter.live();
      await plotter.close();
      await expect(begun).rejects.toMatchObject({ code: "disconnected" });
      await expect.poll(async () => (await jobs()).map(({ state }) => state)).toEqual(["done", "cancelled"]);
    },
    LIMIT_MS,
  );

  it(
    "takes as many short strokes at once as there is room for points, and has one end however often it is ended",
    async () => {
      const live = await plotter.live();
      for (let i = 0; i < 2_500; i++) {
        void live.lineTo(20 + (i % 50) / 10, 20 + i / 500);
        live.penUp();
      }
      const ends = await Promise.all([live.end(), live.end()]);
      expect(ends[0]).toBe(ends[1]);
      expect(await live.end()).toBe(ends[0]);
      expect(drawingText().match(/<path/g)).toHaveLength(2_500);
    },
    LIMIT_MS,
  );

  it(
    "takes its lines from the body of a request, and answers when all is drawn",
    async () => {
      const body = "20 20\n21 21\n-5 3\n\n[[30, 30], [40, 40]]\nhello\n50 50";
      const answer = liveSentSchema.parse(
        await post(`/plotters/${await plotterId()}/live?name=Lines&liftAfterMs=100`, body),
      );
      expect(answer.job).toMatchObject({ name: "Lines", state: "done" });
      expect(answer.refused.map(({ line }) => line)).toEqual([3, 6]);
      expect(drawingText()).toContain(
        '<path d="M20 20h0\nL21 21\n"/>\n<path d="M30 30h0\nL40 40\n"/>\n<path d="M50 50h0\n"/>',
      );
    },
    LIMIT_MS,
  );
});
