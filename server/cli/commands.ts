/** All commands by name. Each command's module is loaded only when the command is used, to start quickly. */
import type { Declare } from "./options.js";

interface CliCommand {
  readonly name: string;
  readonly about: string;
  /** Shown in its help and in docs/cli.md; a test runs each of them. */
  readonly examples: readonly string[];
  readonly load: () => Promise<Declare>;
}

const hand = async (): Promise<typeof import("./hand-commands.js")> => import("./hand-commands.js");
const server = async (): Promise<typeof import("./service/server-commands.js")> =>
  import("./service/server-commands.js");
const queue = async (): Promise<typeof import("./client/queue-commands.js")> =>
  import("./client/queue-commands.js");
const job = async (): Promise<typeof import("./plot/job-commands.js")> => import("./plot/job-commands.js");
const list = async (): Promise<typeof import("./list-commands.js")> => import("./list-commands.js");

/** The command that runs if none is given. */
export const DEFAULT_COMMAND = "serve";

export const COMMANDS: readonly CliCommand[] = [
  {
    name: "serve",
    about: "serve the page and the queue (default)",
    examples: ["plotwright --port 9381", "plotwright serve --lan --device virtual"],
    load: async () => (await server()).declareServe,
  },
  {
    name: "plan",
    about: "show the time, distance and commands of a plot, without a board",
    examples: [
      "plotwright plan drawing.svg --paper A4 --margin 1cm",
      "plotwright plan drawing.svg --json",
      "plotwright plan - --commands -",
    ],
    load: async () => (await import("./plan/plan-command.js")).declarePlan,
  },
  {
    name: "plot",
    about: "plot drawings",
    examples: [
      "plotwright plot drawing.svg --speed 40 --pen-down 25",
      "plotwright plot drawing.svg other.svg --copies 2 --paper-s 30",
      "plotwright plot --resume",
    ],
    load: async () => (await import("./plot/plot.js")).declarePlot,
  },
  {
    name: "live",
    about: "draw points from stdin as they come: x y on each line, up lifts the pen",
    examples: ["plotwright live --speed 30", "plotwright live --device virtual"],
    load: async () => (await import("./live/live.js")).declareLive,
  },
  {
    name: "add",
    about: "put drawings into a running server's queue",
    examples: [
      "plotwright add drawing.svg --copies 3",
      "plotwright add drawing.svg --start",
      "plotwright add - --url http://127.0.0.1:9080",
    ],
    load: async () => (await queue()).declareAdd,
  },
  {
    name: "queue",
    about: "show a running server's queue",
    examples: ["plotwright queue", "plotwright queue --json"],
    load: async () => (await queue()).declareQueue,
  },
  {
    name: "start",
    about: "start a job of a running server",
    examples: ["plotwright start", "plotwright start drawing.svg --json"],
    load: async () => (await job()).declareStart,
  },
  {
    name: "pause",
    about: "pause the plot of a running server, with the pen up",
    examples: ["plotwright pause"],
    load: async () => (await job()).declarePause,
  },
  {
    name: "resume",
    about: "resume a paused job of a running server; an interrupted one is paused at first",
    examples: ["plotwright resume", "plotwright resume drawing.svg"],
    load: async () => (await job()).declareResume,
  },
  {
    name: "cancel",
    about: "cancel a job of a running server: the pen lifts and goes home",
    examples: ["plotwright cancel"],
    load: async () => (await job()).declareCancel,
  },
  {
    name: "remove",
    about: "remove a job from a running server",
    examples: ["plotwright remove drawing.svg"],
    load: async () => (await job()).declareRemove,
  },
  {
    name: "follow",
    about: "show the progress of a running server's plot until it ends",
    examples: ["plotwright follow", "plotwright follow drawing.svg --json"],
    load: async () => (await job()).declareFollow,
  },
  {
    name: "pen",
    about: "lift or lower the pen, or move it to a height",
    examples: ["plotwright pen up", "plotwright pen 40"],
    load: async () => (await hand()).declarePen,
  },
  {
    name: "home",
    about: "lift the pen and move to home; a NextDraw finds it with its switch",
    examples: ["plotwright home"],
    load: async () => (await hand()).declareHome,
  },
  {
    name: "jog",
    about: "move by a distance in mm, pen up",
    examples: ["plotwright jog 10 -5", "plotwright jog 1in 0"],
    load: async () => (await hand()).declareJog,
  },
  {
    name: "move-to",
    about: "move to a position in mm from home, pen up",
    examples: ["plotwright move-to 100 5cm --travel-speed 80"],
    load: async () => (await hand()).declareMoveTo,
  },
  {
    name: "set-home",
    about: "make the current position home",
    examples: ["plotwright set-home"],
    load: async () => (await hand()).declareSetHome,
  },
  {
    name: "align",
    about: "lift the pen and switch the motors off, to push the carriage home by hand",
    examples: ["plotwright align"],
    load: async () => (await hand()).declareAlign,
  },
  {
    name: "cycle-pen",
    about: "lower the pen and lift it again",
    examples: ["plotwright cycle-pen --pen-down 20"],
    load: async () => (await hand()).declareCyclePen,
  },
  {
    name: "test-patch",
    about: "draw a small pattern at the current position",
    examples: ["plotwright test-patch"],
    load: async () => (await hand()).declareTestPatch,
  },
  {
    name: "frame",
    about: "move around the edge of a drawing, pen up",
    examples: ["plotwright frame drawing.svg --paper A5"],
    load: async () => (await hand()).declareFrame,
  },
  {
    name: "raw",
    about: "send one line to the board",
    examples: ["plotwright raw QM"],
    load: async () => (await hand()).declareRaw,
  },
  {
    name: "info",
    about: "show the board and its firmware",
    examples: ["plotwright info --json"],
    load: async () => (await hand()).declareInfo,
  },
  {
    name: "ringing",
    about: "write the ringing sheet, which shows how the machine swings, or evaluate it",
    examples: [
      "plotwright ringing ringing.svg",
      "plotwright ringing --ripples-x 2,19.5 --ripples-y 3,18",
      "plotwright ringing check.svg --check --spring-x 15 --spring-y 25",
    ],
    load: async () => (await import("./ringing-command.js")).declareRinging,
  },
  {
    name: "pen-times",
    about:
      "write the pen sheet, which shows how long the carriage must wait for the pen, or store what it shows",
    examples: ["plotwright pen-times pen-times.svg", "plotwright pen-times --right 20"],
    load: async () => (await import("./pen-times-command.js")).declarePenTimes,
  },
  {
    name: "devices",
    about: "list the boards that are plugged in, and other devices that may be one",
    examples: ["plotwright devices --ask", "plotwright devices --json"],
    load: async () => (await list()).declareDevices,
  },
  {
    name: "machines",
    about: "list the plotter models, including your own",
    examples: ["plotwright machines"],
    load: async () => (await list()).declareMachines,
  },
  {
    name: "settings",
    about: "show and keep settings: for all drawings, or under a name",
    examples: [
      "plotwright settings",
      "plotwright settings set paper A3",
      "plotwright settings save Fineliner --speed 40 --pen-down 25",
      "plotwright settings presets",
    ],
    load: async () => (await import("./settings-command.js")).declareSettings,
  },
  {
    name: "inkscape",
    about: "add an extension to Inkscape that sends drawings to a running server",
    examples: ["plotwright inkscape install", "plotwright inkscape uninstall"],
    load: async () => (await import("./inkscape-command.js")).declareInkscape,
  },
  {
    name: "mcp",
    about: "let an AI assistant plan drawings and use a running server's queue (Model Context Protocol)",
    examples: ["plotwright mcp", "plotwright mcp --url http://127.0.0.1:9080"],
    load: async () => (await import("./mcp/mcp-command.js")).declareMcp,
  },
  {
    name: "completion",
    about: "print a script that completes commands, options and their values in your shell",
    examples: ["plotwright completion bash"],
    load: async () => (await import("./completion.js")).declareCompletion,
  },
  {
    name: "service",
    about: "run the server as a service of systemd (Linux) or launchd (macOS)",
    examples: ["plotwright service install --print -- --port 9381", "plotwright service status"],
    load: async () => (await server()).declareService,
  },
  {
    name: "logs",
    about: "print the logs, for a support request",
    examples: ["plotwright logs --out plotwright.log"],
    load: async () => (await server()).declareLogs,
  },
  {
    name: "board",
    about: "run a virtual board that other programs can drive",
    examples: ["plotwright board --pty /tmp/plotter --speed 10 --svg drawn.svg"],
    load: async () => (await import("./board/board.js")).declareBoard,
  },
];
