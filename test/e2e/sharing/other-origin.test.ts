/** A sketch of another origin that plots with a key: the code of docs/p5.md, in a real browser against a real server. */
import { readFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import path from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ROOT } from "../../../scripts/setup.mjs";
import { snapshotSchema, type Job, type Role, type Snapshot } from "../../../src/schema/index.js";
import { launchBrowser, PLAIN } from "../../support/browser/browser.js";
import { temporaryFolder } from "../../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../../support/processes/server-process.js";

/** The sketch in docs/p5.md, as it stands there. */
const SKETCH =
  /^```js no-run\n(const SERVER = [\s\S]*?)^```/m.exec(
    readFileSync(path.join(ROOT, "docs/p5.md"), "utf8"),
  )?.[1] ?? "";

/** What p5.js does for a sketch in global mode, as far as this one needs it. */
const P5 = `
  let pen, key;
  function createCanvas(width, height) {
    const canvas = document.body.appendChild(Object.assign(document.createElement("canvas"), { width, height }));
    pen = canvas.getContext("2d");
  }
  function line(x1, y1, x2, y2) {
    pen.beginPath(); pen.moveTo(x1, y1); pen.lineTo(x2, y2); pen.stroke();
  }
  addEventListener("load", () => { setup(); draw(); document.title = "drawn"; });
  addEventListener("keydown", (event) => {
    key = event.key;
    keyPressed().then(() => (document.title = "done " + key), (error) => (document.title = error.message));
  });`;

const data = temporaryFolder("other-origin");
let browser: Browser;
let sites: Server;
let server: ServerProcess;
/** The page is at localhost, the server at 127.0.0.1: two sites. */
let port: number;

beforeAll(async () => {
  sites = createServer((request, response) => {
    const { searchParams } = new URL(request.url ?? "/", "http://localhost");
    const sketch = SKETCH.replace("http://127.0.0.1:9080", server.url).replace(
      '"KEY"',
      JSON.stringify(searchParams.get("key") ?? ""),
    );
    response.setHeader("Content-Type", "text/html; charset=utf-8");
    response.end(`<!doctype html><body><script>${P5}</script><script>${sketch}</script>`);
  });
  await new Promise<void>((resolve) => sites.listen(0, "127.0.0.1", resolve));
  ({ port } = sites.address() as AddressInfo);
  server = await startServerProcess({
    dataDir: data.path,
    virtualSpeed: 20,
    args: ["--allow-origin", `http://localhost:${port}`],
  });
  browser = await launchBrowser();
});

afterAll(async () => {
  await browser.close();
  await server.stop();
  sites.close();
  data.remove();
});

async function keyOf(role: Role): Promise<string> {
  const answer = await fetch(`${server.url}/api/v1/access/keys`, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ name: "sketch", role }),
  });
  return ((await answer.json()) as { secret: string }).secret;
}
const stateOf = async (): Promise<Snapshot> =>
  snapshotSchema.parse(await (await fetch(`${server.url}/api/v1/state`)).json());
const newest = async (): Promise<Job | undefined> => (await stateOf()).jobs[0];

async function openSketch(origin: string, key: string): Promise<Page> {
  const page = await (await browser.newContext(PLAIN)).newPage();
  await page.goto(`${origin}/?key=${key}`);
  await titled(page, /^drawn$/);
  return page;
}
const titled = (page: Page, title: RegExp): Promise<void> => expect.poll(() => page.title()).toMatch(title);

describe("a sketch on another site", () => {
  it("plots with a key when its origin is allowed, and stops the plot", async () => {
    const page = await openSketch(`http://localhost:${port}`, await keyOf("operate"));
    await page.keyboard.press("p");
    await titled(page, /^done p$/);
    await expect.poll(async () => (await newest())?.state).toBe("plotting");
    await page.keyboard.press("s");
    await titled(page, /^done s$/);
    await expect.poll(async () => (await newest())?.state).toBe("paused");
    const { id, name, stats, settings } = (await newest()) as Job;
    expect([name, stats?.strokeCount, settings.prepare.paper.widthMm]).toEqual(["rings.json", 6, 148]);
    // Rings of 10 … 60 mm at true size, the outermost within the paper.
    expect(stats?.size.widthMm).toBeCloseTo(120, 0);
    await fetch(`${server.url}/api/v1/jobs/${id}/resume`, { method: "POST" });
    await expect.poll(async () => (await newest())?.state, { timeout: 60_000 }).toBe("done");
    await page.context().close();
  }, 120_000);

  it("learns in words why it may not: without a key, and with one that may only submit", async () => {
    const before = (await stateOf()).jobs.length;
    const without = await openSketch(`http://localhost:${port}`, "");
    await without.keyboard.press("p");
    await titled(without, /access key is not valid|needs an access key/);
    expect((await stateOf()).jobs).toHaveLength(before);
    const submits = await openSketch(`http://localhost:${port}`, await keyOf("submit"));
    await submits.keyboard.press("p");
    await titled(submits, /may only add drawings to the queue/);
    expect((await stateOf()).jobs).toHaveLength(before + 1);
    for (const page of [without, submits]) await page.context().close();
  }, 120_000);

  it("reaches nothing from another origin, even with the key of one that is allowed", async () => {
    const before = (await stateOf()).jobs.length;
    const page = await openSketch(`http://127.0.0.1:${port}`, await keyOf("operate"));
    await page.keyboard.press("p");
    await titled(page, /failed to fetch/i);
    // Nor without reading the answer, as a form of any page can send.
    await page.evaluate(async (address) => {
      const init = { method: "POST", mode: "no-cors", body: "<svg/>", credentials: "include" } as const;
      await fetch(`${address}/api/v1/jobs?name=evil`, init).catch(() => undefined);
    }, server.url);
    expect(server.output()).toContain(`Pages of http://127.0.0.1:${port} may not use this server.`);
    expect((await stateOf()).jobs).toHaveLength(before);
    expect(server.output()).toContain(`--allow-origin http://127.0.0.1:${port}`);
    await page.context().close();
  }, 120_000);
});
