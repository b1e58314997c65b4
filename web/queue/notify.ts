/** Notifies the user when a plot ends or waits: on the page, and by system notifications if they are enabled. */
import type { Job } from "../../src/schema/index.js";
import { notifyText as words } from "./text.js";
import { waitWords } from "../plotter/machine-words.js";
import type { PageStore } from "../state/store.js";
import { appName } from "../ui/text.js";

/** The message for a job that has changed; null if the user does not need to know. */
export const noticeOfChange = (before: Job | null, now: Job): string | null => {
  if (before === null) return null;
  if (now.state === "paused" && now.wait !== null && before.wait === null) {
    return words.waits(now.name, waitWords(now.wait));
  }
  if (before.state === now.state) return null;
  if (now.state === "done") return words.done(now.name);
  if (now.state === "failed") return words.failed(now.name);
  if (now.state === "interrupted") return words.interrupted(now.name);
  return null;
};

/** Calls `notify` with a message when a job changes. */
export const watchJobs = (store: PageStore, notify: (message: string, job: Job) => void): void => {
  store.subscribe((state, before) => {
    if (state.jobs === before.jobs || before.jobs.length === 0) return;
    const known = new Map(before.jobs.map((job) => [job.id, job]));
    for (const job of state.jobs) {
      const message = noticeOfChange(known.get(job.id) ?? null, job);
      if (message !== null) notify(message, job);
    }
  });
};

/**
 * Shows a system notification if the user has allowed them. Chrome on Android shows them only through the service
 * worker; pages without one, as in development, show them directly. Never rejects.
 */
export const showNotification = async (message: string): Promise<void> => {
  if (window.Notification?.permission !== "granted") return;
  try {
    const registration = await navigator.serviceWorker?.getRegistration();
    if (registration?.active) await registration.showNotification(appName, { body: message });
    else new Notification(appName, { body: message });
  } catch {
    // The page shows the change anyway.
  }
};
