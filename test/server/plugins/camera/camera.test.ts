/** A server's camera: pictures of a plot, who may see what, and that a bad camera disturbs nothing. */
import { existsSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import {
  cameraStateSchema,
  jobSchema,
  keptPicturesSchema,
  type CameraState,
  type KeptPicture,
  type KeptPictures,
  type Role,
} from "../../../../src/schema/index.js";
import {
  BLUE,
  fakeCamera,
  RED,
  still,
  stream,
  type FakeCamera,
} from "../../../support/camera/fake-camera.js";
import { startApp, type TestApp } from "../../../support/servers/app.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
type Headers = Record<string, string>;
const MOODS: readonly Parameters<typeof fakeCamera>[0][string][] = [
  still(RED),
  (response) => void response.destroy(),
  (response) => void response.writeHead(500).end("no"),
  still(Buffer.from("<html>not a picture</html>")),
  still(RED.subarray(0, RED.length / 2)),
];

let app: TestApp;
let camera: FakeCamera;
let operator: Headers;
beforeEach(async () => {
  camera = await fakeCamera({
    "/still": (response, request, count) => still(count % 2 === 0 ? BLUE : RED)(response, request, count),
    "/stream": stream([BLUE]),
    "/broken": (response) => void response.destroy(),
    "/moody": (response, request, count) => MOODS[count % MOODS.length](response, request, count),
  });
  app = await startApp({ trustsLoopback: false });
  operator = keyOf("operate");
});
afterEach(async () => {
  await app.close();
  await camera.close();
});

const keyOf = (role: Role): Headers => ({
  Authorization: `Bearer ${app.access.createKey(`a ${role}`, role).secret}`,
});
const call = (method: string, path: string, headers = operator, body?: unknown): Promise<Response> =>
  fetch(`${app.url}/api/v1${path}`, {
    method,
    headers: { ...headers, ...(body === undefined ? {} : { "Content-Type": "application/json" }) },
    ...(body === undefined ? {} : { body: JSON.stringify(body) }),
  });
const cameraPath = (): string => `/plotters/${app.plotter.id}/camera`;
const setCamera = async (path: string, everyS = 1, url = camera.url): Promise<CameraState> => {
  const answer = await call("PUT", cameraPath(), operator, { url: url + path, everyS });
  expect(answer.status).toBe(200);
  return cameraStateSchema.parse(await answer.json());
};
const addJob = async (): Promise<string> =>
  jobSchema.parse(
    await (
      await fetch(`${app.url}/api/v1/jobs?name=x.svg`, { method: "POST", headers: operator, body: SVG })
    ).json(),
  ).id;
const startJob = async (id: string) => {
  await app.queue.start(id);
  return app.plotter.nextRun();
};
const listOf = async (id: string): Promise<KeptPictures> =>
  keptPicturesSchema.parse(await (await call("GET", `/jobs/${id}/pictures`)).json());
const pictures = async (id: string): Promise<readonly KeptPicture[]> => (await listOf(id)).pictures;
const picture = (id: string, at: string, headers = operator): Promise<Response> =>
  call("GET", `/jobs/${id}/picture?at=${encodeURIComponent(at)}`, headers);

describe("a plotter with a camera", () => {
  it("keeps pictures while a job moves, none while it is held, and the last one of what is done", async () => {
    expect(await setCamera("/still")).toMatchObject({ camera: { everyS: 1 }, last: { fault: null } });
    const id = await addJob();
    const run = await startJob(id);
    await expect.poll(async () => (await pictures(id)).length).toBe(2);
    run.held(true);
    const asked = camera.requests.length;
    await new Promise((resolve) => setTimeout(resolve, 1_500));
    expect(camera.requests.length).toBeLessThanOrEqual(asked + 1);
    run.held(false);
    await expect.poll(async () => (await pictures(id)).length).toBeGreaterThanOrEqual(3);
    const before = (await pictures(id)).length;
    run.end({ kind: "done" });
    await expect.poll(async () => (await pictures(id)).length).toBeGreaterThan(before);
    const kept = await pictures(id);
    expect(kept.map(({ at }) => at)).toEqual([...kept.map(({ at }) => at)].sort());
    const answer = await picture(id, kept[0].at);
    expect([
      answer.status,
      answer.headers.get("content-type"),
      answer.headers.get("x-content-type-options"),
    ]).toEqual([200, "image/jpeg", "nosniff"]);
    expect([RED, BLUE].some((one) => one.length === kept[0].bytes)).toBe(true);
    expect((await answer.arrayBuffer()).byteLength).toBe(kept[0].bytes);
    // They go with the job.
    const folder = join(app.dir, "pictures", id);
    expect(existsSync(folder)).toBe(true);
    await call("DELETE", `/jobs/${id}`);
    await expect.poll(() => existsSync(folder)).toBe(false);
    expect((await call("GET", `/jobs/${id}/pictures`)).status).toBe(404);
  });

  it("keeps the pictures of the last plot of a job that is plotted again", async () => {
    await setCamera("/stream", 3_600);
    const id = await addJob();
    const run = await startJob(id);
    await expect.poll(async () => (await pictures(id)).length).toBe(1);
    run.end({ kind: "done" });
    await expect.poll(async () => (await pictures(id)).length).toBe(2);
    const [first] = await pictures(id);
    app.queue.requeue(id);
    await startJob(id);
    await expect.poll(async () => (await pictures(id)).map(({ at }) => at)).not.toContain(first.at);
    await expect.poll(async () => (await pictures(id)).length).toBe(1);
    expect((await picture(id, first.at)).status).toBe(404);
    expect((await picture(id, "../../plotwright.db")).status).toBe(400);
  });

  it("plots on without a picture from a camera that does not work, and says why to operators only", async () => {
    const url = camera.url.replace("//", "//me:geheim@");
    expect((await setCamera("/broken", 1, url)).last?.fault).toContain("can't be reached");
    const id = await addJob();
    const run = await startJob(id);
    await expect.poll(() => camera.requests.length).toBeGreaterThan(2);
    run.end({ kind: "done" });
    await expect.poll(() => app.queue.get(id).state).toBe("done");
    expect(await pictures(id)).toEqual([]);
    for (const role of ["watch", "submit"] as const) {
      const headers = keyOf(role);
      expect((await call("GET", cameraPath(), headers)).status).toBe(403);
      expect((await call("PUT", cameraPath(), headers, { url, everyS: 5 })).status).toBe(403);
      expect((await call("DELETE", cameraPath(), headers)).status).toBe(403);
      expect(await (await call("GET", "/state", headers)).text()).not.toContain("geheim");
    }
    expect(app.logged.join("\n")).not.toMatch(/geheim|me:/);
    // Said once, however often it was tried.
    expect(app.logged.filter((line) => line.startsWith("camera of")).length).toBe(1);
  });

  it("goes on after pictures that fail, whatever is wrong with them, and says how many are missing", async () => {
    await setCamera("/moody", 1);
    const id = await addJob();
    const run = await startJob(id);
    // In turn: gone, a server error, no picture, half of one, and a picture.
    await expect.poll(async () => (await pictures(id)).length, { timeout: 20_000 }).toBe(2);
    const { missing } = await listOf(id);
    expect(missing).toBeGreaterThanOrEqual(4);
    const asked = camera.requests.length;
    run.end({ kind: "done" });
    await expect.poll(() => camera.requests.length).toBeGreaterThan(asked);
    await expect
      .poll(async () => {
        const now = await listOf(id);
        return now.pictures.length + now.missing;
      })
      .toBe(camera.requests.length - 1);
    // The count is that of the last plot.
    app.queue.requeue(id);
    const again = await startJob(id);
    await expect.poll(async () => (await listOf(id)).missing).toBeLessThan(missing);
    again.end({ kind: "done" });
  }, 40_000);

  it("goes on after pictures that can't be stored, and says how many are missing", async () => {
    const folder = join(app.dir, "pictures");
    writeFileSync(folder, "a file in place of the folder");
    await setCamera("/stream", 1);
    const id = await addJob();
    const run = await startJob(id);
    await expect.poll(async () => (await listOf(id)).missing).toBe(2);
    rmSync(folder);
    await expect.poll(async () => (await listOf(id)).pictures.length).toBeGreaterThan(0);
    expect(app.logged.filter((line) => line.startsWith("the pictures of a job")).length).toBe(1);
    run.end({ kind: "done" });
  });

  it("shows a job's pictures to whoever may see the job", async () => {
    await setCamera("/stream", 3_600);
    const id = await addJob();
    const run = await startJob(id);
    await expect.poll(async () => (await pictures(id)).length).toBe(1);
    const [{ at }] = await pictures(id);
    expect((await picture(id, at, keyOf("watch"))).status).toBe(200);
    // Of another submitter.
    expect((await picture(id, at, keyOf("submit"))).status).toBe(404);
    run.end({ kind: "done" });
  });

  it("takes only http addresses, and forgets the camera that was removed", async () => {
    for (const url of ["file:///etc/passwd", "ftp://camera/", "javascript:alert(1)", "camera"]) {
      expect((await call("PUT", cameraPath(), operator, { url, everyS: 5 })).status).toBe(400);
    }
    expect((await call("PUT", "/plotters/none/camera", operator, { url: camera.url })).status).toBe(404);
    await setCamera("/stream", 1);
    await call("DELETE", cameraPath());
    const found = cameraStateSchema.parse(await (await call("GET", cameraPath())).json());
    expect(found).toEqual({ camera: null, last: null });
    const id = await addJob();
    const run = await startJob(id);
    run.end({ kind: "done" });
    await expect.poll(() => app.queue.get(id).state).toBe("done");
    expect(await pictures(id)).toEqual([]);
  });
});
