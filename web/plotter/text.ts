/** Words of the plotter's panel and the presets. */
export const plotterText = {
  title: "Plotter",
  virtual: "Virtual board: no plotter plugged in",
  virtualHint: "Plots run on a model of the board. Plug in a plotter and it is found by itself.",
  homeHint:
    "Home is where the carriage stood when the motors came on: there are no end switches. Move it to the corner by hand with the motors off.",
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
  connect: "Connect a plotter…",
  connectHint: "Plots run on a model of the board until you connect a plotter by USB.",
  log: "Save the log of the connection",
  held: "Paused",
  interrupted: "Interrupted",
  notHeard: "No word from it",
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

/** Words of the pen's heights, home and the first plot. */
export const penText = {
  up: "Pen up",
  down: "Pen down",
  motorsOff: "Motors off",
  home: "Home",
  touch: "Try",
  touchHint:
    "Put paper under the pen and lower this until the tip just marks. 100 % is Height up, 0 % Height down: find it again when you change them.",
  testLine: "Draw a test line",
  testLineHint: "A line of 2 cm, half a centimetre from where the carriage is",
  firstPlot: "First plot with this plotter",
  steps: {
    home: "Motors off, push the carriage into its corner, then Home.",
    heights: "Move the sliders until the pen is well clear of the paper when up, and draws when down.",
    mark: "Put paper under the pen and draw a line. Too thin or broken: lower Height down.",
    plot: "Press Plot.",
  },
  hide: "Don’t show these steps",
};

export const presetsText = {
  title: "Presets",
  hint: "Speeds, heights, pens and layers under a name, to come back to with one press.",
  name: "Name of this preset",
  save: "Keep",
  remove: (name: string) => `Forget ${name}`,
};
