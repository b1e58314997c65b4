/** A virtual Grbl behind a TCP port of this computer. */
import { createServer, type AddressInfo, type Socket } from "node:net";
import { nodeClock } from "../../../server/serial/node-clock.js";
import { VirtualGrbl } from "../../../src/drivers/grbl/virtual/virtual-grbl.js";
import type { VirtualGrblOptions } from "../../../src/drivers/grbl/virtual/virtual-settings.js";
import { GRBL } from "../machines/machine.js";

export async function networkGrbl(options: VirtualGrblOptions, speed: number) {
  const board = new VirtualGrbl({ clock: nodeClock, speed, machine: GRBL }, options);
  const sockets = new Set<Socket>();
  const server = createServer((socket) => {
    sockets.add(socket);
    const line = board.transport();
    line.onData((bytes) => socket.write(bytes));
    socket.on("data", (bytes) => void line.write(bytes));
    socket.on("error", () => undefined);
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  const { port } = server.address() as AddressInfo;
  const close = (): Promise<unknown> => {
    for (const socket of sockets) socket.destroy();
    board.close();
    return new Promise((resolve) => server.close(resolve));
  };
  return { board, sockets, device: `tcp://127.0.0.1:${port}`, close };
}
