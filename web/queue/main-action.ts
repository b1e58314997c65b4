/** What the main button of a job does, for the button and for the keyboard. */
import type { Job } from "../../src/schema/index.js";
import { mayOperate, type PageState } from "../state/store.js";

type MainAction = "pause" | "resume" | "recover";

const ACTIONS: Readonly<Partial<Record<Job["state"], MainAction>>> = {
  plotting: "pause",
  paused: "resume",
  interrupted: "recover",
};

/** Null: the job has no such button on this page. Watchers may only stop a plot. */
export const mainActionOf = (state: PageState, job: Job): MainAction | null =>
  mayOperate(state) || job.state === "plotting" ? (ACTIONS[job.state] ?? null) : null;

/** Without a connection the server would not receive the request. */
export const isMainActionOff = ({ link, busyAction }: PageState, job: Job, action: MainAction): boolean =>
  link !== "connected" || busyAction === `${action} ${job.id}`;
