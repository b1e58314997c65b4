/** Texts of the ringing sheets. */
export const ringingText = {
  title: "Measure ringing",
  intro:
    "After a sharp corner, the pen keeps vibrating for a moment. This is called ringing. Once plotwright knows the frequency, it shapes the moves to cancel the ringing, so it can plot faster.",
  virtualHint:
    "No plotter is connected, so there is no sheet to read. Below the preview, “Pen (simulated)” shows the line a vibrating pen would draw.",
  parts: "Sheets",
  partNames: { count: "Count ripples", pick: "Pick by eye" },
  jobName: "Ringing sheet",
  plotTitle: "1. Plot the strip",
  plotHint: (width: number, height: number) =>
    `Put in a fine pen, and paper with ${width} × ${height} mm free in the middle. The plotter draws six fast lines with sharp bends, in a few seconds. Your open drawing stays as it is.`,
  plot: "Plot the ringing sheet",
  noRoom: (width: number, height: number) =>
    `The sheet needs ${width} × ${height} mm. Choose a larger paper first.`,
  plotting: "Plotting…",
  countTitle: "2. Count the ripples",
  countHint:
    "Take the clearest of the three lines. Look at its straight part, which begins at the bend, in good light or on a photo. Count ripples from crest to crest on the outer side, and measure from the first crest to the last one. The pictures show what to count.",
  axes: {
    x: { legend: "Side-to-side ringing (x)", hint: "On a vertical line." },
    y: { legend: "Front-to-back ringing (y)", hint: "On a horizontal line." },
  },
  fields: { ripples: "Ripples", lengthMm: "Their length" },
  result: (hz: string) => `${hz} Hz`,
  noResult: "not counted yet",
  dampingTitle: "3. How quickly do they fade?",
  dampingHint: "Compare a horizontal line with these. If you can’t decide, leave it.",
  dampings: ["Very slowly", "Slowly", "Quickly", "At once"],
  gainTitle: "What you gain",
  gainHint: "A star, two circles and a zigzag, calculated for your plotter with a pen that swings like this:",
  gainNames: {
    before: "As before",
    fine: "Fine",
    normal: "Normal",
    fast: "Fast",
  },
  gainHeads: { quality: "Quality", time: "Pen down", off: "Max. distance from the line" },
  seconds: (s: string, change: string) => (change === "" ? `${s} s` : `${s} s (${change})`),
  save: "Save for this plotter",
  saved: (x: string, y: string) => `Saved: ${x} Hz along x, ${y} Hz along y.`,
  pickTitle: "Plot the second sheet",
  pickHint:
    "One line is drawn without shaping, and five are shaped for slightly different frequencies. Click the line that is straightest after its corners.",
  pickNeeds: "Count the ripples first. This sheet then finds the best value near that.",
  plotChecks: "Plot the six lines",
  plottingCheck: (number: number, count: number) => `Plotting line ${number} of ${count}…`,
  stopped: "The lines after this one were not plotted.",
  checkJobName: (factor: number | null) => `Ringing, ${factor === null ? "not shaped" : `× ${factor}`}`,
  unshaped: "Not shaped",
  shapedFor: (x: string, y: string) => `${x} / ${y} Hz`,
  picks: "The straightest line",
  unshapedHint: "If this line is the straightest, count the ripples again: the frequencies are far off.",
};
