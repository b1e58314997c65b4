/** What a click on a system notification does. The worker's rules for requests are tested in shell-rules.test.ts. */
import { afterAll, beforeAll, expect, describe, it, vi } from "vitest";

interface Click {
  readonly notification: { close(): void };
  waitUntil(done: Promise<unknown>): void;
}

const PAGE = "https://plots.local/app/";

const listeners = new Map<string, (event: Click) => void>();
let pages: readonly string[] = [];
let done: string[] = [];

/** Clicks while these pages are open, the most recently focused first. Returns what happened, in order. */
async function click(openPages: readonly string[]): Promise<readonly string[]> {
  [pages, done] = [openPages, []];
  let handled: Promise<unknown> | null = null;
  listeners.get("notificationclick")?.({
    notification: { close: () => void done.push("close") },
    waitUntil: (promise) => void (handled = promise),
  });
  await handled;
  return done;
}

describe("a click on a notification", () => {
  beforeAll(async () => {
    vi.stubGlobal("location", { href: `${PAGE}service-worker.js` });
    vi.stubGlobal("addEventListener", (type: string, listener: (event: Click) => void) =>
      listeners.set(type, listener),
    );
    vi.stubGlobal("clients", {
      matchAll: ({ type }: { type: string }) =>
        Promise.resolve(
          type === "window" ? pages.map((name) => ({ focus: () => void done.push(`focus ${name}`) })) : [],
        ),
      openWindow: (url: string) => void done.push(`open ${url}`),
    });
    // The build replaces this text by the list of the page's files.
    const parse = JSON.parse;
    vi.spyOn(JSON, "parse").mockImplementation((text, reviver) =>
      text === "__SHELL__" ? { version: "1", files: [] } : parse(text, reviver),
    );
    await import("../../../web/pwa/service-worker.js");
  });
  afterAll(() => {
    vi.restoreAllMocks();
    vi.unstubAllGlobals();
  });

  it("closes it and brings the page that was used last to the front", async () => {
    expect(await click(["last", "other"])).toEqual(["close", "focus last"]);
  });

  it("opens the page if it was closed", async () => {
    expect(await click([])).toEqual(["close", `open ${PAGE}`]);
  });
});
