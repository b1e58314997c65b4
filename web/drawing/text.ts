/** Words of the drawing and its paper, of filling, lines and saving. */
export const drawingText = {
  title: "Drawing",
  choose: "Choose a drawing",
  chooseHint: "SVG, DXF, HPGL or JSON. Drop it anywhere, paste it, or choose a file.",
  sample: "Samples",
  sampleHint: "Try one of the samples",
  dropHere: "Drop the drawing to lay it on the paper",
  size: (size: string) => `${size} in the file`,
};

export const drawnSizeText = {
  drawn: (size: string, scale: string) => `Drawn ${size}, ${scale}\u202f%`,
  useFilesPage: "Use the file’s page",
};

export const reachText = {
  tooFar: (machine: string, reach: string, needed: string) =>
    `The ${machine} reaches ${reach} from home; this drawing needs ${needed}.`,
  beforeHome: (machine: string) =>
    `This drawing goes beyond the paper’s left or upper edge, where the ${machine} can’t go.`,
  whatToDo: "Choose a smaller paper, or make the drawing smaller.",
  turn: "Turn for this machine",
};

export const reportText = {
  title: "Won’t be drawn as on screen",
  show: "Show where",
};

export const paperText = {
  title: "Paper",
  more: "Separate margins, mirror, cutting",
  unit: "Lengths in",
  units: { mm: "Millimetres", in: "Inches" },
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
};

export const saveText = {
  title: "Save to a file",
  svg: "Prepared drawing as SVG",
  svgHint: "What will be plotted, in order, with its layers’ settings in their names.",
  json: "Polylines as JSON",
  jsonHint: "Plain numbers in mm, for other programs. Can be opened here again.",
  commands: "Commands for the board",
  commandsHint: "The lines that a plot would send, from motors on to motors off.",
  firmware: "Firmware of the board",
  save: (what: string) => `Save: ${what}`,
  saveShort: "Save",
};

export const fillText = {
  title: "Fill and shade",
  off: "off",
  on: (spacing: string) => `every ${spacing} mm`,
  switch: "Fill areas with lines",
  nothingToFill: "No shape of this drawing is filled, so there is nothing to fill with lines.",
  fillOutlines: "Fill closed outlines",
  spacingHint: "The distance of the lines: as wide as the pen draws fills without gaps.",
};

export const linesText = {
  title: "Lines",
  spreads: { none: "Off", interleave: "Take turns", shuffle: "Shuffle" },
  spreadHint: "Neighbouring strokes are drawn apart in time, so that ink dries and paper survives.",
  orderNone: "As in the file",
  orderFast: "Short way",
  orderBest: "Shortest way",
};

export const emptyPaperText = {
  title: "Drop a drawing here",
  hint: "SVG, DXF, HPGL or JSON. You can also paste it.",
  choose: "Choose a file",
  samples: "Or try a sample",
};

export const placeText = {
  x: "From the left",
  y: "From the top",
  width: "Width",
  height: "Height",
  hint: "Drag the drawing on the paper, its corners or its knob, or move it with the arrow keys. It is drawn to margins and middles; Alt keeps it free.",
  align: { across: "Centre across", down: "Centre down", fill: "Fill margins" },
};
