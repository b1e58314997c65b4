/** Marks the latest moment of a name on the browser's time line, for its developer tools and the benchmark of the page. */
export const markMoment = (name: string): void => {
  performance.clearMarks(name);
  performance.mark(name);
};
