/** The HTTP server over a temporary folder, with a led plotter: everything real but threads and board. */
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { prepareDataDir } from "../../../server/data-dir.js";
import { apiMounts, createApp, type AppParts } from "../../../server/http/app.js";
import { EventHub } from "../../../server/http/events.js";
import { MachineFiles } from "../../../server/machines/machine-files.js";
import { DrawingFiles } from "../../../server/queue/drawing-files.js";
import { JobQueue } from "../../../server/queue/job-queue.js";
import type { Planning } from "../../../server/queue/queue-parts.js";
import { Store } from "../../../server/queue/store.js";
import { Access } from "../../../server/security/access.js";
import { LED_PLANNING, LedPlotter } from "./fakes.js";

export interface TestApp {
  readonly url: string;
  readonly plotter: LedPlotter;
  readonly queue: JobQueue;
  readonly store: Store;
  readonly access: Access;
  readonly logged: string[];
  /** "method path" of every route below /api/v1. */
  routes(): string[];
  drawingsOnDisk(): string[];
  close(): Promise<void>;
}

export async function startApp(
  options: {
    readonly planning?: Planning;
    readonly maxUploadBytes?: number;
    readonly trustsLoopback?: boolean;
  } = {},
): Promise<TestApp> {
  const dir = mkdtempSync(join(tmpdir(), "plotwright-app-"));
  prepareDataDir(dir);
  const store = Store.open(dir);
  const maxUploadBytes = options.maxUploadBytes ?? 3_000_000;
  const files = new DrawingFiles(dir, maxUploadBytes);
  const plotter = new LedPlotter();
  const plotters = new Map([[plotter.id, plotter]]);
  const hub = new EventHub();
  const queue = new JobQueue({
    store,
    files,
    planning: options.planning ?? LED_PLANNING,
    plotters,
    announce: (event) => hub.announce(event),
    nowIso: () => new Date().toISOString(),
  });
  const logged: string[] = [];
  const access = new Access(store, { trustsLoopback: options.trustsLoopback });
  access.onRevoke(() => hub.dropAll());
  const parts: AppParts = {
    version: "0.0.0",
    queue,
    files,
    plotters,
    hub,
    machines: new MachineFiles(dir),
    allowedHosts: ["plotter.lan"],
    webDir: join(dir, "web"),
    samplesDir: new URL("../../../samples", import.meta.url).pathname,
    access,
    log: (line) => logged.push(line),
  };
  const app = createApp(parts);
  const http: Server = createServer(app);
  await new Promise<void>((resolve) => http.listen(0, "127.0.0.1", resolve));
  return {
    url: `http://127.0.0.1:${(http.address() as AddressInfo).port}`,
    plotter,
    queue,
    store,
    access,
    routes: () =>
      apiMounts(parts).flatMap(([mount, router]) =>
        router.stack.flatMap(({ route }) =>
          (route?.stack ?? []).map(
            ({ method }) => `${method} ${mount}${route?.path === "/" ? "" : route?.path}`,
          ),
        ),
      ),
    logged,
    drawingsOnDisk: () => readdirSync(join(dir, "drawings")),
    close: async () => {
      hub.close();
      http.closeAllConnections();
      await new Promise((resolve) => http.close(resolve));
      await queue.close();
      store.close();
      rmSync(dir, { recursive: true, force: true });
    },
  };
}
