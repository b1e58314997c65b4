import { describe, expect, it } from "vitest";
import { cachedAnswer, cachesToDrop, ruleFor } from "../../../web/pwa/shell-rules.js";

const HERE = "http://127.0.0.1:9080/";
const asked = (path: string, more: { method?: string; mode?: string } = {}, page = HERE) =>
  ruleFor({ method: "GET", url: new URL(path, HERE).href, mode: "cors", ...more }, page);

describe("the service worker", () => {
  it("answers for the page and its files", () => {
    expect(asked("/", { mode: "navigate" })).toBe("page");
    expect(asked("/assets/index-abc.js")).toBe("cached");
    expect(asked("/icon.svg")).toBe("cached");
  });

  it("never answers for the API, whatever the request", () => {
    for (const path of [
      "/api/v1/state",
      "/api/v1/events",
      "/api/v1/samples/a.svg",
      "/api/v1/jobs/a/drawing",
    ]) {
      expect(asked(path)).toBeNull();
      expect(asked(path, { mode: "navigate" })).toBeNull();
      expect(asked(path, { method: "POST" })).toBeNull();
    }
  });

  it("ignores pairing, other pages and other sites", () => {
    expect(asked("/pair?token=x", { mode: "navigate" })).toBeNull();
    expect(asked("http://camera.local/picture.png")).toBeNull();
  });

  it("answers only for its own folder of a site", () => {
    const page = `${HERE}plots/app/`;
    expect(asked("/plots/app/?from=docs", { mode: "navigate" }, page)).toBe("page");
    expect(asked("/plots/app/index.html", { mode: "navigate" }, page)).toBe("page");
    expect(asked("/plots/app/assets/index-abc.js", {}, page)).toBe("cached");
    for (const path of ["/", "/plots/", "/plots/docs/index.html"]) {
      expect(asked(path, { mode: "navigate" }, page)).toBeNull();
    }
    expect(asked("/assets/index-abc.js", {}, page)).toBeNull();
    expect(asked("/plots/docs/icon.svg", {}, page)).toBeNull();
  });

  it("keeps the previous version for pages that are still open", () => {
    const names = ["plotwright-1", "other", "plotwright-2", "plotwright-3"];
    expect(cachesToDrop(names, "plotwright-", "plotwright-3")).toEqual(["plotwright-1"]);
    expect(cachesToDrop(["plotwright-3"], "plotwright-", "plotwright-3")).toEqual([]);
  });

  it("answers with the current version's file, or with one that only the previous version has", async () => {
    const stored = (files: Readonly<Record<string, string>>) => ({
      match: ({ url }: { readonly url: string }) => {
        const text = files[new URL(url).pathname];
        return Promise.resolve(text === undefined ? undefined : new Response(text));
      },
    });
    // As in a browser, all caches together answer with the oldest file.
    const caches = {
      ...stored({ "/icon.svg": "old", "/assets/part-old.js": "old part" }),
      open: () => Promise.resolve(stored({ "/icon.svg": "new" })),
    };
    const textOf = async (file: string): Promise<string | undefined> =>
      (await cachedAnswer(caches, "plotwright-3", new Request(new URL(file, HERE))))?.text();
    expect(await textOf("icon.svg")).toBe("new");
    expect(await textOf("assets/part-old.js")).toBe("old part");
    expect(await textOf("assets/none.js")).toBeUndefined();
  });
});
