/** Announces the changes of a browser's host. Each event is held back until all changes before it are stored. */
import { LimitedProgress } from "../../../host/limited-progress.js";
import type { ServerEvent } from "../../../src/schema/index.js";
import type { Records } from "./database.js";

export function announcer(
  db: Pick<Records, "written">,
  send: (event: ServerEvent) => void,
): (event: ServerEvent) => void {
  let last: Promise<void> = Promise.resolve();
  const events = new LimitedProgress((event) => {
    // A change that can't be stored is announced too: the page must always show a running plot. A notice reports the
    // fault.
    const stored = db.written().catch(() => undefined);
    last = last.then(() => stored).then(() => send(event));
  });
  return (event) => events.announce(event);
}
