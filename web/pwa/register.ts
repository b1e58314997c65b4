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
