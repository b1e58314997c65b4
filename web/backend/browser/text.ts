/** Texts of the backend without a server. */
export const browserText = {
  closed: "The tab that operated the plotter was closed. Try again.",
  noHost: "No tab of plotwright answers. Reload this page, and close other tabs of it.",
  failed: (message: string) => `Plotting does not work in this browser: ${message}`,
  needsServer: "This needs plotwright’s server: install it on the computer that the plotter is plugged into.",
  noSerial: "This browser can’t open USB boards from a page: use Chrome or Edge, at https or on localhost.",
  noneChosen: "No plotter was chosen. Plug it in, switch it on, and choose it in the list.",
  sampleMissing: (name: string) => `The sample ${name} did not load. Are you offline?`,
};
