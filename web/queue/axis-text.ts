/** Texts that are loaded with the queue's axis and with the end of a plot. */
/** When the plots of the queue start and end, and what a person must do between them. */
export const axisText = {
  ifNow: "Times if you start now",
  fromTo: (from: string, to: string) => `${from}–${to}`,
  notBefore: (clock: string) => `Not before ${clock}`,
  paper: "New paper, then press Start",
  paperAfterEach: "new paper after each copy",
  pen: (name: string) => `Waits for the pen “${name}”`,
  penUnasked: (name: string) => `Begins with the pen “${name}”: change it yourself, the plot does not wait`,
  place: "Waits at its first stroke until you resume it",
  penStops: (count: number) => (count === 1 ? "Stops once for a pen:" : `Stops ${count} times for pens:`),
  end: (clock: string) => `All done ${clock}`,
  endAtEarliest: (clock: string) => `All done ${clock} at the earliest`,
  endUnknown: "The end is not known yet.",
};

/** Texts of a finished plot. */
export const doneText = {
  asExpected: "as long as expected",
  longer: (more: string, expected: string) => `${more} longer than the expected ${expected}`,
  shorter: (less: string, expected: string) => `${less} shorter than the expected ${expected}`,
  drawn: (length: string, count: number, number: string) =>
    `${length} of ink in ${count === 1 ? "1 stroke" : `${number} strokes`}`,
  save: (format: string) => `Save ${format.toUpperCase()}`,
  saveNamed: (format: string) => `Save ${format.toUpperCase()} picture`,
  saveOf: (format: string, name: string) => `Save ${format.toUpperCase()} picture of ${name}`,
  notSaved: (why: string) => `The picture can’t be saved: ${why}`,
  keepSpeed: (pct: number) => `It ran at ${pct}\u202f% of its speeds: keep that from now on?`,
  keep: "Keep",
};
