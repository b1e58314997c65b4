/** Words of the page's frame: header, tabs, strips over the paper, keys. */
export const historyText = {
  undo: "Undo",
  redo: "Redo",
};

export const skipText = {
  toPlot: "Skip to Plot",
  toWatch: "Skip to the plot’s buttons",
};

export const tabsText = {
  label: "Panels",
  setup: "Set up",
  queue: "Queue",
  machine: "Plotter",
};

export const studioLink = "Sharing, plotters, camera";

export const viewText = {
  label: "View",
  prepare: "Prepare",
  watch: "Watch",
};

export const pairingText = {
  title: "Pair this device",
  why: "This device is new to this plotter’s computer. Let it in once, and it is let in from then on.",
  steps: [
    "On the computer that the plotter is plugged into, open plotwright and press “Sharing, plotters, camera”.",
    "Scan the code there with this device’s camera, or open the link on it.",
  ],
  terminal: "The link is also printed in the window in which plotwright was started.",
  retry: "Try again",
};

export const takeOverText = {
  title: "Another browser operates",
  operating: (name: string | null) =>
    name === null ? "Another browser has the plotter in hand." : `${name} has the plotter in hand.`,
  hint: "Only one operates at a time. If you take over, the other one watches until it takes over again.",
  takeOver: "Take over",
  keep: "Leave it",
};

export const themeText = {
  label: "Appearance",
  auto: "As the system",
  light: "Light",
  dark: "Dark",
};

export const stripsText = {
  watching: (operator: string | null) =>
    operator === null
      ? "This device watches. It may stop a plot, nothing else."
      : `${operator} is operating; this device watches. It may stop a plot, nothing else.`,
  operating: (name: string) => `${name} is operating.`,
  takeOver: "Take over",
  read: "I have read it",
  outdated: "plotwright was brought up to date on the server.",
  offline:
    "plotwright’s server can’t be reached: switched off, or this device has no network. Drawings can be laid out meanwhile.",
};

export const shortcutsText = {
  title: "Keys",
  play: "Play the plot, or stop",
  travel: "Show pen-up moves",
  graph: "Show speed over time",
  pause: "Pause the plotter, or resume",
  fields: "In a number: arrow up and down step it, with Shift ten times as far.",
};
