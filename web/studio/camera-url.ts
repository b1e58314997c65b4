/** Whether a camera's picture may come from this address. */
export const isCameraUrl = (url: string): boolean => {
  try {
    return ["http:", "https:"].includes(new URL(url).protocol);
  } catch {
    return false;
  }
};

/** The address with a changing parameter, so that no cache answers with the last picture. */
export const freshUrl = (url: string, turn: number): string => {
  const fresh = new URL(url);
  fresh.searchParams.set("plotwright", String(turn));
  return fresh.href;
};
