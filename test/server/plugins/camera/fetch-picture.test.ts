/** One picture from whatever answers at a camera's address. */
import fc from "fast-check";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import {
  CAMERA_LIMITS,
  fetchPicture,
  PictureReader,
} from "../../../../server/plugins/camera/fetch-picture.js";
import {
  BLUE,
  endless,
  fakeCamera,
  PNG,
  RED,
  still,
  stream,
  withThumbnail,
  type FakeCamera,
} from "../../../support/camera/fake-camera.js";

const LIMITS = { timeoutMs: 30_000, maxBytes: 100_000, maxRedirects: 3 };
/** For what never sends a picture. */
const HURRIED = { ...LIMITS, timeoutMs: 1_500 };
/** Looks like a picture that never ends. */
const ENDLESS_SCAN = RED.subarray(0, RED.length - 2);

let camera: FakeCamera;
let other: FakeCamera;
beforeEach(async () => {
  other = await fakeCamera({ "/still": still(BLUE) });
  camera = await fakeCamera({
    "/still": still(RED),
    "/untyped": still(RED, "application/octet-stream"),
    "/png": still(PNG, "image/png"),
    "/thumbnail": still(withThumbnail(RED, BLUE)),
    "/stream": stream([RED, BLUE]),
    "/stream-of-thumbnails": stream([withThumbnail(BLUE, RED)], "--frame", false),
    "/redirected": (response) => void response.writeHead(302, { location: "/still" }).end(),
    "/elsewhere": (response) => void response.writeHead(307, { location: `${other.url}/still` }).end(),
    "/loop": (response) => void response.writeHead(301, { location: "/loop" }).end(),
    "/to-file": (response) => void response.writeHead(302, { location: "file:///etc/passwd" }).end(),
    "/page": still(Buffer.from("<html>secret text</html>"), "text/html"),
    "/text-as-picture": still(Buffer.from("secret text, long enough to be looked at"), "image/jpeg"),
    "/drawing": still(Buffer.from("<svg xmlns='http://www.w3.org/2000/svg'/>"), "image/svg+xml"),
    "/short": still(ENDLESS_SCAN),
    "/empty": still(Buffer.alloc(0)),
    "/empty-stream": stream([]),
    "/refused": (response) => void response.writeHead(401).end("who are you?"),
    "/broken": (response) => void response.destroy(),
    "/silent": () => undefined,
    "/stalled": (response) => {
      response.writeHead(200, { "content-type": "image/jpeg" });
      response.write(RED.subarray(0, 100));
    },
    "/endless-picture": endless("image/jpeg", ENDLESS_SCAN, Buffer.alloc(10_000, 7)),
    "/endless-png": endless("image/png", PNG, Buffer.alloc(10_000)),
    "/endless-stream": endless(
      "multipart/x-mixed-replace; boundary=x",
      Buffer.from("--x\r\n"),
      Buffer.alloc(10_000, 65),
    ),
  });
});
afterEach(async () => {
  await camera.close();
  await other.close();
});

const get = async (path: string, url = camera.url, limits = LIMITS) => {
  const { kind, bytes } = await fetchPicture(url + path, new AbortController().signal, limits);
  return [kind, Buffer.from(bytes).toString("hex")];
};
const jpg = (bytes: Buffer): string[] => ["jpg", bytes.toString("hex")];

