/** Drawings that are sent as a form with their settings, by programs that do it right, and by others. */
import { connect } from "node:net";
import { Readable } from "node:stream";
import fc from "fast-check";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { apiErrorSchema, jobSchema } from "../../../src/schema/index.js";
import { cases } from "../../support/runs/full-run.js";
import { startApp, type TestApp } from "../../support/servers/app.js";

const SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10"/></svg>';
const BOUNDARY = "----boundary";
const MAX_BYTES = 300_000;

let app: TestApp;
beforeEach(async () => {
  app = await startApp({ maxUploadBytes: MAX_BYTES });
});
afterEach(() => app.close());

const post = (body: BodyInit, headers: Record<string, string> = {}, path = "/jobs"): Promise<Response> =>
  fetch(`${app.url}/api/v1${path}`, { method: "POST", body, headers, signal: AbortSignal.timeout(20_000) });
const postText = (text: string, type = `multipart/form-data; boundary=${BOUNDARY}`): Promise<Response> =>
  post(text, { "Content-Type": type });
const faultOf = async (response: Response): Promise<readonly [status: number, message: string]> => [
  response.status,
  apiErrorSchema.parse(await response.json()).error.message,
];

/** One part of a form as text. */
const part = (disposition: string, content: string, more = ""): string =>
  `--${BOUNDARY}\r\nContent-Disposition: form-data; ${disposition}\r\n${more}\r\n${content}\r\n`;
const FILE = part('name="drawing"; filename="a.svg"', SVG, "Content-Type: image/svg+xml\r\n");
const END = `--${BOUNDARY}--\r\n`;

function form(fields: Record<string, string>, files: readonly File[]): FormData {
  const data = new FormData();
  for (const file of files) data.append("drawing", file);
  for (const [name, value] of Object.entries(fields)) data.append(name, value);
  return data;
}
const svgFile = (name = "flower.svg", text = SVG): File => new File([text], name, { type: "image/svg+xml" });

/** Nothing of a refused form stays, and the server goes on. */
async function nothingIsLeft(): Promise<void> {
  expect(app.queue.list()).toEqual([]);
  await expect.poll(() => app.drawingsOnDisk()).toEqual([]);
  expect((await fetch(`${app.url}/api/v1/state`)).status).toBe(200);
  expect(app.logged.filter((line) => line.includes("Error"))).toEqual([]);
}

