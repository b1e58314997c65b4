/** What a plotter is doing, in words, from its connection and its job. */
import type { MachineProfile } from "../../src/index.js";
import { findsHome, firmwareAdvice } from "../../src/internal.js";
import type { Job, Plotter } from "../../src/schema/index.js";
import { penWait } from "../state/store.js";
import { plotterText as words } from "./text.js";

/** State of the lamp. The style sheet has its colours. */
type Lamp = Plotter["connection"] | "held" | "waiting";

/** "Waits for the pen …", "Paused", "Plotting" …, or the state of the connection. */
export const plotterWords = ({ connection }: Plotter, job: Job | null): string => {
  if (connection === "fault" || connection === "absent") return words.connection[connection];
  if (job?.stopped) return words.stopped;
  const wait = job && penWait(job);
  if (wait) return waitWords(wait);
  if (job?.state === "paused") return words.held;
  if (job?.state === "interrupted") return words.interrupted;
  if (job?.state === "plotting") return words.connection.busy;
  return connection === "busy" ? words.moving : words.connection[connection];
};

/** "up", "going down" … */
export const penWords = ({ penUp, penMoving }: Plotter): string => {
  if (penUp === null) return words.unknown;
  if (penMoving) return penUp ? words.goingUp : words.goingDown;
  return penUp ? words.up : words.down;
};

export const waitWords = ({ penName, layerName }: NonNullable<Job["wait"]>): string =>
  penName === null ? words.waitsForLayer(layerName) : words.waitsForPen(penName);

export const lampOf = ({ connection }: Plotter, job: Job | null): Lamp => {
  if (connection === "fault" || connection === "absent") return connection;
  if (job?.stopped) return "fault";
  if (job?.state === "interrupted") return "held";
  if (job?.state !== "paused") return job?.state === "plotting" ? "busy" : connection;
  return job.wait === null ? "held" : "waiting";
};

/** Where home is. */
export const homeWords = (machine: MachineProfile | null): string =>
  machine && findsHome(machine) ? words.findsHomeHint : words.homeHint;

/** What to know about the firmware of a real board; null: nothing. */
export const adviceWords = (plotter: Plotter, machine: MachineProfile | null): string | null =>
  machine && firmwareAdvice(machine, plotter);
