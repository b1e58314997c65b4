/** Texts of the drawing and its paper, of filling, lines and saving. */
export const drawingText = {
  title: "Drawing",
  library: "Library",
  choose: "Choose a drawing",
  add: "Add to the sheet",
  chooseHint: "SVG, DXF, HPGL or JSON. Drop it anywhere, paste it, or choose a file.",
  sample: "Samples",
  sampleHint: "Try a sample",
  dropHere: "Drop the drawing to open it",
  dropReplace: "Drop here to replace the drawing",
  dropAdd: "Drop here to add it to the sheet",
  size: (size: string) => `${size} in the file`,
};

export const drawnSizeText = {
  drawn: (size: string, scale: string) => `Drawn ${size}, ${scale}\u202f%`,
  turned: (deg: number) => `, turned by ${deg}°`,
  useFilesPage: "Use the file’s page",
};

export const reachText = {
  tooFar: (machine: string, reach: string, needed: string) =>
    `${machine} reaches ${reach} from home; this drawing needs ${needed}.`,
  beforeHome: (machine: string) =>
    `This drawing goes over the paper’s left or upper edge, which ${machine} can’t reach.`,
  lines: (count: number, number: string) =>
    count === 1 ? "1 line is out of reach." : `${number} lines are out of reach.`,
  whatToDo: "Choose a smaller paper, or make the drawing smaller.",
  turn: "Turn for this machine",
};

export const outsideText = {
  leaves: (count: number, number: string, edges: string) =>
    `${count === 1 ? "1 line is" : `${number} lines are`} off the paper: up to ${edges}.`,
  edges: {
    leftMm: (size: string) => `${size} over the left edge`,
    topMm: (size: string) => `${size} over the upper edge`,
    rightMm: (size: string) => `${size} over the right edge`,
    bottomMm: (size: string) => `${size} over the lower edge`,
  },
  and: " and ",
  question: "A part of the drawing is off the paper. Choose what happens to it before you plot.",
  isAllowed: "It will be drawn there.",
  choices: "Drawing off the paper",
  turn: "Turn",
  cut: "Cut",
  cutHint: "Cuts it off at the paper’s edge",
  move: "Move back",
  fit: "Fit",
  fitHint: "Fits the whole drawing to the paper, inside the margins",
  allow: "Draw it there",
};

export const reportText = {
  title: "Not drawn as on screen",
  show: "Show where",
  paper: (name: string, pxPerInch: number) => `Read as ${name} at ${pxPerInch} px per inch`,
};

export const paperText = {
  title: "Paper",
  more: "Separate margins, mirror, cutting",
  unit: "Lengths in",
  units: { mm: "Millimetres", in: "Inches" },
  size: "Paper",
  custom: "Custom size",
  orientation: "Orientation",
  portrait: "Portrait",
  landscape: "Landscape",
  placement: "Size of the drawing",
  onSheet: "The sheet has several drawings: the panel Drawing places each of them.",
  auto: "Auto",
  autoHint: "True size if the page of the file fits the paper, otherwise fitted to it.",
  outside: {
    refuse: "Ask before plotting",
    cut: "Cut it off at the edge",
    move: "Move it onto the paper",
    fit: "Fit the drawing to the paper",
    allow: "Draw it there",
  },
  fit: "Fit paper",
  trueSize: "True size",
  byNumbers: "Custom",
  margins: "Separate margins",
  top: "Top",
  right: "Right",
  bottom: "Bottom",
  left: "Left",
  mirrors: { none: "Off", leftRight: "Left–right", upDown: "Up–down" },
  autoTurn: "Turn to fit the paper",
  guessPx: "Guess the resolution",
  rotateQuarter: "Turn by 90°",
};

export const tilesText = {
  title: "Over several sheets",
  summary: (columns: number, rows: number) => `${columns} × ${rows}`,
  together: (count: number, size: string) => `${count} sheets, together ${size}.`,
  which: "Sheets to plot",
  all: "All, one after the other",
  one: (tile: number, count: number) => `Sheet ${tile} of ${count}`,
  hint: "Each sheet is a job of the queue: change the paper and start the next one. Cut along the marks, or glue the sheets where they overlap.",
  off: "Back to one sheet",
};

export const saveText = {
  title: "Save to a file",
  svg: "Prepared drawing as SVG",
  svgHint: "What will be plotted, in order, with its layers’ settings in their names.",
  json: "Polylines as JSON",
  jsonHint: "Plain numbers in mm, for other programs. Can be opened here again.",
  commands: "Commands for the board",
  commandsHint: "All commands of the plot, from motors on to motors off.",
  firmware: "Firmware of the board",
  save: (what: string) => `Save: ${what}`,
  saveShort: "Save",
  planning: "Planning…",
};

export const fillText = {
  title: "Fill and shade",
  off: "off",
  on: (spacing: string) => `every ${spacing} mm`,
  switch: "Fill areas with lines",
  nothingToFill: "No shape of this drawing is filled, so there is nothing to fill with lines.",
  fillOutlines: "Fill closed outlines",
  spacingHint: "Distance between the lines. The width of the pen’s line fills areas without gaps.",
};

export const fillChoiceText = {
  label: "Filled shapes",
  count: (count: number, number: string) =>
    count === 1
      ? "1 filled shape. A pen draws lines, so choose:"
      : `${number} filled shapes. A pen draws lines, so choose:`,
  become: (count: number, number: string) =>
    count === 1 ? "1 filled shape becomes an outline" : `${number} filled shapes become outlines`,
  ways: { outline: "Outline", hatch: "Hatch", hide: "Hide what is under them" },
};

export const linesText = {
  title: "Lines",
  spreads: { none: "Off", interleave: "Alternate", shuffle: "Shuffle" },
  spreadHint:
    "Does not draw neighbouring strokes one after the other, so that ink can dry and wet paper does not tear.",
  orders: { none: "As in the file", fast: "Fast", best: "Fastest" },
  orderHint:
    "“Fast” and “Fastest” change the order of the strokes, so that the pen travels less between them. “Fastest” searches longer.",
};

export const emptyPaperText = {
  title: "Drop a drawing here",
  hint: "SVG, DXF, HPGL or JSON. You can also paste it.",
  choose: "Choose a file",
  samples: "Or try a sample",
};

export const layoutText = {
  x: "From the left",
  y: "From the top",
  width: "Width",
  height: "Height",
  hint: "Drag the drawing on the paper, its corners or its knob, or move it with the arrow keys. It snaps to margins and centre lines; hold Alt to move it freely.",
  align: { across: "Centre across", down: "Centre down", fill: "Fit into margins" },
};
