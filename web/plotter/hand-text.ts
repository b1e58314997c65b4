/** Words of the moves by hand. */
export const jogText = {
  title: "Jog pad",
  step: "Step",
  home: "Walk home",
  hint: "With a button of the pad in focus, the arrow keys move too.",
  way: (way: string, step: string) => `${way} by ${step} mm`,
  ways: {
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
  heldOff: "A plot has the plotter. Moves by hand come back when it ends.",
  walkX: "From home, right",
  walkY: "From home, down",
  walk: "Walk there",
  setHome: "Set home here",
  setHomeHint: "This place is 0, 0 from now on",
  cyclePen: "Cycle the pen",
  cyclePenHint: "Pen down and up again, to see that it moves freely",
  frame: "Trace the frame",
  frameHint: "Around what will be drawn, with the pen up, to see that the paper lies right",
  testPatch: "Plot a test patch",
  testPatchHint: "A few small lines and circles where the carriage stands, with the settings of now",
};

export const nudgeText = {
  title: "Pen heights now",
  up: "Height up",
  down: "Height down",
  less: (label: string) => `${label}: a little lower`,
  more: (label: string) => `${label}: a little higher`,
};
