/** Saves a file by a browser download. */
export const saveFile = (name: string, content: string | Blob, type: string): void => {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  // After this turn of the event loop the download has its own reference to the data.
  setTimeout(() => URL.revokeObjectURL(url), 0);
};
