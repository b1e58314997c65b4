/** The page without a server, served as static files, as on a site. */
import { existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import path from "node:path";
import { TEST_SITE } from "../../../scripts/setup.mjs";
import { FakeSerial } from "./fake-serial.js";
import { FAKE_SERIAL_SCRIPT } from "./fake-serial-script.js";

const TYPES: Readonly<Record<string, string>> = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
};

const FOLDER = path.join(TEST_SITE.folder, "app");

export interface StaticApp {
  readonly url: string;
  /** The board on the fake `navigator.serial` of all pages and workers. */
  readonly serial: FakeSerial;
  close(): Promise<void>;
}

export interface StaticAppOptions {
  /** Runs first in the host's worker. */
  readonly workerScript?: string;
}

/** `boardSpeed`: board seconds per second of the board on the serial port. */
export async function startStaticApp(
  boardSpeed = 1,
  { workerScript = "" }: StaticAppOptions = {},
): Promise<StaticApp> {
  const serial = new FakeSerial(boardSpeed);
  const server = createServer((request, response) => {
    const { pathname, searchParams } = new URL(request.url ?? "/", "http://localhost");
    if (pathname.startsWith("/fake-serial/")) {
      void serial.handle(pathname.slice("/fake-serial/".length), request, response);
      return;
    }
    // Answers late, to hold up a page's thread by a synchronous request.
    if (pathname === "/wait") {
      setTimeout(() => response.end(), 1_000 * Number(searchParams.get("s")));
      return;
    }
    const file = path.join(FOLDER, pathname === "/" ? "index.html" : pathname);
    if (!file.startsWith(FOLDER) || !existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, {
      "content-type": TYPES[path.extname(file)] ?? "application/octet-stream",
      // As strict as on a real site.
      "content-security-policy":
        "default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'",
    });
    // The page gets the fake port by Playwright; a worker can get it only with its file.
    if (path.basename(file).startsWith("host.worker-")) response.write(FAKE_SERIAL_SCRIPT + workerScript);
    response.end(readFileSync(file));
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  return {
    url: `http://127.0.0.1:${(server.address() as AddressInfo).port}`,
    serial,
    close: async () => {
      serial.close();
      server.closeAllConnections();
      await new Promise((resolve) => server.close(resolve));
    },
  };
}
