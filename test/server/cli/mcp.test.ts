/** The tools of `plotwright mcp`, as an assistant uses them, at a server with a scripted plotter. */
import { Client } from "@modelcontextprotocol/sdk/client/index.js";
import { InMemoryTransport } from "@modelcontextprotocol/sdk/inMemory.js";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { inflateSync } from "node:zlib";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { mcpServer } from "../../../server/cli/mcp/tools.js";
import { pictureOf } from "../../../server/cli/mcp/picture.js";
import type { Role } from "../../../src/schema/index.js";
import { startApp, type TestApp } from "../../support/servers/app.js";

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 100 50" fill="none" stroke="#d01020"><path d="M10 10H90"/></svg>`;
const PAPER = { prepare: { paper: { widthMm: 50, heightMm: 100 }, marginMm: 0 } };

interface Answer {
  readonly isError?: boolean;
  readonly content: readonly { readonly type: string; readonly text?: string; readonly data?: string }[];
}

let app: TestApp;
let folder: string;
let assistant: Client;

/** Connects an assistant with a key of that role. */
async function connect(role: Role, url = app.url): Promise<void> {
  const { secret } = app.access.createKey("assistant", role);
  const [mine, its] = InMemoryTransport.createLinkedPair();
  await mcpServer(() => ({ url, key: secret }), "1.2.3").connect(its);
  assistant = new Client({ name: "test", version: "1" });
  await assistant.connect(mine);
}

const call = async (name: string, args: Record<string, unknown> = {}): Promise<Answer> =>
  (await assistant.callTool({ name, arguments: args })) as unknown as Answer;

/** The result as an object. */
async function result(name: string, args?: Record<string, unknown>): Promise<Record<string, unknown>> {
  const { isError, content } = await call(name, args);
  const text = content.find(({ type }) => type === "text")?.text ?? "";
  expect([isError ?? false, isError ? text : ""]).toEqual([false, ""]);
  return JSON.parse(text) as Record<string, unknown>;
}

async function refusal(name: string, args?: Record<string, unknown>): Promise<string> {
  const { isError, content } = await call(name, args);
  expect(isError).toBe(true);
  return content[0].text ?? "";
}

beforeEach(async () => {
  app = await startApp({ trustsLoopback: false });
  folder = mkdtempSync(join(tmpdir(), "plotwright-mcp-test-"));
});
afterEach(async () => {
  await assistant.close();
  await app.close();
  rmSync(folder, { recursive: true, force: true });
});

