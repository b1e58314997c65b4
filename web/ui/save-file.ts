/** Gives the user a file to keep, as a download. */
export const saveFile = (name: string, content: string, type: string): void => {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  // The download has its own hold on the data by the time that this turn of the loop is over.
  setTimeout(() => URL.revokeObjectURL(url), 0);
};
