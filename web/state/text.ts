/** Texts of the notices that actions show. */
export const stateText = {
  isPicture: (name: string) =>
    `${name} is a picture: it has no lines to follow. Trace it first (in Inkscape: Path, Trace Bitmap), save it as SVG and drop that here.`,
  notText: (name: string) => `${name} is not a text file. Save the drawing as SVG and drop it here again.`,
  unreadable: (name: string) => `${name} could not be read. Is it a folder, or has it been moved?`,
  cannotRead: (name: string, why: string) => `${name} can’t be drawn: ${why}`,
  drawsNothing: (name: string) => `${name} has no lines to draw, so it was not added.`,
  sheetName: (names: readonly string[]) =>
    names.length < 3 ? names.join(" + ") : `${names[0] ?? ""} + ${names.length - 1} more`,
  pastedName: "Pasted drawing",
  pasteNothing: "The clipboard has no SVG. Copy the drawing as SVG, or drop the file.",
  saved: (name: string) => `${name} in the queue now has these settings.`,
  added: (name: string) => `${name} is in the queue.`,
  kept: (path: string) => `Kept in the library: ${path}`,
  notConnected: "There is no connection to plotwright, so nothing can be plotted.",
};
