/** Texts of the page's frame: header, rail, messages over the paper, keyboard shortcuts. */
export const historyText = {
  undo: "Undo",
  redo: "Redo",
  nothingToUndo: "Nothing was changed yet.",
  nothingToRedo: "Nothing was undone.",
};

export const skipText = {
  toPlot: "Skip to Plot",
  toWatch: "Skip to the plot’s buttons",
};

export const railText = {
  label: "Panels",
  close: "Close the panel",
  panel: (name: string) => `${name} panel`,
  camera: "Camera",
  panels: {
    drawing: "Drawing",
    paper: "Paper",
    layers: "Layers",
    lines: "Lines",
    speed: "Speed",
    plotter: "Plotter",
    queue: "Queue",
  },
};

export const searchLabel = "Search for anything";

export const sharingLink = "Sharing, plotters, camera";

export const viewText = {
  label: "View",
  prepare: "Prepare",
  watch: "Watch",
  show: { prepare: "Show Prepare", watch: "Show Watch" },
  isShown: "It is shown already.",
  gallery: "Gallery",
};

export const pairingText = {
  title: "Pair this device",
  why: "The plotter’s computer does not know this device yet. Pair it once, and it stays paired.",
  steps: [
    "On the computer that the plotter is plugged into, open plotwright and press “Sharing, plotters, camera”.",
    "Scan the code there with this device’s camera, or open the link on this device.",
  ],
  terminal: "The link is also printed in the window in which plotwright was started.",
  retry: "Try again",
};

export const takeOverText = {
  title: "Another page is operating",
  operating: (name: string | null) =>
    name === null ? "Another page is operating the plotter." : `${name} is operating the plotter.`,
  hint: "Only one page operates at a time. If you take over, the other one can only watch until it takes over again.",
  takeOver: "Take over",
  keep: "Not now",
};

export const themeText = {
  label: "Appearance",
  auto: "Same as system",
  light: "Light",
  dark: "Dark",
};

export const stripsText = {
  watching: (operator: string | null) =>
    operator === null
      ? "This device can watch and stop a plot, nothing else."
      : `${operator} is operating. This device can watch and stop a plot, nothing else.`,
  submitting: "This device can add drawings to the queue. Another device starts the plots.",
  operating: (name: string) => `${name} is operating.`,
  takeOver: "Take over",
  read: "Dismiss",
  outdated: "plotwright was updated.",
  offline:
    "plotwright’s server can’t be reached: it is switched off, or this device has no network. You can still lay out drawings.",
};

export const shortcutsText = {
  title: "Keyboard shortcuts",
  fields: "In a number field, the up and down arrows change the number; with Shift, ten times as much.",
};

/** Texts of the dialog about plotwright. */
export const aboutText = {
  title: "About plotwright",
  what: "plotwright: free software for pen plotters, under the MIT licence.",
  whatVersion: (version: string) =>
    `plotwright ${version}: free software for pen plotters, under the MIT licence.`,
  licences: "It uses software by others, under these licences.",
  licencesLabel: "Licences",
  loading: "Fetching the licences…",
  absent: "The licences could not be fetched. They are in the file licences.txt of the installed page.",
};
