/** Serves a folder as a web host does, below a given path, with 404.html for unknown addresses. */
import { once } from "node:events";
import type { AddressInfo } from "node:net";
import express from "express";

export interface StaticSite {
  /** Ends with "/". */
  readonly url: string;
  close(): Promise<void>;
}

export async function serveFolder(folder: string, base: string): Promise<StaticSite> {
  const app = express();
  app.use(base, express.static(folder));
  app.use((_request, response) => {
    response.status(404).sendFile("404.html", { root: folder });
  });
  const server = app.listen(0, "127.0.0.1");
  await once(server, "listening");
  const { port } = server.address() as AddressInfo;
  return {
    url: `http://127.0.0.1:${port}${base}`,
    close: async () => {
      server.closeAllConnections();
      server.close();
      await once(server, "close");
    },
  };
}
