/** A live drawing on a page without a server: its strokes go to the page's own host, in a worker. */
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { launchBrowser, PLAIN } from "../../support/browser/browser.js";
import { startStaticApp, type StaticApp } from "../../support/browser/static-app.js";
import { liveReportSchema, type Job, type LiveMessage } from "../../../src/schema/index.js";

let browser: Browser;
let app: StaticApp;
beforeAll(async () => {
  browser = await launchBrowser();
  app = await startStaticApp();
});
afterAll(async () => {
  await browser.close();
  await app.close();
});

/** Sends messages as the page with the host does, one after the report that it waits for, and returns the reports. */
const drawn = (page: Page, steps: readonly { readonly after: string; readonly send: LiveMessage[] }[]) =>
  page.evaluate(async (parts) => {
    const channel = new BroadcastChannel("plotwright-3");
    const hello = (): void => channel.postMessage({ to: "host", type: "hello", tab: "test" });
    const reports: unknown[] = [];
    let jobs: unknown[] = [];
    const waiting = [...parts];
    await new Promise<void>((resolve) => {
      let base: object | null = null;
      channel.onmessage = ({ data }) => {
        if (data.type === "event" && data.event.type === "snapshot") {
          jobs = data.event.snapshot.jobs;
          base ??= {
            to: "host",
            type: "live",
            tab: data.host,
            id: 900,
            plotterId: data.event.snapshot.plotters[0].id,
          };
          if (reports.length === 0) channel.postMessage({ ...base, message: { begin: { name: "By hand" } } });
          else resolve();
        }
        if (data.type !== "live") return;
        const { report } = data;
        reports.push(report);
        if (report.type === "ended" || report.type === "error") setTimeout(hello, 3_000);
        const [next] = waiting;
        if (next === undefined || !JSON.stringify(report).includes(next.after)) return;
        waiting.shift();
        for (const message of next.send) channel.postMessage({ ...base, message });
      };
      hello();
    });
    channel.close();
    return { reports, jobs };
  }, steps);

it("is drawn by the page's own host, as a job that can be plotted again", async () => {
  const context = await browser.newContext(PLAIN);
  const page = await context.newPage();
  page.on("dialog", (dialog) => void dialog.accept());
  await page.goto(`${app.url}/?virtual-speed=20`);
  const { reports, jobs } = await drawn(page, [
    {
      after: '"begun"',
      send: [
        {
          stroke: [
            [20, 20],
            [60, 20],
          ],
        },
        { lineTo: [20, 40] },
        { lineTo: [50, 45] },
      ],
    },
    {
      after: '"waiting"',
      // The pen is busy for 70 s of the board's time, so the last stroke is not begun when it is taken back.
      send: [
        { stroke: Array.from({ length: 20 }, (_, i): [number, number] => [i % 2 === 0 ? 20 : 200, 60 + i]) },
        {
          stroke: [
            [20, 90],
            [200, 90],
          ],
        },
        { undo: true },
        { end: true },
      ],
    },
  ]);
  const all = reports.map((report) => liveReportSchema.parse(report));
  expect(all[0].type).toBe("begun");
  expect(all.find(({ type }) => type === "undone")).toMatchObject({ takenBack: 2, left: 0 });
  expect(all.at(-1)).toMatchObject({ type: "ended", job: { name: "By hand", state: "done" } });
  const [job] = jobs as Job[];
  expect(job).toMatchObject({ state: "done", stats: { strokeCount: 3 } });
  await context.close();
}, 120_000);
