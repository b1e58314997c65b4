/** Sets a performance mark, and removes the last one of this name. For the developer tools and the page's benchmark. */
export const markMoment = (name: string): void => {
  performance.clearMarks(name);
  performance.mark(name);
};
