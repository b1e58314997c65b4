/** Texts of the controls and frames that all panels use. */
export const appName = "plotwright";

/** The language of the names of days and months. */
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
  unexpected: "An unexpected error occurred. Reload the page; the queue is not lost.",
  reload: "Reload",
  partMissing: "This part of the page could not be fetched.",
  notKept:
    "The browser can’t store this drawing, so it will not be here at the next visit. Save it as a file if you need it.",
};
