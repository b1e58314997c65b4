/** The licences of what is built into the page: a file that the build writes beside it. */

/** Null where there is no such file, as while the page is developed. */
export const fetchLicences = async (signal: AbortSignal): Promise<string | null> => {
  const response = await fetch(`${import.meta.env.BASE_URL}licences.txt`, { signal });
  const isText = response.headers.get("Content-Type")?.startsWith("text/plain") === true;
  return response.ok && isText ? response.text() : null;
};
