/** `plotwright add` and `queue`, which ask a running server. */
import { createServer as createHttpServer } from "node:http";
import type { AddressInfo } from "node:net";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { beforeEach, describe, expect, it, vi } from "vitest";
import { createServer } from "../../../server/index.js";
import type { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { cli } from "../../support/processes/command-line.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20" stroke="black"><path d="M1 2h9"/></svg>`;
vi.mock("../../../server/cli/stdin.js", () => ({ readStdin: () => Buffer.from(SVG) }));

let dir: string;
let file: string;
beforeEach(() => {
  dir = folderOfTest();
  file = join(dir, "a.svg");
  writeFileSync(file, SVG);
});

describe("plotwright add and queue", () => {
  it("put drawings into a running server's queue, for its machine, and show them", async () => {
    const server = await createServer({
      ...{ port: 0, dataDir: join(dir, "server"), device: "virtual", maxUploadBytes: 1e6 },
      log: () => undefined,
    });
    try {
      const at = ["--url", server.url];
      const patch = { method: "PATCH", headers: { "Content-Type": "application/json" } };
      const body = JSON.stringify({ machine: "axidraw-v3-a3" });
      await fetch(`${server.url}/api/v1/plotters/main`, { ...patch, body });
      const { code, out } = await cli("add", file, "-", "--copies", "2", "--speed", "30", ...at);
      expect(code).toBe(0);
      expect(out).toMatch(/^\S+\ta\.svg\t00:00:\d\d\n\S+\tstdin\t00:00:\d\d\n$/);
      const listed = await cli("queue", "--json", ...at);
      const jobs = JSON.parse(listed.out) as { name: string; settings: typeof DEFAULT_PLOT_SETTINGS }[];
      expect(jobs.map(({ name }) => name)).toEqual(["a.svg", "a.svg", "stdin", "stdin"]);
      expect(jobs[0].settings.motion.draw.speedMmPerS).toBe(30);
      expect(jobs[0].settings.machine).toBe("axidraw-v3-a3");
      expect((await cli("queue", ...at)).out.trimEnd().split("\n").length).toBe(4);
      const nowhere = await cli("add", file, "--plotter", "nope", ...at);
      expect(nowhere).toMatchObject({
        code: 2,
        err: expect.stringMatching(/no plotter nope\. There is main \(/),
      });
      const missing = await cli("add", file, join(dir, "none.svg"), ...at);
      expect(missing).toMatchObject({ code: 3, out: "" });
      writeFileSync(file, "hello");
      const refused = await cli("add", file, ...at);
      expect(refused).toMatchObject({
        code: 3,
        out: "",
        err: expect.stringMatching(/a\.svg: .*refused it/),
      });
    } finally {
      await server.close();
    }
    const gone = await cli("queue", "--url", server.url);
    expect(gone).toMatchObject({ code: 5, err: expect.stringMatching(/No plotwright server answers/) });
  });

  it("say whether a key, a certificate, the protocol or the server is at fault", async () => {
    const tlsFile = (name: string): string =>
      readFileSync(new URL(`../../fixtures/tls/${name}.pem`, import.meta.url), "utf8");
    const options = { port: 0, device: "virtual", maxUploadBytes: 1e6, log: () => undefined };
    const paired = await createServer({ ...options, dataDir: join(dir, "paired"), pairAlways: true });
    const tls = { cert: tlsFile("cert"), key: tlsFile("key") };
    const secure = await createServer({ ...options, dataDir: join(dir, "secure"), tls });
    const other = createHttpServer((_, response) => void response.end("<html>"));
    await new Promise<void>((resolve) => other.listen(0, "127.0.0.1", resolve));
    try {
      const port = (other.address() as AddressInfo).port;
      const faults: readonly (readonly [string, readonly string[], number, RegExp])[] = [
        [paired.url, [], 5, /Pair this device first.* Or give an access key.*PLOTWRIGHT_KEY/],
        [paired.url, ["--key", "x"], 5, /This access key is not valid/],
        [secure.url, [], 5, /The certificate of .* is not trusted .*NODE_EXTRA_CA_CERTS/],
        [secure.url.replace("https", "http"), [], 5, /Does it answer at https:/],
        [paired.url.replace("http", "https"), [], 5, /Does it answer at http:/],
        [`http://127.0.0.1:${port}`, [], 2, /is not a plotwright server/],
      ];
      for (const [url, args, code, message] of faults) {
        const run = await cli("queue", "--url", url, ...args);
        expect([url, run]).toEqual([url, { code, out: "", err: expect.stringMatching(message) as string }]);
      }
    } finally {
      other.close();
      await Promise.all([paired.close(), secure.close()]);
    }
  });
});
