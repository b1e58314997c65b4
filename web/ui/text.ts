/** Words of the controls and frames that every panel uses. */
export const appName = "plotwright";

/** In which the names of days and months are written. */
export const language = "en-GB";

export const hintText = {
  about: (label: string) => `About: ${label}`,
};

export const fieldText = {
  between: (min: string, max: string, unit: string) => `Between ${min} and ${max} ${unit}`.trim(),
  notANumber: "Type a number",
};

export const errorText = {
  close: "Close",
  title: "Something went wrong",
  unexpected: "The page met an error it did not expect. Reload it; the queue is kept.",
  reload: "Reload",
  partMissing: "This part of the page could not be fetched.",
  notKept:
    "The browser can’t store this drawing, so it will not be here at the next visit. Save it as a file if you need it.",
};