describe("an assistant", () => {
  it("finds tools with descriptions, and learns which only read", async () => {
    await connect("watch");
    const { tools } = await assistant.listTools();
    expect(tools.map(({ name }) => name).sort()).toEqual(
      ["cancel", "pause", "plan", "preview", "queue", "resume", "start", "state"].sort(),
    );
    expect(tools.every(({ description = "" }) => description.length > 20)).toBe(true);
    const reading = tools.filter(({ annotations }) => annotations?.readOnlyHint);
    expect(reading.map(({ name }) => name).sort()).toEqual(["plan", "preview", "state"]);
  });

  it("plans a drawing given as text or as a file, with the settings laid over the plotter's", async () => {
    await connect("watch");
    const file = join(folder, "line.svg");
    writeFileSync(file, SVG);
    for (const drawing of [{ text: SVG }, { file }]) {
      const plan = await result("plan", { ...drawing, settings: PAPER });
      expect(plan).toMatchObject({ strokes: 1, drawMm: 80, paper: { widthMm: 100, heightMm: 50 } });
    }
    const slow = await result("plan", { text: SVG, settings: { motion: { draw: { speedMmPerS: 5 } } } });
    expect(slow["durationS"]).toBeGreaterThan(16);
  });

  it("sees the drawing as it will be on the paper", async () => {
    await connect("watch");
    const { content } = await call("preview", { text: SVG, settings: PAPER });
    expect(content.map(({ type }) => type)).toEqual(["image", "text"]);
    const { widthPx, heightPx, pixel } = decoded(Buffer.from(content[0].data ?? "", "base64"));
    expect([widthPx, heightPx]).toEqual([1200, 600]);
    expect(pixel(600, 120)).toEqual([0xd0, 0x10, 0x20]);
    expect(pixel(100, 120)).toEqual([255, 255, 255]);
    expect(pixel(600, 300)).toEqual([255, 255, 255]);
  });

  it("plans without a server, and says which server is missing where it needs one", async () => {
    await connect("watch", "http://127.0.0.1:9");
    expect(await result("plan", { text: SVG })).toMatchObject({ drawMm: 80 });
    expect(await refusal("state")).toContain("No plotwright server answers at http://127.0.0.1:9");
    expect(await refusal("plan", { text: SVG, plotter: "Studio" })).toContain("No plotwright server");
  });

  it("queues a drawing, starts, pauses, resumes and cancels it", async () => {
    await connect("operate");
    const { id } = await result("queue", { text: SVG, name: "line.svg", settings: { pen: { downPct: 21 } } });
    expect(app.queue.get(String(id))).toMatchObject({ name: "line.svg", settings: { pen: { downPct: 21 } } });
    expect(await result("state")).toMatchObject({ jobs: [{ id, state: "queued", name: "line.svg" }] });
    await result("start", { id });
    const run = await app.plotter.nextRun();
    await result("pause", { id });
    await result("resume", { id });
    await result("cancel", { id });
    expect(run.asked.filter((one) => ["pause", "resume", "cancel"].includes(one))).toEqual([
      "pause",
      "resume",
      "cancel",
    ]);
    await expect
      .poll(async () => await result("state"))
      .toMatchObject({ jobs: [{ id, state: "cancelled" }] });
  });

  it("adds copies for the plotter that it names", async () => {
    await connect("operate");
    const [{ id: plotterId }] = (await result("state"))["plotters"] as { id: string }[];
    await result("queue", { text: SVG, copies: 3, plotter: plotterId });
    expect((await result("state"))["jobs"]).toHaveLength(3);
    expect(await refusal("queue", { text: SVG, plotter: "Nowhere" })).toContain("no plotter Nowhere");
  });

  it("may do what the role of its key allows, and no more", async () => {
    await connect("watch");
    expect(await refusal("queue", { text: SVG })).toContain("may only watch");
    await assistant.close();
    await connect("submit");
    const { id } = await result("queue", { text: SVG });
    expect(await refusal("start", { id })).toMatch(/may only add|refused/);
  });

  it.each([
    ["neither file nor text", {}, "either"],
    ["both", { text: SVG, file: "a.svg" }, "either"],
    ["a file that does not exist", { file: "/nowhere/a.svg" }, "can't be read"],
    ["a misspelt setting", { text: SVG, settings: { pen: { downPc: 3 } } }, "downPct"],
  ])("is told what is wrong with %s", async (_what, args, words) => {
    await connect("operate");
    expect(await refusal("plan", args)).toContain(words);
    expect(await refusal("queue", args)).toContain(words);
  });

  it("is told that a text is no drawing", async () => {
    await connect("operate");
    expect(await refusal("plan", { text: "hello" })).toMatch(/not a|no SVG|drawing/);
  });
});

describe("the picture", () => {
  const paper = { format: "plotwright-strokes", version: 1, widthMm: 10, heightMm: 10 } as const;

  it("has a dot for a stroke of one point, cuts what leaves the paper, and has ink without a colour", () => {
    const strokesMm = [
      [5, 5],
      [-100, 2, 100, 2],
    ];
    const { pixel } = decoded(
      pictureOf({ ...paper, layers: [{ id: "1", name: "", color: null, strokesMm }] }),
    );
    expect(pixel(600, 600)[0]).toBeLessThan(100);
    expect(pixel(0, 240)[0]).toBeLessThan(100);
    expect(pixel(1199, 240)[0]).toBeLessThan(100);
    expect(pixel(300, 900)).toEqual([255, 255, 255]);
  });
});

/** Reads an unfiltered PNG of 8 bits for each colour. */
function decoded(png: Buffer) {
  expect(png.subarray(1, 4).toString()).toBe("PNG");
  const widthPx = png.readUInt32BE(16);
  const heightPx = png.readUInt32BE(20);
  const at = png.indexOf("IDAT");
  const rows = inflateSync(png.subarray(at + 4, at + 4 + png.readUInt32BE(at - 4)));
  const pixel = (x: number, y: number): number[] => {
    const from = y * (3 * widthPx + 1) + 1 + 3 * x;
    return [...rows.subarray(from, from + 3)];
  };
  return { widthPx, heightPx, pixel };
}
