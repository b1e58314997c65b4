/** `plotwright mcp`: an assistant starts it, and speaks the Model Context Protocol over its stdin and stdout. */
import { accessOf, addServer } from "../client/server-client.js";
import type { Declare } from "../options.js";

export const declareMcp: Declare = (command, { io, version }) => {
  addServer(command).action(async (options: Parameters<typeof accessOf>[0]) => {
    const [{ StdioServerTransport }, { mcpServer }] = await Promise.all([
      import("@modelcontextprotocol/sdk/server/stdio.js"),
      import("./tools.js"),
    ]);
    // Found anew for each request: the server may be started after the assistant.
    const server = mcpServer(() => accessOf(options), version);
    const ended = new Promise<void>((resolve) => {
      io.onInterrupt(() => resolve());
      process.stdin.once("end", resolve);
      process.stdin.once("close", resolve);
    });
    await server.connect(new StdioServerTransport());
    io.err("An assistant can use plotwright now, by the Model Context Protocol. Ctrl-C ends it.\n");
    await ended;
    await server.close();
  });
};
