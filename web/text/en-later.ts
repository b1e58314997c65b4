/**
 * The words of the parts that are fetched when they are first shown (see text/later.ts); the others are in en.ts.
 * A translation is a second file of this shape.
 */
export const enLater = {
  queue: {
    start: "Start",
    about: (duration: string) => `about ${duration}`,
    atSpeed: (pct: number) => `at ${pct} %`,
    earlier: (name: string) => `Move ${name} earlier`,
    later: (name: string) => `Move ${name} later`,
    drag: (name: string) => `Drag ${name} to its place, or press arrow up or down`,
    dragHint: "Drag, or arrow up and down",
    duplicate: (name: string) => `Once more: ${name}`,
    moveToPlotter: (name: string) => `Plotter for ${name}`,
    againNamed: (name: string) => `Put ${name} into the queue again`,
    more: (count: number) => `Show ${Math.min(count, 20)} more`,
    took: (duration: string) => `took ${duration}`,
    foretold: (duration: string) => `${duration} foretold`,
  },

  job: {
    left: (duration: string) => `${duration} left`,
    doneAt: (clock: string) => `done at ${clock}`,
    pause: "Pause",
    resume: "Resume",
    continue: "Continue",
    stop: "Stop",
    recover: "Go on from there",
    recoverHint: "Nothing is drawn until you press Resume. If the carriage was moved, set it home first.",
    confirmCancel: (name: string) => `Stop ${name}? The pen lifts and goes home. What is drawn stays drawn.`,
    keepPlotting: "Keep plotting",
    stopNow: "Stop at once",
    stopNowHint: "Stops where it is. Only cutting the motors’ power is quicker.",
    speedPct: "Speed now",
    speedPctHint: "Percent of the plot’s set speeds; takes effect within a second.",
    applyHeights: "Apply the pen and speed settings",
    place: (stroke: string, mm: string) => `At stroke ${stroke}, ${mm} mm along it`,
    placeMoves: "Move the place",
    strokeBack: "One stroke back",
    strokeOn: "One stroke on",
    mmBack: "10 mm back",
    mmOn: "10 mm on",
    checkPlace: "Walk there with the pen up",
  },

  penWait: {
    title: "Pen change",
    put: (pen: string) => `Put in the pen “${pen}”`,
    putForLayer: (layer: string) => `Put in the pen for “${layer}”`,
    layer: (layer: string) => `for the layer “${layer}”`,
    hint: "The pen is up and the carriage is home. Continue when the pen sits firmly.",
  },

  jog: {
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
  },

  moves: {
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
  },

  nudge: {
    title: "Pen heights now",
    up: "Up",
    down: "Down",
    less: (label: string) => `${label}: a little lower`,
    more: (label: string) => `${label}: a little higher`,
  },
};

export type LaterTexts = typeof enLater;
