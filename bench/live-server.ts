/** The server of bench/live.bench.ts. Says its address, and to each message the most memory since the message before it. */
import { createServer } from "../server/index.js";

export type FromServer = { readonly url: string } | { readonly mostBytes: number };

const SAMPLE_MS = 100;

const [, , dataDir, virtualSpeed] = process.argv;
const server = await createServer({
  port: 0,
  device: "virtual",
  virtualSpeed: Number(virtualSpeed),
  ...(dataDir !== undefined && { dataDir }),
});
let mostBytes = 0;
setInterval(() => {
  mostBytes = Math.max(mostBytes, process.memoryUsage.rss());
}, SAMPLE_MS);

const say = (message: FromServer): void => void process.send?.(message);
process.on("message", () => {
  say({ mostBytes });
  mostBytes = 0;
});
process.on("disconnect", () => process.exit());
say({ url: server.url });
