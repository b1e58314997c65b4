/** Texts of the steps to the first plot. */
export const guideText = {
  firstPlot: "First plot with this plotter",
  steps: {
    findsHome: "Clear its way. Home finds the corner.",
    home: "Motors off. Push the carriage by hand into its home corner.",
    homeOfArm: "Motors off. Push the carriage by hand into its home corner: at the back, on the left.",
    heights: "Move the sliders until the pen is well clear of the paper when up, and draws when down.",
    mark: "Put paper under the pen and draw a line. Too thin or broken: lower Height down.",
  },
  whichPlotter: "Which plotter is this?",
  allModels: "All models",
  chooseModel: "Choose…",
  inCorner: "The carriage is in its corner",
  modelNamed: (name: string) => `It is a ${name}`,
  otherModel: "Another model…",
  homeDone: "The carriage is home.",
  homeAgain: "Home again…",
  plotStep: "Press Plot.",
  drawingStep: "Drop a drawing on the sheet, or choose a sample. Then press Plot.",
  hide: "Hide",
  hideHint: "Hide these steps",
};
