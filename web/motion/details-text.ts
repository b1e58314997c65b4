/** Texts of the numbers behind a quality. */
export const detailsText = {
  plannedByController: "This plotter’s controller plans the motion by itself.",
  drawing: "Pen down",
  travelling: "Pen up",
  cornerHint:
    "How far the line may leave the drawing at corners and in tight curves. More is faster and softer.",
  jerkHint: "How fast the acceleration may change. Less is softer and slower.",
  axes: "Limits of one axis",
  axesHint:
    "For a plotter that is heavier along one axis, pen up and down. Empty: no limit besides those above.",
  noLimit: (label: string) => `${label}: no limit`,
  mode: "Corners",
  shaper: "Reduce ringing",
  shapers: {
    none: "Off",
    zv: "ZV, the shortest",
    mzv: "MZV",
    zvd: "ZVD",
    ei: "EI, the most tolerant",
  },
  ease: "Begin and end strokes slowly",
  fit: "Draw dense curves in long sweeps",
  sendAheadHint:
    "Before firmware 3 the board still plays this after an emergency stop. Less stops sooner, but then the pen may pause where this computer is busy.",
  fitHint: "Fewer, longer commands to the board, so that long curves run without stutter.",
};
