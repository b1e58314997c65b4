/** Moves by hand and custom machines, over HTTP: the whole server on the virtual board. */
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { createServer, type PlotwrightServer } from "../../../server/index.js";
import { machineById } from "../../../src/index.js";
import {
  apiErrorSchema,
  commandAnswerSchema,
  DEFAULT_PLOT_SETTINGS,
  jobSchema,
  machineListSchema,
  plotterSchema,
  snapshotSchema,
  type Job,
  type Plotter,
} from "../../../src/schema/index.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100" stroke="black"><path d="M10 20H90M10 40H90M10 60H90"/></svg>`;
/** Long enough that it still plots when all requests of a test have been answered. */
const LONG = SVG.replace(
  / d="[^"]*"/,
  ` d="${Array.from({ length: 400 }, (_, i) => `M10 ${10 + i / 5}H90`).join("")}"`,
);
const MINE = { ...machineById("axidraw-v3"), id: "mine", name: "Mine", widthMm: 600, stepsPerMm: 100 };

let dataDir: string;
let server: PlotwrightServer;
const logged: string[] = [];
const start = async (): Promise<void> => {
  server = await createServer({
    port: 0,
    device: "virtual",
    virtualSpeed: 50,
    dataDir,
    log: (line) => logged.push(line),
  });
};
beforeEach(async () => {
  dataDir = folderOfTest();
  await start();
});
afterEach(async () => {
  await server.close();
});

const call = (method: string, path: string, body?: unknown): Promise<Response> =>
  fetch(`${server.url}/api/v1${path}`, {
    method,
    ...(body === undefined
      ? {}
      : { headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) }),
  });
const move = async (name: string, body?: unknown): Promise<Plotter> => {
  const response = await call("POST", `/plotters/main/${name}`, body);
  expect([name, response.status, response.ok ? "" : await response.clone().text()]).toEqual([name, 200, ""]);
  return plotterSchema.parse(await response.json());
};
const fault = async (response: Response): Promise<{ status: number; code: string; message: string }> => ({
  status: response.status,
  ...apiErrorSchema.parse(await response.json()).error,
});
const addJob = async (settings: unknown = DEFAULT_PLOT_SETTINGS, drawing = SVG): Promise<Job> =>
  jobSchema.parse(await (await call("POST", "/jobs", { name: "lines", drawing, settings })).json());

describe("moves by hand over HTTP", () => {
  it("end exactly where requested", async () => {
    expect(await move("move-to", { xMm: 40, yMm: 30 })).toMatchObject({ xMm: 40, yMm: 30, penUp: true });
    expect(await move("jog", { dxMm: -10.5, dyMm: 5 })).toMatchObject({ xMm: 29.5, yMm: 35 });
    expect(await move("frame", { boxMm: { xMm: 5, yMm: 5, widthMm: 50, heightMm: 20 } })).toMatchObject({
      xMm: 29.5,
      yMm: 35,
    });
    expect(await move("test-patch")).toMatchObject({ xMm: 29.5, yMm: 35, penUp: true });
    expect(await move("square", { sizeMm: 20 })).toMatchObject({ xMm: 29.5, yMm: 35, penUp: true });
    expect(await move("cycle-pen")).toMatchObject({ penUp: true });
    expect(await move("servo", { pos: 12_000 })).toMatchObject({ penUp: null });
    expect(await move("set-home")).toMatchObject({ xMm: 0, yMm: 0 });
    expect(await move("home")).toMatchObject({ xMm: 0, yMm: 0, penUp: true });
  });

  it("go around a job's drawing where its settings place it", async () => {
    const { id, settings } = await addJob();
    const { motion } = settings;
    await move("frame", { jobId: id, settings: { ...settings, motion } });
    const log = await (await call("GET", "/plotters/main/log")).text();
    // The pen was never lowered, and the carriage is back.
    expect(log).not.toMatch(/> SP,0/);
    expect(await move("home")).toMatchObject({ xMm: 0, yMm: 0 });
    expect(await fault(await call("POST", "/plotters/main/frame", { jobId: "none" }))).toMatchObject({
      status: 404,
    });
  });

  it("stay within the plotter's machine", async () => {
    const far = { xMm: 500, yMm: 10 };
    expect(await fault(await call("POST", "/plotters/main/move-to", far))).toMatchObject({
      status: 422,
      code: "out-of-bounds",
    });
    const settings = { machine: "mine", customMachine: MINE };
    // Settings do not change the plotter's machine.
    expect(await fault(await call("POST", "/plotters/main/move-to", { ...far, settings }))).toMatchObject({
      status: 422,
    });
    await call("PUT", "/machines/mine", MINE);
    expect((await call("PATCH", "/plotters/main", { machine: "mine" })).status).toBe(200);
    expect(await move("move-to", far)).toMatchObject(far);
    expect(await fault(await call("POST", "/plotters/main/jog", { dxMm: 110, dyMm: 0 }))).toMatchObject({
      code: "out-of-bounds",
    });
    const box = { boxMm: { xMm: 0, yMm: 0, widthMm: 601, heightMm: 10 } };
    expect(await fault(await call("POST", "/plotters/main/frame", box))).toMatchObject({ status: 422 });
    expect(await fault(await call("POST", "/plotters/main/square", { sizeMm: 150 }))).toMatchObject({
      status: 422,
    });
  });

  it.each([
    ["move-to", { xMm: 1 }],
    ["jog", { dxMm: "far", dyMm: 0 }],
    ["frame", {}],
    ["square", { sizeMm: 1e9 }],
    ["servo", { pos: 0 }],
    ["command", { line: "V\rEM,0,0" }],
    ["move-to", { xMm: 1, yMm: 1, settings: { machine: "typewriter" } }],
  ])("answer an empty or invalid body with 400: %s", async (name, body) => {
    expect(await fault(await call("POST", `/plotters/main/${name}`, body))).toMatchObject({
      status: 400,
      code: "bad-setting",
    });
  });

  it("are refused while a job is on the plotter, and by a plotter that is absent", async () => {
    const { id } = await addJob(DEFAULT_PLOT_SETTINGS, LONG);
    expect((await call("POST", `/jobs/${id}/start`)).status).toBe(200);
    for (const [name, body] of [
      ["move-to", { xMm: 1, yMm: 1 }],
      ["jog", { dxMm: 1, dyMm: 1 }],
      ["home", {}],
      ["set-home", {}],
      ["cycle-pen", {}],
      ["frame", { boxMm: { xMm: 0, yMm: 0, widthMm: 1, heightMm: 1 } }],
      ["test-patch", {}],
      ["square", { sizeMm: 10 }],
      ["servo", { pos: 12_000 }],
      ["command", { line: "QS" }],
    ] as const) {
      expect(await fault(await call("POST", `/plotters/main/${name}`, body))).toMatchObject({
        status: 409,
        code: "busy",
      });
    }
    expect(await fault(await call("POST", "/plotters/none/home"))).toMatchObject({ status: 404 });
    await call("POST", `/jobs/${id}/cancel`);
  });
});

describe("the board's console", () => {
  const say = async (line: string) => {
    const response = await call("POST", "/plotters/main/command", { line });
    return response.ok ? commandAnswerSchema.parse(await response.json()) : fault(response);
  };

  it("returns all lines that the board answers, errors too", async () => {
    expect(await say("QS")).toEqual({ replies: ["0,0", "OK"], refused: false, note: null });
    expect(await say("qb")).toEqual({ replies: ["0", "OK"], refused: false, note: null });
    expect(await say("V")).toMatchObject({ replies: ["EBBv13_and_above EB Firmware Version 2.8.1"] });
    expect(await say("XX,1")).toMatchObject({ replies: [expect.stringMatching(/^!8 Err/)], refused: true });
    expect(await say("SM,1,1,1,0,0")).toMatchObject({
      replies: expect.arrayContaining(["OK", expect.stringMatching(/^!7 Err/)]) as unknown,
    });
    expect(await move("home")).toMatchObject({ xMm: 0, yMm: 0 });
  });

  it("reports the effect of a line on the position", async () => {
    await move("move-to", { xMm: 10, yMm: 0 });
    expect(await say("SM,100,80,80")).toMatchObject({ note: expect.stringContaining("read back") as string });
    const { xMm } = plotterSchema.parse(await (await call("GET", "/plotters/main")).json());
    expect(xMm).toBe(11);
    expect(await say("CS")).toMatchObject({ note: expect.stringContaining("position is unknown") as string });
    expect(plotterSchema.parse(await (await call("GET", "/plotters/main")).json()).xMm).toBeNull();
  });

  it("sends no line after which the board could no longer be understood", async () => {
    for (const line of ["CU,1,0", "cu,10,1", "CU,4,0", "BL", "EM,1", "BL,1", "CU,01,0", "cu,4", "rb", "R"]) {
      expect(await say(line)).toMatchObject({
        status: 400,
        message: expect.stringContaining("not sent") as string,
      });
    }
    expect(await move("move-to", { xMm: 1, yMm: 1 })).toMatchObject({ xMm: 1, yMm: 1 });
  });
});

describe("custom machines", () => {
  const listed = async () => machineListSchema.parse(await (await call("GET", "/machines")).json()).machines;

  it("are stored as files, listed with the built-in ones, and removed", async () => {
    expect((await call("PUT", "/machines/mine", MINE)).status).toBe(200);
    expect(JSON.parse(readFileSync(join(dataDir, "machines/mine.json"), "utf8"))).toEqual(MINE);
    await server.close();
    await start();
    expect(await listed()).toContainEqual({ ...MINE, builtIn: false });
    expect((await listed()).find(({ id }) => id === "axidraw-v3")?.builtIn).toBe(true);
    // A page that connects gets them with the rest.
    expect(snapshotSchema.parse(await (await call("GET", "/state")).json()).machines).toEqual(await listed());
    expect((await call("DELETE", "/machines/mine")).status).toBe(200);
    expect(await listed()).not.toContainEqual(expect.objectContaining({ id: "mine" }));
    expect(await fault(await call("DELETE", "/machines/mine"))).toMatchObject({ status: 404 });
  });

  it("are copied into the jobs that name them, and stay there when they are removed", async () => {
    await call("PUT", "/machines/mine", MINE);
    await call("PATCH", "/plotters/main", { machine: "mine" });
    const { id, settings } = await addJob(DEFAULT_PLOT_SETTINGS);
    expect(settings.customMachine).toEqual(MINE);
    await call("DELETE", "/machines/mine");
    const started = await call("POST", `/jobs/${id}/start`);
    expect([started.status, ((await started.json()) as Job).settings.customMachine]).toEqual([200, MINE]);
    await call("POST", `/jobs/${id}/cancel`);
  });

  it("are refused if they are invalid, or would replace a built-in one", async () => {
    const put = async (id: string, machine: unknown) => fault(await call("PUT", `/machines/${id}`, machine));
    expect(await put("axidraw-v3", { ...MINE, id: "axidraw-v3" })).toMatchObject({ status: 409 });
    expect(await put("other", MINE)).toMatchObject({
      status: 400,
      message: expect.stringMatching(/^id/) as string,
    });
    expect(await put("mine", { ...MINE, stepsPerMm: 0 })).toMatchObject({ status: 400 });
    expect(await put("mine", { ...MINE, id: "../mine" })).toMatchObject({ status: 400 });
    expect(
      await put("mine", {
        ...MINE,
        controller: { ...MINE.controller, servoPosAt100Pct: MINE.controller.servoPosAt0Pct },
      }),
    ).toMatchObject({
      status: 400,
    });
  });

  it("custom machines in a broken file are named in the log and skipped", async () => {
    await server.close();
    mkdirSync(join(dataDir, "machines"), { recursive: true });
    writeFileSync(join(dataDir, "machines/broken.json"), "{");
    writeFileSync(join(dataDir, "machines/mine.json"), JSON.stringify(MINE));
    await start();
    expect(await listed()).toContainEqual({ ...MINE, builtIn: false });
    expect(logged.join("\n")).toMatch(/broken\.json is skipped: /);
  });
});
