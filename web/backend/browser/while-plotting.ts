/** While this page runs a plot: keeps the screen on, and asks before the page is closed. */
import type { ServerEvent } from "../../../src/schema/index.js";
import type { HostClient } from "./host-client.js";

export const watchOverPlots = (client: HostClient): void => {
  const plotting = new Set<string>();
  let wakeLock: Promise<WakeLockSentinel | null> | null = null;
  const isHere = (): boolean => client.isHost && plotting.size > 0;

  const keepAwake = (): void => {
    if (!isHere()) {
      void wakeLock?.then((sentinel) => sentinel?.release());
      wakeLock = null;
    } else if (wakeLock === null && "wakeLock" in navigator && document.visibilityState === "visible") {
      // If it is refused (low battery), the computer's own settings apply.
      wakeLock = navigator.wakeLock.request("screen").catch(() => null);
    }
  };
  const note = (id: string, state: string): void => {
    if (state === "plotting") plotting.add(id);
    else plotting.delete(id);
  };
  const onEvent = (event: ServerEvent): void => {
    if (event.type === "snapshot") {
      plotting.clear();
      for (const { id, state } of event.snapshot.jobs) note(id, state);
    } else if (event.type === "job") note(event.job.id, event.job.state);
    else return;
    keepAwake();
  };

  client.listen({ onEvent, onLink: () => undefined });
  // The browser releases the lock when the page is hidden.
  document.addEventListener("visibilitychange", () => {
    if (document.visibilityState === "visible") {
      wakeLock = null;
      keepAwake();
    }
  });
  window.addEventListener("beforeunload", (event) => {
    if (isHere()) event.preventDefault();
  });
};