describe("a camera's picture", () => {
  it.each([
    ["/still", () => jpg(RED)],
    ["/untyped", () => jpg(RED)],
    ["/png", () => ["png", PNG.toString("hex")]],
    ["/thumbnail", () => jpg(withThumbnail(RED, BLUE))],
    ["/stream", () => jpg(RED)],
    ["/stream-of-thumbnails", () => jpg(withThumbnail(BLUE, RED))],
    ["/redirected", () => jpg(RED)],
    ["/elsewhere", () => jpg(BLUE)],
  ])("is read whole: %s", async (path, expected) => {
    expect(await get(path)).toEqual(expected());
  });

  it.each([
    ["/loop", "The camera redirects more than 3 times."],
    ["/to-file", "The camera redirects to an address that is not http or https."],
    ["/page", "What is at this address is neither a still picture nor an MJPEG stream."],
    ["/text-as-picture", "it has to be JPEG"],
    ["/drawing", "it has to be JPEG"],
    ["/short", "The camera's picture is cut short."],
    ["/empty", "it has to be JPEG"],
    ["/refused", "The camera asks for a name and a password (HTTP 401)."],
    ["/missing", "The camera answers with HTTP 404."],
    ["/broken", "The camera can't be reached"],
    ["/silent", "The camera sent no picture within 1.5 s."],
    ["/stalled", "The camera sent no picture within 1.5 s."],
    ["/empty-stream", "The camera sent no picture within 1.5 s."],
    ["/endless-picture", "The camera's picture is larger than 0.1 MB."],
    ["/endless-png", "The camera's picture is larger than 0.1 MB."],
    ["/endless-stream", "it has to be JPEG"],
  ])("is refused in words that do not have the answer: %s", async (path, words) => {
    const limits = words.includes("1.5 s") ? HURRIED : LIMITS;
    const error = await get(path, camera.url, limits).catch((cause: Error) => cause.message);
    expect(error).toContain(words);
    expect(error).not.toContain("secret");
    expect(camera.requests.length).toBeLessThanOrEqual(LIMITS.maxRedirects + 1);
  });

  it("is asked for with the address's name and password, which no other server gets", async () => {
    const url = camera.url.replace("//", "//me:p%25ss%@");
    const authorization = `Basic ${Buffer.from("me:p%25ss%").toString("base64")}`;
    await get("/redirected", url);
    expect(camera.requests.map((one) => one.authorization)).toEqual([authorization, authorization]);
    await get("/elsewhere", url);
    expect(other.requests.map((one) => one.authorization)).toEqual([undefined]);
    const fault = await get("/refused", url).catch(String);
    expect(fault).not.toContain("p%");
  });

  it("is not waited for when the server stops", async () => {
    const stop = new AbortController();
    const got = fetchPicture(`${camera.url}/silent`, stop.signal, CAMERA_LIMITS).catch(String);
    await expect.poll(() => camera.requests.length).toBe(1);
    stop.abort();
    expect(await got).toContain("The camera can't be reached");
  });

  it("is the same however the bytes are cut into pieces, and whatever follows it", () => {
    const pictures = [RED, BLUE, withThumbnail(RED, BLUE), withThumbnail(BLUE, RED)];
    fc.assert(
      fc.property(
        fc.constantFrom(...pictures),
        fc.boolean(),
        fc.array(fc.integer({ min: 1, max: 200 }), { minLength: 1 }),
        fc.uint8Array({ maxLength: 50 }),
        (picture, isStream, cuts, after) => {
          const before = isStream ? Buffer.from("--x\r\nContent-Type: image/jpeg\r\n\r\n") : Buffer.alloc(0);
          const sent = Buffer.concat([before, picture, after]);
          const reader = new PictureReader(isStream, 10_000);
          for (let at = 0, i = 0; at < sent.length; i++) {
            const end = at + cuts[i % cuts.length];
            const got = reader.read(sent.subarray(at, end));
            at = end;
            if (got === null) continue;
            expect(Buffer.from(got.bytes).equals(picture)).toBe(true);
            return;
          }
          expect.unreachable("the picture is whole");
        },
      ),
    );
  });

  it("is never read from bytes that are none: nothing is returned, or a fault is thrown", () => {
    fc.assert(
      fc.property(
        fc.uint8Array({ maxLength: 300 }),
        fc.integer({ min: 0, max: RED.length - 3 }),
        (noise, keep) => {
          const reader = new PictureReader(false, 10_000);
          const broken = Buffer.concat([RED.subarray(0, keep), noise]);
          let got = null;
          try {
            got = reader.read(broken);
          } catch (error) {
            expect((error as Error).message).toContain("it has to be JPEG");
          }
          // Noise may happen to have a whole picture's form: then no more was taken than came.
          if (got !== null) expect(got.bytes.length).toBeLessThanOrEqual(broken.length);
        },
      ),
    );
  });
});
