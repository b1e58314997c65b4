/** The page without a server, built and served as static files, as on a site. */
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import path from "node:path";
import { ROOT } from "../../scripts/setup.mjs";
import { FakeSerial } from "./fake-serial.js";
import { FAKE_SERIAL_SCRIPT } from "./fake-serial-script.js";
import { temporaryFolder } from "./server-process.js";

const TYPES: Readonly<Record<string, string>> = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
};

export interface StaticApp {
  readonly url: string;
  /** The board on the fake `navigator.serial` of all pages and workers. */
  readonly serial: FakeSerial;
  close(): Promise<void>;
}

/** Builds it into a folder of its own. */
export function buildStaticApp(): { readonly path: string; readonly remove: () => void } {
  const built = temporaryFolder("static-app");
  execFileSync(
    process.execPath,
    ["node_modules/vite/bin/vite.js", "build", "--config", "web/vite.config.ts", "--outDir", built.path],
    { cwd: ROOT, env: { ...process.env, VITE_BACKEND: "browser" }, stdio: "pipe" },
  );
  return built;
}

/** `boardSpeed`: board seconds per second of the board on the serial port. */
export async function startStaticApp(folder: string, boardSpeed = 1): Promise<StaticApp> {
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
    const file = path.join(folder, pathname === "/" ? "index.html" : pathname);
    if (!file.startsWith(folder) || !existsSync(file)) {
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
    if (path.basename(file).startsWith("host.worker-")) response.write(FAKE_SERIAL_SCRIPT);
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
