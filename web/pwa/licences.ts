/** The licences of all software in the page: a file that the build writes beside it. */

/** Null if there is no such file, as on the development server. */
export const fetchLicences = async (signal: AbortSignal): Promise<string | null> => {
  const response = await fetch(`${import.meta.env.BASE_URL}licences.txt`, { signal });
  const isText = response.headers.get("Content-Type")?.startsWith("text/plain") === true;
  return response.ok && isText ? response.text() : null;
};
