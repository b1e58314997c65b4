/** Plug-ins of a whole server: each is loaded only if an option requests it. */
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { createServer, type PlotwrightServer, type ServerOptions } from "../../../server/index.js";
import { apiErrorSchema } from "../../../src/schema/index.js";
import { folderOfTest } from "../../support/processes/folders.js";

let dataDir: string;
let server: PlotwrightServer | null = null;
beforeEach(() => {
  dataDir = folderOfTest();
});
afterEach(async () => {
  await server?.close();
  server = null;
});

async function open(options: ServerOptions): Promise<PlotwrightServer> {
  server = await createServer({ port: 0, device: "virtual", dataDir, ...options });
  return server;
}
const get = async (path: string): Promise<[number, string]> => {
  const answer = await fetch(`${server?.url}/api/v1${path}`);
  return answer.ok
    ? [answer.status, await answer.text()]
    : [answer.status, apiErrorSchema.parse(await answer.json()).error.message];
};

describe("a plug-in that is not requested", () => {
  it("has no routes, is not in the OpenAPI document, and the answer says what to do", async () => {
    await open({ webhooks: false });
    expect(await get("/webhooks")).toEqual([404, "Webhooks are switched off on this server."]);
    expect(await get("/shared-jobs")).toEqual([404, expect.stringContaining("serve --shared-queue")]);
    const [, text] = await get("/openapi.json");
    expect(Object.keys((JSON.parse(text) as { paths: object }).paths).join(" ")).not.toMatch(
      /webhooks|shared/,
    );
  }, 30_000);
});

describe("a requested plug-in", () => {
  it("has its routes, in the OpenAPI document too", async () => {
    await open({});
    expect(await get("/webhooks")).toEqual([200, '{"webhooks":[]}']);
    const [, text] = await get("/openapi.json");
    expect((JSON.parse(text) as { paths: object }).paths).toHaveProperty(["/webhooks/{id}"]);
  }, 30_000);

  it("a plug-in that fails to start prevents the server from starting, and everything else is closed", async () => {
    await expect(open({ watchDir: join(dataDir, "none") })).rejects.toMatchObject({ code: "bad-setting" });
    // The data folder is free again.
    await open({});
    expect((await get("/state"))[0]).toBe(200);
  }, 30_000);
});
