/** Words of the numbers behind a quality. */
export const detailsText = {
  drawing: "Pen down",
  travelling: "Pen up",
  cornerHint:
    "How far the line may leave the drawing at corners and in tight curves. More is faster and softer.",
  jerkHint: "How fast the acceleration may change. Less is softer and slower.",
  mode: "Corners",
  modes: {
    junction: {
      name: "Exact",
      hint: "Slows down for every corner and turns on the point. The line is exactly the file’s.",
    },
    blend: {
      name: "Rounded",
      hint: "Sweeps through corners on a tiny curve: quicker, quieter, and the pen never jerks.",
    },
    scurve: {
      name: "Gentle",
      hint: "As rounded, and speeds up and slows down softly too. Kindest to brush pens and tall machines.",
    },
  },
  shaper: "Against swinging",
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