describe("a form with a drawing", () => {
  it("adds a job with the settings beside it, in any order, and with the file's name", async () => {
    const settings = JSON.stringify({ pen: { downPct: 21 } });
    const added = await post(form({ settings, plotterId: "virtual" }, [svgFile()]));
    expect(added.status).toBe(201);
    const job = jobSchema.parse(await added.json());
    expect(added.headers.get("location")).toBe(`/api/v1/jobs/${job.id}`);
    expect([job.name, job.settings.pen.downPct]).toEqual(["flower.svg", 21]);
    expect(await (await fetch(`${app.url}/api/v1/jobs/${job.id}/drawing`)).text()).toBe(SVG);
    const before = postText(part('name="settings"', settings) + part('name="name"', "mine") + FILE + END);
    expect(jobSchema.parse(await (await before).json())).toMatchObject({
      name: "mine",
      settings: { pen: { downPct: 21 } },
    });
  });

  it("needs no name: not for a blob, nor for a path", async () => {
    const nameOf = async (body: BodyInit): Promise<string> =>
      jobSchema.parse(await (await post(body)).json()).name;
    const blob = new FormData();
    blob.append("file", new Blob([SVG]));
    expect(await nameOf(blob)).toBe("drawing.svg");
    expect(await nameOf(form({}, [svgFile("../../etc/passwd")]))).toBe("passwd");
    expect(await nameOf(form({}, [svgFile("fleur é “x”.svg")]))).toBe("fleur é “x”.svg");
  });

  it("is written as it is, byte for byte, whatever is in it and however it arrives", async () => {
    await fc.assert(
      fc.asyncProperty(fc.uint8Array({ minLength: 1, maxLength: 3_000 }), fc.nat(500), async (bytes, cut) => {
        const data = new FormData();
        data.append("drawing", new Blob([Buffer.from(bytes)]), "a.svg");
        const request = new Request(app.url, { method: "POST", body: data });
        const whole = Buffer.from(await request.arrayBuffer());
        const chunks = [whole.subarray(0, cut), whole.subarray(cut)].filter(({ length }) => length > 0);
        const answer = await fetch(`${app.url}/api/v1/jobs`, {
          method: "POST",
          headers: { "Content-Type": request.headers.get("content-type") ?? "" },
          body: Readable.toWeb(Readable.from(chunks)),
          duplex: "half",
        } as unknown as RequestInit);
        const { id } = jobSchema.parse(await answer.json());
        const stored = await (await fetch(`${app.url}/api/v1/jobs/${id}/drawing`)).arrayBuffer();
        expect(Buffer.from(stored).equals(Buffer.from(bytes))).toBe(true);
      }),
      { numRuns: cases(15, 200) },
    );
  }, 60_000);

  it.each<readonly [string, () => Promise<Response>, number, RegExp]>([
    ["two files", () => post(form({}, [svgFile(), svgFile()])), 422, /more than one file/],
    ["no file", () => post(form({ name: "a" }, [])), 422, /has no file/],
    ["an empty file", () => post(form({}, [svgFile("a.svg", "")])), 422, /is empty/],
    [
      "the drawing as text",
      () => post(form({ drawing: SVG }, [])),
      400,
      /field "drawing" that is not a file/,
    ],
    ["an unknown field", () => post(form({ setting: "{}" }, [svgFile()])), 400, /field "setting"/],
    ["a field twice", () => postText(part('name="name"', "a").repeat(2) + FILE + END), 400, /name twice/],
    ["settings that are no JSON", () => post(form({ settings: "{" }, [svgFile()])), 400, /not valid JSON/],
    ["unknown settings", () => post(form({ settings: '{"pn":1}' }, [svgFile()])), 400, /no such setting/],
    ["an unknown plotter", () => post(form({ plotterId: "x" }, [svgFile()])), 404, /no plotter/],
    [
      "a long field",
      () => post(form({ settings: "x".repeat(300_000) }, [svgFile()])),
      400,
      /longer than 200/,
    ],
    [
      "a file that is too large",
      () => post(form({}, [svgFile("a", "x".repeat(MAX_BYTES + 1))])),
      413,
      /larger/,
    ],
    [
      "a large file behind a small one",
      () => post(form({}, [svgFile(), svgFile("b", "x".repeat(2e6))])),
      422,
      /more/,
    ],
    ["endless fields", () => postText(part('name="x"', "").repeat(50_000) + END), 400, /field/],
    ["endless text before", () => postText("x".repeat(4_000_000) + FILE + END), 413, /larger/],
    ["endless text after", () => postText(FILE + END + "x".repeat(4_000_000)), 413, /larger/],
    ["no boundary", () => postText(FILE + END, "multipart/form-data"), 400, /can't be read.*Boundary/i],
    ["an empty boundary", () => postText(FILE + END, "multipart/form-data; boundary="), 422, /no file/],
    ["another boundary", () => postText(FILE + END, "multipart/form-data; boundary=x"), 400, /can't be read/],
    [
      "another kind of parts",
      () => postText(FILE + END, `multipart/mixed; boundary=${BOUNDARY}`),
      400,
      /form/i,
    ],
    ["no end", () => postText(FILE), 400, /can't be read/],
    ["an end in the middle of the file", () => postText(FILE.slice(0, -30)), 400, /can't be read/],
    ["an end in the middle of a header", () => postText(FILE.slice(0, 50)), 400, /can't be read/],
    ["nothing", () => postText(""), 400, /can't be read/],
    ["only an end", () => postText(END), 422, /no file/],
    ["a part without a header", () => postText(`--${BOUNDARY}\r\n\r\n${SVG}\r\n${END}`), 422, /no file/],
    [
      "a part without a name",
      () => postText(part('filename="a.svg"', SVG).repeat(2) + END),
      422,
      /more than one/,
    ],
  ])("with %s is refused with words", async (_what, send, status, message) => {
    expect(await faultOf(await send())).toEqual([status, expect.stringMatching(message)]);
    await nothingIsLeft();
  });

  it.each([
    ["a huge header", `X-A: ${"y".repeat(900_000)}\r\n`],
    ["thousands of headers", "X-A: b\r\n".repeat(20_000)],
  ])("ignores %s of a part", async (_what, headers) => {
    const text = part('name="name"', "a", headers) + part('name="x"; filename="a.svg"', SVG, headers) + END;
    const { id, name } = jobSchema.parse(await (await postText(text)).json());
    expect(name).toBe("a");
    expect(await (await fetch(`${app.url}/api/v1/jobs/${id}/drawing`)).text()).toBe(SVG);
  });

  it("in a form is a file like any other: what is nested in it is not read", async () => {
    const inner = part('name="drawing"; filename="b.svg"', SVG).replaceAll(BOUNDARY, "inner");
    const nested = `${inner}--inner--`;
    const answer = await postText(
      part('name="x"; filename="a.svg"', nested, "Content-Type: multipart/mixed; boundary=inner\r\n") + END,
    );
    const { id } = jobSchema.parse(await answer.json());
    expect(await (await fetch(`${app.url}/api/v1/jobs/${id}/drawing`)).text()).toBe(nested);
  });

  it("gives fields no power over the server's own objects", async () => {
    for (const name of ["__proto__", "constructor", "toString", "hasOwnProperty"]) {
      expect(await faultOf(await post(form({ [`${name} `]: "x", name: "a" }, [svgFile()])))).toEqual([
        400,
        expect.stringContaining("that is not a file"),
      ]);
      const text = part(`name="${name}"`, "x") + FILE + END;
      expect(await faultOf(await postText(text))).toEqual([400, expect.stringContaining(`"${name}"`)]);
    }
    await nothingIsLeft();
  });

  it("leaves nothing when its sender goes away in the middle", async () => {
    const { hostname, port } = new URL(app.url);
    const socket = connect(Number(port), hostname);
    socket.write(
      `POST /api/v1/jobs HTTP/1.1\r\nHost: ${hostname}\r\nContent-Length: 90000\r\nContent-Type: multipart/form-data; boundary=${BOUNDARY}\r\n\r\n`,
    );
    socket.write(FILE.slice(0, -20));
    await expect.poll(() => app.drawingsOnDisk().length).toBe(1);
    socket.destroy();
    await nothingIsLeft();
  });

  it("survives any form with bytes changed, left out or repeated", async () => {
    const whole = part('name="name"', "a") + FILE + part('name="settings"', "{}") + END;
    const change = fc.record({
      at: fc.nat(whole.length),
      length: fc.nat(20),
      text: fc.oneof(
        fc.string({ maxLength: 5 }),
        fc.constantFrom("\r\n", "--", BOUNDARY, ";", '"', "\0", FILE),
      ),
    });
    await fc.assert(
      fc.asyncProperty(fc.array(change, { minLength: 1, maxLength: 3 }), async (changes) => {
        const text = changes.reduce(
          (now, { at, length, text: put }) => now.slice(0, at) + put + now.slice(at + length),
          whole,
        );
        const { status } = await postText(text);
        expect([201, 400, 413, 422]).toContain(status);
      }),
      { numRuns: cases(60, 2_000) },
    );
    await expect.poll(() => app.drawingsOnDisk().length).toBe(app.queue.list().length);
    expect(app.logged.filter((line) => line.includes("Error"))).toEqual([]);
  }, 60_000);

  it("is refused where only the file is taken", async () => {
    expect(await faultOf(await post(form({}, [svgFile()]), {}, "/drawings"))).toEqual([
      400,
      expect.stringMatching(/Send a form to POST \/jobs/),
    ]);
    await nothingIsLeft();
  });
});
