/** Words of what the actions answer. */
export const stateText = {
  notText: (name: string) => `${name} is not a text file. Save the drawing as SVG and drop it here again.`,
  unreadable: (name: string) => `${name} could not be read. Is it a folder, or has it been moved?`,
  cannotRead: (name: string, why: string) => `${name} can’t be drawn: ${why}`,
  pastedName: "Pasted drawing",
  pasteNothing: "The clipboard holds no SVG. Copy the drawing as SVG, or drop the file.",
  saved: (name: string) => `${name} has the new settings.`,
  added: (name: string) => `${name} is in the queue.`,
  needsServer: "Without the server nothing can be plotted.",
};
