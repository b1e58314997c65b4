/** The clock of this computer, and its serial ports and network, for the host. */
import type { OpenSocket } from "../../host/handle/live-socket.js";
import type { ClockAndPorts } from "../../host/handle/own-plotter.js";
import { findBoards } from "../serial/find-boards.js";
import { nodeClock } from "../serial/node-clock.js";
import { openSerial } from "../serial/serial-transport.js";
import { openTcp, tcpAddress } from "../serial/tcp-transport.js";
import type { Transport } from "../../src/index.js";

export const NODE_PARTS: ClockAndPorts = {
  clock: nodeClock,
  devices: { find: findBoards, open: openDevice },
};

/** A serial port by its path, or a machine on the network by its address. */
async function openDevice(device: string): Promise<Transport> {
  const address = tcpAddress(device);
  return address ? openTcp(device, address) : openSerial(device);
}

/** Node 20 has no WebSocket of its own. */
export const openSocket: OpenSocket = async (address, protocols) => {
  const { WebSocket } = await import("ws");
  return new WebSocket(address, protocols);
};
