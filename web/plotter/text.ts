/** Texts of the plotter's panel and the presets. */
export const plotterText = {
  title: "Plotter",
  virtual: "Virtual plotter: none is plugged in",
  virtualHint: "Plots run on a virtual plotter, not on paper. Plug in a plotter, then press Find plotter.",
  homeHint:
    "Home is where the carriage was when the motors were switched on, because this plotter has no limit switches. With the motors off, push it into the corner by hand.",
  findsHomeHint:
    "Home is the plotter’s corner. It finds that by itself with its switch: when you press Home, and before the first move after its motors were off.",
  position: "Pen at",
  unknown: "not known",
  pen: "Pen",
  up: "up",
  down: "down",
  goingUp: "going up",
  goingDown: "going down",
  motors: "Motors",
  on: "on",
  off: "off",
  firmware: "Firmware",
  which: "Send to",
  model: "Model",
  more: "Model and position",
  moves: "Move by hand",
  setUp: "Set up a plotter…",
  profiles: "Machines…",
  ringing: "Measure ringing…",
  console: "Console",
  rest: "Plotter set-up",
  connect: "Connect a plotter…",
  connectHint: "Plots run on a virtual plotter, not on paper, until you connect a plotter by USB.",
  log: "Save the connection log",
  held: "Paused",
  stopped: "Stopped",
  interrupted: "Interrupted",
  notHeard: "No connection",
  moving: "Moving",
  waitsForPen: (pen: string) => `Waits for the pen “${pen}”`,
  waitsForLayer: (layer: string) => `Waits for the pen for “${layer}”`,
  jobState: (state: string, job: string) => `${state}: ${job}`,
  connection: {
    absent: "Not connected",
    connecting: "Connecting…",
    idle: "Ready",
    busy: "Plotting",
    fault: "Needs attention",
  },
  server: {
    connecting: "Connecting to plotwright…",
    lost: "The server can’t be reached. Trying again…",
  },
};

/** Texts of the pen's heights and home. */
export const penText = {
  up: "Pen up",
  down: "Pen down",
  motorsOff: "Motors off",
  stop: "Stop",
  home: "Home",
  touch: "Try",
  touchHint:
    "Put paper under the pen and lower this until the tip just marks it. 100 % is Height up, 0 % is Height down: set it again when you change them.",
  testLine: "Draw a test line",
  testLineHint: "A 2 cm line, half a centimetre from the carriage",
};

/** Why the plotter can't be moved now. */
export const whyNoMoveText = {
  absent: "No plotter is connected.",
  connecting: "The plotter is being connected.",
  busy: "The plotter is moving.",
  fault: "The plotter needs attention.",
  still: "No move by hand is under way.",
  nothingDrawn: "There is no drawing on the paper.",
  oneSheet: "Choose one of the sheets first (Paper, Over several sheets).",
};

export const presetsText = {
  title: "Presets",
  hint: "Save speeds, heights, pens and layers under a name, and apply them with one press.",
  name: "Name of this preset",
  save: "Save",
  remove: (name: string) => `Remove ${name}`,
};
