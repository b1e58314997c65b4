/** Has the page's files kept for when the server is away. Browsers allow it on this computer and over https. */
export const keepPage = (onUpdated: () => void): void => {
  const { serviceWorker } = navigator;
  if (!import.meta.env.PROD || !window.isSecureContext || !serviceWorker) return;
  // The first one to take over is no update.
  let hadOne = serviceWorker.controller !== null;
  serviceWorker.addEventListener("controllerchange", () => {
    if (hadOne) onUpdated();
    hadOne = true;
  });
  const register = (): void => {
    // Without it everything works but opening the page offline, so there is no message.
    serviceWorker.register(`${import.meta.env.BASE_URL}service-worker.js`).catch(() => undefined);
  };
  if (document.readyState === "complete") register();
  else window.addEventListener("load", register);
};

/** Asks whether there is a newer page; the browser by itself does so only when a page is opened. */
export const lookForUpdate = async (): Promise<void> => {
  const registration = await navigator.serviceWorker?.getRegistration();
  await registration?.update().catch(() => undefined);
};
