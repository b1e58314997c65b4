/**
 * Every word that the page shows. A translation is a second file of this shape:
 * plain strings, and functions where a number or a name goes in.
 */
export const en = {
  appName: "plotwright",
  /** In which the names of days and months are written. */
  language: "en-GB",
  history: { undo: "Undo", redo: "Redo" },
  tabs: { label: "Panels", setup: "Set up", queue: "Queue", machine: "Plotter" },
  studio: "Sharing, plotters, camera",
  theme: { label: "Appearance", auto: "As the system", light: "Light", dark: "Dark" },

  drawing: {
    title: "Drawing",
    choose: "Choose a drawing",
    chooseHint: "SVG, DXF, HPGL or JSON. Drop it anywhere, paste it, or choose a file.",
    sample: "Samples",
    sampleHint: "Try one of the samples",
    dropHere: "Drop the drawing to lay it on the paper",
    reading: (name: string) => `Reading ${name}…`,
    planning: "Planning…",
    nothingToDraw: "Nothing to draw",
    nothingToDrawHint: "Every layer is switched off, or everything lies outside the margins.",
    cannotRead: (name: string) => `${name} can’t be drawn`,
    notText: (name: string) => `${name} is not a text file. Save the drawing as SVG and drop it here again.`,
    unreadable: (name: string) => `${name} could not be read. Is it a folder, or has it been moved?`,
    pastedName: "Pasted drawing",
    pasteNothing: "The clipboard holds no SVG. Copy the drawing as SVG, or drop the file.",
    size: (width: string, height: string) => `${width} × ${height} mm in the file`,
  },

  report: {
    title: "Won’t be drawn as on screen",
    show: "Show where",
  },

  paper: {
    title: "Paper",
    size: "Paper",
    custom: "Own size",
    orientation: "Orientation",
    portrait: "Portrait",
    landscape: "Landscape",
    placement: "Size of the drawing",
    fit: "Fit paper",
    trueSize: "True size",
    byNumbers: "Own place",
    margins: "Each margin by itself",
    top: "Top",
    right: "Right",
    bottom: "Bottom",
    left: "Left",
    mirrors: { none: "Off", leftRight: "Left–right", upDown: "Up–down" },
    rotateQuarter: "Turn a quarter",
  },

  layers: { title: "Layers" },
  pens: { title: "Pens" },
  export: { title: "Save to a file" },

  fill: {
    title: "Fill and shade",
    off: "off",
    on: (spacing: string) => `every ${spacing} mm`,
  },

  lines: { title: "Lines" },

  motion: {
    title: "Speed",
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
    ease: "Begin and end strokes slowly",
    fit: "Draw dense curves in long sweeps",
    sendAheadHint:
      "Before firmware 3 the board still plays this after an emergency stop. Less stops sooner, but then the pen may pause where this computer is busy.",
    fitHint: "Fewer, longer commands to the board, so that long curves run without stutter.",
  },

  pen: { title: "Pen" },

  plot: {
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
    saved: (name: string) => `${name} has the new settings.`,
    added: (name: string) => `${name} is in the queue.`,
    needsDrawing: "Choose a drawing, or try a sample.",
    needsServer: "Without the server nothing can be plotted.",
    needsPlotter: "No plotter is connected. The queue waits for one.",
  },

  machine: {
    title: "Plotter",
    virtual: "Virtual board: no plotter plugged in",
    virtualHint: "Plots run on a model of the board. Plug in a plotter and it is found by itself.",
    penUp: "Pen up",
    penDown: "Pen down",
    motorsOff: "Motors off",
    home: "Home",
    homeHint:
      "Home is where the carriage stood when the motors came on: there are no end switches. Move it to the corner by hand with the motors off.",
    position: "Pen at",
    unknown: "not known",
    pen: "Pen",
    up: "up",
    down: "down",
    motors: "Motors",
    on: "on",
    off: "off",
    firmware: "Firmware",
    which: "Send to",
    model: "Model",
    moves: "Move by hand",
    setUp: "Set up a plotter…",
    profiles: "Machines…",
    console: "Console",
    log: "Save the log of the connection",
    held: "Paused",
    notHeard: "No word from it",
    moving: "Moving",
    waitsForPen: (pen: string) => `Waits for the pen “${pen}”`,
    waitsForLayer: (layer: string) => `Waits for the pen for “${layer}”`,
    jobState: (state: string, job: string) => `${state}: ${job}`,
    connection: {
      absent: "Not connected",
      connecting: "Connecting…",
      idle: "Ready",
      busy: "Plotting",
      fault: "Needs attention",
    },
    server: {
      connecting: "Connecting to plotwright…",
      lost: "The server can’t be reached. Trying again…",
    },
  },

  strips: {
    watching: (operator: string | null) =>
      operator === null
        ? "This device watches. It may stop a plot, nothing else."
        : `${operator} is operating; this device watches. It may stop a plot, nothing else.`,
    operating: (name: string) => `${name} is operating.`,
    takeOver: "Take over",
    read: "I have read it",
    outdated: "plotwright was brought up to date on the server.",
    offline:
      "plotwright’s server can’t be reached: switched off, or this device has no network. Drawings can be laid out meanwhile.",
  },

  queue: {
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
  },

  preview: {
    title: "Preview",
    canvas: "Preview",
    zoomIn: "Zoom in",
    zoomOut: "Zoom out",
    fitPaper: "Whole paper",
    travel: "Pen-up moves",
    place: "Place the drawing by hand",
    colorBy: "Colour by",
    colorBySpeed: "Speed",
    colorByOrder: "Order",
    colorByLayer: "Layer",
    colorByPen: "Pens",
    colorByInk: "Ink",
    legend: "Speed legend",
    legendTitle: "Speed with the pen down",
    legendUnit: "mm/s",
    orderTitle: (total: string) => `Order, first to last over ${total}`,
    slow: "slow",
    fast: "fast",
    first: "first",
    last: "last",
    hint: "Arrow keys move the paper, or a drawing placed by hand; plus and minus zoom, 0 shows the whole paper.",
  },

  shortcuts: {
    title: "Keys",
    play: "Play the plot, or stop",
    travel: "Show pen-up moves",
    graph: "Show speed over time",
    pause: "Pause the plotter, or resume",
    fields: "In a number: arrow up and down step it, with Shift ten times as far.",
  },

  presets: {
    title: "Presets",
    hint: "Speeds, heights, pens and layers under a name, to come back to with one press.",
    name: "Name of this preset",
    save: "Keep",
    remove: (name: string) => `Forget ${name}`,
  },

  notify: {
    waits: (name: string, what: string) => `${name}: ${what}.`,
    ask: "Tell me when a plot ends",
    asked: "You are told when a plot ends or fails",
    denied: "The browser forbids notifications for this page. Allow them in its settings.",
    done: (name: string) => `${name} is plotted.`,
    failed: (name: string) => `${name} failed. Have a look at the queue.`,
    interrupted: (name: string) => `${name} was interrupted. It can go on from there.`,
  },

  hover: {
    speed: "Speed",
    accel: "Acceleration",
    time: "At",
    stroke: "Stroke",
    strokeOf: (number: string, count: string) => `${number} of ${count}`,
  },

  timeLine: {
    title: "Time line",
    play: "Play the plot",
    pause: "Stop playing",
    scrub: "Moment of the plot",
    rate: "Playing speed",
    graph: "Speed and acceleration over time",
    speed: "Speed, mm/s",
    accel: "Acceleration, mm/s²",
  },

  field: {
    between: (min: string, max: string, unit: string) => `Between ${min} and ${max} ${unit}`.trim(),
    notANumber: "Type a number",
  },

  errors: {
    close: "Close",
    title: "Something went wrong",
    unexpected: "The page met an error it did not expect. Reload it; the queue is safe on the server.",
    reload: "Reload",
    partMissing: "This part of the page could not be fetched.",
    server: (status: number) => `The server answered with an error (${status}). Try again.`,
    unreachable: "The server can’t be reached. Is plotwright still running?",
  },
};

export type Texts = typeof en;
