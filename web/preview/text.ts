/** Texts of the preview and the time line. */
export const previewText = {
  reach: (machine: string, size: string) => `Reach of ${machine}: ${size}`,
  home: "Home, top left",
  turnDesk: "Turn the desk",
  reading: (name: string) => `Reading ${name}…`,
  nothingToDraw: "Nothing to draw",
  nothingToDrawHint: "Every layer is switched off, or everything lies outside the margins.",
  onlyPictures: "This file holds only a picture",
  onlyPicturesHint:
    "A pen draws lines. Trace the picture to paths in your drawing program, and save it again.",
  emptyFileHint: "The file has no visible lines and no filled shapes.",
  cannotRead: (name: string) => `${name} can’t be drawn`,
  cannotShow:
    "The drawing can’t be shown here, but it can be plotted. Reload the page; if that does not help, update the browser.",
  title: "Preview",
  canvas: "Preview",
  zoomIn: "Zoom in",
  zoomOut: "Zoom out",
  fitPaper: "Whole paper",
  travel: "Pen-up moves",
  turnPaper: "Turn the paper",
  needsDrawing: "There is no drawing on the paper.",
  place: "Place the drawing by hand",
  startHere: "Start here",
  startHereHint:
    "Moves the drawing so that the upper left corner of its box is where the carriage is now. Undo moves it back.",
  placesEach: "The sheet has several drawings: press one to place it.",
  needsPiece: "No drawing of the sheet is selected.",
  keepsOne: "One drawing stays on the sheet.",
  duplicatePiece: "Duplicate the selected drawing",
  removePiece: "Remove the selected drawing",
  needsPosition: "The position of the carriage is not known: press Home first.",
  colorBy: "Colour by",
  moreEntries: (count: number) => `and ${count} more`,
  hint: "Arrow keys move the paper, a drawing placed by hand, or the selected drawings; plus and minus zoom, 0 shows the whole paper.",
};

export const hoverText = {
  speed: "Speed",
  accel: "Acceleration",
  time: "At",
  stroke: "Stroke",
  strokeOf: (number: string, count: string) => `${number} of ${count}`,
};

export const strokeText = {
  title: "Selected stroke",
  strokeOf: (number: string, count: string) => `Stroke ${number} of ${count}`,
  close: "Close",
  length: "Length",
  width: "Width",
  takes: "Takes",
  seconds: (s: string) => `${s} s`,
  begins: "Begins at",
  speedHere: "Speed here",
  plotFrom: "Plot from here",
  plotFromHint: "The pen waits above this stroke until you press Resume. Earlier strokes are not drawn.",
};

export const timeLineText = {
  title: "Time line",
  play: "Play the plot",
  pause: "Stop playing",
  scrub: "Moment of the plot",
  rate: "Playing speed",
  graph: "Speed and acceleration over time",
  speed: "Speed, mm/s",
  accel: "Acceleration, mm/s²",
};
