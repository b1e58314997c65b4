/** Texts of the dialog about plotwright. */
export const aboutText = {
  title: "About plotwright",
  what: "plotwright: free software for pen plotters, under the MIT licence.",
  whatVersion: (version: string) =>
    `plotwright ${version}: free software for pen plotters, under the MIT licence.`,
  licences: "It uses software by others, under these licences.",
  licencesLabel: "Licences",
  loading: "Fetching the licences…",
  absent: "The licences could not be fetched. They are in the file licences.txt of the installed page.",
};
