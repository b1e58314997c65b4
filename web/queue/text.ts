/** Words of the plot bar, the queue and the history. */
export const plotText = {
  planning: "Planning…",
  time: "Time",
  distance: "Pen down",
  travel: "Pen up",
  lifts: "Pen lifts",
  strokes: "Strokes",
  plot: "Plot",
  addToQueue: "Add to queue",
  queueBusy: "The plotter is busy: this drawing goes to the end of the queue.",
  copies: "Copies",
  addCopies: (count: number) => `Add ${count} to queue`,
  sending: "Sending it; the server works out every move. A large drawing takes a while.",
  saveToJob: (name: string) => `Save the changes to ${name} in the queue`,
  outside: (count: number, number: string) =>
    count === 1
      ? "1 line is outside the margins and will not be drawn."
      : `${number} lines are outside the margins and will not be drawn.`,
  cutOff: (count: number, number: string) =>
    count === 1 ? "1 line is cut off at the margins." : `${number} lines are cut off at the margins.`,
  needsDrawing: "Choose a drawing, or try a sample.",
  needsPlotter: "No plotter is connected. The queue waits for one.",
};

export const queueText = {
  title: "Queue",
  empty: "The queue is empty.",
  last: (name: string, state: string, when: string) => `Last: ${name}, ${state.toLowerCase()} ${when}.`,
  history: "History",
  historyEmpty: "Finished plots are listed here.",
  startNamed: (name: string) => `Start ${name}`,
  cancel: "Cancel",
  between: "After a plot",
  wait: "Wait for paper",
  runOn: "Run on",
  removeNamed: (name: string) => `Remove ${name}`,
  openNamed: (name: string) => `Lay ${name} on the paper`,
  progress: (name: string) => `Progress of ${name}`,
  total: (count: number, duration: string) => `${count === 1 ? "1 plot" : `${count} plots`}, ${duration}`,
  totalDoneAt: (total: string, clock: string) => `${total}: done at ${clock}`,
  waitsForPen: "Pen change",
  states: {
    queued: "Waiting",
    plotting: "Plotting",
    paused: "Paused",
    interrupted: "Interrupted",
    done: "Done",
    failed: "Failed",
    cancelled: "Cancelled",
  },
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
};

export const notifyText = {
  waits: (name: string, what: string) => `${name}: ${what}.`,
  ask: "Tell me when a plot ends",
  asked: "You are told when a plot ends or fails",
  denied: "The browser forbids notifications for this page. Allow them in its settings.",
  done: (name: string) => `${name} is plotted.`,
  failed: (name: string) => `${name} failed. Have a look at the queue.`,
  interrupted: (name: string) => `${name} was interrupted. It can go on from there.`,
};

export const jobText = {
  left: (duration: string) => `${duration} left`,
  doneAt: (clock: string) => `done at ${clock}`,
  pause: "Pause",
  resume: "Resume",
  continue: "Continue",
  stop: "Stop",
  recover: "Go on from there",
  recoverHint:
    "It comes back paused: nothing is drawn until you press Resume. If the carriage was moved, set it home first.",
  confirmCancel: (name: string) => `Stop “${name}”? The pen lifts and goes home. What is drawn stays drawn.`,
  cancelPlot: "Cancel the plot",
  keepPlotting: "Keep plotting",
  stopNow: "Stop at once",
  stopNowHint: (ms: number | null) =>
    `Stops where it is${ms === null ? "" : `: with this plotter’s firmware after ${(ms / 1_000).toFixed(2)} s at most`}. Only cutting the motors’ power is quicker.`,
  speedPct: "Speed now",
  speedPctHint: "Percent of the plot’s set speeds; takes effect within a second.",
  applyHeights: "Apply pen and speed as they are set now",
  place: (stroke: string, mm: string) => `At stroke ${stroke}, ${mm} mm along it`,
  placeMoves: "Move the place",
  strokeBack: "One stroke back",
  strokeOn: "One stroke on",
  mmBack: "10 mm back",
  mmOn: "10 mm on",
  checkPlace: "Walk there with the pen up",
};

export const penWaitText = {
  title: "Pen change",
  put: (pen: string) => `Put in the pen “${pen}”`,
  putForLayer: (layer: string) => `Put in the pen for “${layer}”`,
  layer: (layer: string) => `for the layer “${layer}”`,
  hint: "The pen is up and the carriage is home. Continue when the pen sits firmly.",
};
