/** Texts of the moves by hand. */
export const jogText = {
  title: "Jog pad",
  step: "Step",
  home: "Go home",
  hint: "When a button of the pad has the focus, the arrow keys move too.",
  by: (direction: string, step: string) => `${direction} by ${step} mm`,
  directions: {
    upLeft: "Away and left",
    up: "Away",
    upRight: "Away and right",
    left: "Left",
    home: "Home",
    right: "Right",
    downLeft: "Nearer and left",
    down: "Nearer",
    downRight: "Nearer and right",
  },
};

export const movesText = {
  heldOff: "A plot is running. You can move by hand again when it ends.",
  moveToX: "From home, right",
  moveToY: "From home, down",
  moveTo: "Go there",
  setHome: "Set home here",
  setHomeHint: "Makes this position 0, 0",
  cyclePen: "Cycle the pen",
  cyclePenHint: "Pen down and up again, to check that it moves freely",
  frame: "Trace the frame",
  frameHint: "Goes around the drawing with the pen up, to check the position of the paper",
  testPatch: "Plot a test patch",
  testPatchHint: "A few small lines and circles where the carriage is, with the current settings",
};

export const nudgeText = {
  title: "Pen heights now",
  up: "Height up",
  down: "Height down",
  less: (label: string) => `${label}: a little lower`,
  more: (label: string) => `${label}: a little higher`,
  keep: (label: string, pct: string) => `${label}: keep ${pct}\u202f% from now on?`,
  keepIt: "Keep",
};
