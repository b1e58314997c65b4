/** All commands by name. What one is made of is loaded only when it is asked for: nobody waits for the others. */
import type { Declare } from "./options.js";

export interface CliCommand {
  readonly name: string;
  readonly about: string;
  readonly load: () => Promise<Declare>;
}

const hand = async (): Promise<typeof import("./hand-commands.js")> => import("./hand-commands.js");
const server = async (): Promise<typeof import("./server-commands.js")> => import("./server-commands.js");
const queue = async (): Promise<typeof import("./queue-commands.js")> => import("./queue-commands.js");
const list = async (): Promise<typeof import("./list-commands.js")> => import("./list-commands.js");

/** What it does when no command is named. */
export const DEFAULT_COMMAND = "serve";

export const COMMANDS: readonly CliCommand[] = [
  {
    name: "serve",
    about: "serve the page and the queue (default)",
    load: async () => (await server()).declareServe,
  },
  {
    name: "plan",
    about: "show what a plot would be, without a board",
    load: async () => (await import("./plan-command.js")).declarePlan,
  },
  {
    name: "plot",
    about: "plot drawings",
    load: async () => (await import("./plot-command.js")).declarePlot,
  },
  {
    name: "add",
    about: "put drawings into a running server's queue",
    load: async () => (await queue()).declareAdd,
  },
  {
    name: "queue",
    about: "show a running server's queue",
    load: async () => (await queue()).declareQueue,
  },
  {
    name: "pen",
    about: "lift or lower the pen, or move it to a height",
    load: async () => (await hand()).declarePen,
  },
  { name: "home", about: "lift the pen and walk home", load: async () => (await hand()).declareHome },
  { name: "jog", about: "move by so many mm, pen up", load: async () => (await hand()).declareJog },
  {
    name: "walk",
    about: "go to a place in mm from home, pen up",
    load: async () => (await hand()).declareWalk,
  },
  {
    name: "set-home",
    about: "make home where the carriage stands",
    load: async () => (await hand()).declareSetHome,
  },
  {
    name: "align",
    about: "lift the pen and switch the motors off, to put the carriage to home by hand",
    load: async () => (await hand()).declareAlign,
  },
  {
    name: "cycle-pen",
    about: "lower the pen and lift it again",
    load: async () => (await hand()).declareCyclePen,
  },
  {
    name: "test-patch",
    about: "draw a small pattern where the carriage stands",
    load: async () => (await hand()).declareTestPatch,
  },
  { name: "frame", about: "go around a drawing, pen up", load: async () => (await hand()).declareFrame },
  { name: "raw", about: "send one line to the board", load: async () => (await hand()).declareRaw },
  { name: "info", about: "tell what the board says of itself", load: async () => (await hand()).declareInfo },
  {
    name: "devices",
    about: "list the boards that are plugged in",
    load: async () => (await list()).declareDevices,
  },
  {
    name: "machines",
    about: "list the plotter models, yours too",
    load: async () => (await list()).declareMachines,
  },
  {
    name: "service",
    about: "keep the server running by systemd",
    load: async () => (await server()).declareService,
  },
  {
    name: "logs",
    about: "print what happened, to be sent to whoever helps",
    load: async () => (await server()).declareLogs,
  },
  {
    name: "board",
    about: "be a virtual board that other programs can drive",
    load: async () => (await import("./board-command.js")).declareBoard,
  },
];
