/** Texts of the pens and of lifting them. */
export const pensText = {
  title: "Pens",
  hint: "Name your pens and choose one for each layer. The plot stops where another pen is needed.",
  fromColors: "A pen for each colour",
  add: "Add a pen",
  newName: (number: number) => `Pen ${number}`,
  noColor: "Pen without a colour",
  name: "Name",
  color: "Colour",
  offsetHint:
    "Plot the mark with the first pen, then with this one. Enter how far its mark is from the first.",
  markCorner: "Corner of the mark",
  corners: {
    topLeft: "Top left",
    topRight: "Top right",
    bottomLeft: "Bottom left",
    bottomRight: "Bottom right",
  },
  plotMark: "Plot alignment mark with this pen",
  markName: (pen: string) => `Alignment mark, ${pen}`,
  edit: (name: string) => `Settings of the pen ${name}`,
  remove: (name: string) => `Remove the pen ${name}`,
  stops: "Stop for pens",
  stopModes: { pens: "Pen change", layers: "Each layer", never: "Never" },
  tones: {
    black: "Black",
    grey: "Grey",
    white: "White",
    dark: (tone: string) => `Dark ${tone.toLowerCase()}`,
    /** Hues, each up to an angle on the colour wheel. */
    hues: [
      [16, "Red"],
      [45, "Orange"],
      [70, "Yellow"],
      [165, "Green"],
      [200, "Turquoise"],
      [255, "Blue"],
      [290, "Violet"],
      [345, "Pink"],
      [361, "Red"],
    ] as readonly (readonly [upToDeg: number, tone: string])[],
  },
  showInPens: "Show the drawing in pen colours",
};

export const heightsText = {
  title: "Lifting the pen",
  gentle: "Lower the pen gently",
  sheet: {
    jobName: "Pen sheet",
    hint: "The times come from your plotter’s model. To check them, plot the pen sheet: each line waits less for the pen than the one above it. Find the lowest line that looks like the first: no tails, no missing beginnings, no missing dots.",
    plot: "Plot the pen sheet",
    plotting: "Plotting…",
    noRoom: (widthMm: number, heightMm: number) =>
      `The sheet needs ${widthMm} × ${heightMm} mm. Choose a larger paper first.`,
    lowest: "Lowest line that is right",
    notRead: "Not read from a sheet",
    line: (ms: number) => `${ms} ms`,
  },
  overlaps: {
    off: ["Off", "The carriage waits until the pen is all the way up or down."],
    safe: ["Safe", "The carriage moves while the tip is well clear of the paper, even if the pen is slow."],
    fast: ["Fast", "Fastest, for a pen with reliable lift times. If lines get tails, choose Safe."],
  },
  whereTouches: "Set the height at which the tip touches in the plotter’s panel: “Tip touches at”.",
};

/** Texts of what is offered after the first plot. */
export const tuningText = {
  title: "Next: faster plots",
  penHint: "In two minutes: how long your pen really takes to rise and fall.",
  ringingHint: "In three minutes: how your plotter swings. It then draws faster and more exactly.",
  hide: "Hide",
  hideHint: "Hide these measurements",
};
