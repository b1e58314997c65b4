/** Texts of the gallery of finished plots. */

export const galleryText = {
  title: "Gallery",
  empty: "Finished plots are shown here.",
  all: "Show all finished plots",
  search: "Search by name",
  nothingFound: (name: string) => `No finished plot has “${name}” in its name.`,
  newer: "Newer",
  older: "Older",
  page: (number: number) => `Page ${number}`,
  show: (name: string) => `Show ${name} as it was plotted`,
  keep: "Keep in the library",
  keepNamed: (name: string) => `Keep ${name} in the library`,
  ink: (length: string) => `${length} of ink`,
};

/** Texts of the library's dialog. */
export const libraryText = {
  search: "Search in this folder and below",
  empty:
    "This folder is empty. Upload drawings, save the one on the paper, or keep finished plots from the gallery.",
  nothingFound: (name: string) => `No drawing here or below has “${name}” in its name.`,
  isCut: "There are more than are listed here. Search for a part of the name.",
  save: (name: string) => `Save “${name}” here`,
  upload: "Upload a drawing",
  newFolder: "New folder",
  make: "Make",
  path: "Folder",
  openNamed: (name: string) => `Open ${name}`,
  openFolder: (name: string) => `Open the folder ${name}`,
  more: (name: string) => `More for ${name}`,
  remove: "Remove",
  removeNamed: (name: string) => `Remove ${name}`,
  confirm: (name: string) => `Remove “${name}” from the library? It is deleted on the server.`,
  keepIt: "Keep it",
  saved: (path: string) => `Saved in the library: ${path}`,
};
