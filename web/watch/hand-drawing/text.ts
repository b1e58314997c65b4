/** Texts of drawing by hand. */
import { formatLength, formatNumber } from "../../ui/format.js";

export const drawText = {
  title: "Draw by hand",
  undo: "Undo",
  nothingToUndo: "The pen has drawn all of it.",
  finish: "Finish",
  leave: "Leave",
  sheet: "Sheet to draw on",
  canvas: "Your drawing: what the pen has drawn, and what is left",
  jobName: (clock: string) => `Drawn by hand ${clock}`,
  howTitle: "Draw here: the plotter follows.",
  how: "With a finger, a stylus or the mouse. Two fingers move and zoom the sheet.",
  nothingYet: "Nothing is drawn yet.",
  brokenTitle: "The drawing has ended early.",
  behind: (s: number, mm: number) =>
    `The pen is ${formatNumber(s, 1)}\u202fs behind · ${formatLength(mm)} to draw`,
  upToDate: "The pen has drawn everything.",
  waits: (mm: number) => `The pen starts · ${formatLength(mm)} to draw`,
  isBehind: (mostS: number, againS: number) =>
    `The pen is more than ${mostS} s behind. Wait until it is ${againS} s behind: until then the page takes no new line.`,
  refused: "Your last line was not taken, or only its beginning.",
  hasLeftPaper: "Beside the paper, or out of the plotter’s reach, nothing is drawn.",
  finishing: "The pen draws the rest, then it goes home.",
  ended: (why: string) =>
    `${why} What had reached the plotter is a plot in the gallery, which can be plotted again.`,
  keep: "Open the whole drawing in Prepare",
  close: "Close",
  smoothing: "Smoothing",
};
