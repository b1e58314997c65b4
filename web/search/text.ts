/** Texts of the search. */
export const searchText = {
  title: "Search for anything",
  placeholder: "What do you want to do or change?",
  results: "Results",
  action: "Action",
  panel: "Panel",
  none: (query: string) => `Nothing is called “${query}”. Try another word, such as “speed” or “margin”.`,
  found: (count: number) => (count === 1 ? "1 result" : `${count} results`),
  hint: "Arrow keys choose, Enter opens, Escape closes.",
  needsPx: "The page of this drawing is not given in px.",
  needsMeasured: "Measure the ringing of this plotter first.",
  needsPens: "Add a pen first.",
  easeSpeed: "Speed of slow start and end",
  easeLength: "Length of slow start and end",
};
