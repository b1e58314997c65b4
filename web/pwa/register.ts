/** Caches the page's files for when the server can't be reached. Browsers allow it on localhost and over https. */
export const keepPage = (onUpdated: () => void): void => {
  const { serviceWorker } = navigator;
  if (!import.meta.env.PROD || !window.isSecureContext || !serviceWorker) return;
  // The first worker that takes control is not an update.
  let hadOne = serviceWorker.controller !== null;
  serviceWorker.addEventListener("controllerchange", () => {
    if (hadOne) onUpdated();
    hadOne = true;
  });
  const register = (): void => {
    // Without it only opening the page offline fails, so there is no message.
    serviceWorker.register(`${import.meta.env.BASE_URL}service-worker.js`).catch(() => undefined);
  };
  if (document.readyState === "complete") register();
  else window.addEventListener("load", register);
};

/** Checks for a newer page. The browser itself only does this when a page is opened. */
export const lookForUpdate = async (): Promise<void> => {
  const registration = await navigator.serviceWorker?.getRegistration();
  await registration?.update().catch(() => undefined);
};

/** The licences of all software in the page. Null if there is no such file, as on the development server. */
export const fetchLicences = async (signal: AbortSignal): Promise<string | null> => {
  const response = await fetch(`${import.meta.env.BASE_URL}licences.txt`, { signal });
  const isText = response.headers.get("Content-Type")?.startsWith("text/plain") === true;
  return response.ok && isText ? response.text() : null;
};
