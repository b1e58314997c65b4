/** Connects to an EiBotBoard, or simulates one. */
import type { Driver } from "../driver.js";
import { askBoard, connectBoard } from "./machine/connection.js";
import { EbbMachine } from "./machine/ebb-machine.js";
import { bench } from "./virtual/bench.js";
import { VirtualBoard } from "./virtual/virtual-board.js";

export const driver: Driver = {
  ask: askBoard,
  identify: async (transport, options) =>
    new EbbMachine(await connectBoard(transport, options), options.events),
  virtualMachine: (options) => new VirtualBoard({ ...options, servo: {} }),
  bench,
};
