/** Texts of the backend without a server. */
export const browserText = {
  closed: "The tab that operated the plotter was closed. Try again.",
  noHost: "No tab of plotwright answers. Reload this page, and close other tabs of it.",
  notLoaded: "a part of the program did not load. Are you offline? Reload the page.",
  failed: (message: string) => `Plotting does not work in this browser: ${message}`,
  needsServer: "This needs plotwright’s server: install it on the computer that the plotter is plugged into.",
  noSerial:
    "This browser can’t drive a plotter from a page. Open this page in Chrome or Edge on a computer. Here, plots run on the virtual plotter.",
  insecure:
    "This page was not opened by https, so the browser does not let it use a plotter. Open it at its https address, or at http://localhost. Until then plots run on the virtual plotter, and the queue is lost when this tab is closed.",
  full: "its storage for this site is full. Remove jobs from the queue and the history, or free space on the disk.",
  closedStorage: "it closed its storage for this site, as when the data of the site are cleared.",
  storageSays: (message: string) => `its storage for this site reports “${message}”.`,
  cleared:
    "The data of this site were cleared in the browser. Queue, history and settings are stored again, but the drawings are gone: to plot a queued job, add its drawing again.",
  onlyHere: (reason: string) =>
    `The last changes are only in this tab, so keep it open. The browser can’t store them: ${reason}`,
  notAdded: (reason: string) =>
    `The job was not added; the drawing is still on the page. The browser can’t store it: ${reason}`,
  notRead: (reason: string) => `The browser can’t read this drawing: ${reason}`,
  nothingStored:
    "The browser stores nothing for this site, as in some private windows or where site data is blocked. You can plot, but queue, history and settings are lost when this tab is closed.",
  noneChosen: "No plotter was chosen. Plug it in, switch it on, and choose it in the list.",
  noneAnswers:
    "No plotter answers on the port that you chose: check its cable and its power, and close other programs that use it. Then choose it again.",
  sampleMissing: (name: string) => `The sample ${name} did not load. Are you offline?`,
};
