/** Pages of a server that only lets paired devices in (`--pair-always`), each in a browser context of its own. */
import type { Browser, Page, ViewportSize } from "playwright-core";
import { vi } from "vitest";
import type { Role } from "../../../src/schema/index.js";
import type { ServerProcess } from "../processes/server-process.js";
import { PLAIN } from "./browser.js";

/** Opens the page by the link for that role, which the server prints. */
export async function pairedPage(
  browser: Browser,
  server: ServerProcess,
  role: Role,
  viewport: ViewportSize,
): Promise<Page> {
  const link = await vi.waitFor(() => printedLink(server, role), { timeout: 60_000 });
  const context = await browser.newContext({ ...PLAIN, viewport });
  const page = await context.newPage();
  await page.goto(`${server.url}${link}`);
  await page.waitForURL(`${server.url}/`);
  return page;
}

function printedLink(server: ServerProcess, role: Role): string {
  const link = new RegExp(`to ${role} +http\\S+(/pair\\?token=[\\w-]+)`).exec(server.output())?.[1];
  if (link === undefined) throw new Error(`no link to ${role}: ${server.output()}`);
  return link;
}
