/** The plan of the job shown in Watch, for its picture and the current layer. */
import type { Job } from "../../src/schema/index.js";
import type { Backend } from "../backend/backend.js";
import { boardFirmware, type PageState, type PageStore, type WatchPlan } from "../state/store.js";
import { openPlanner, type Planner } from "../worker/planner.js";
import type { Planned } from "../worker/protocol.js";

/** Made when the first job is watched. */
let planner: Planner | null = null;

/** Includes the start time, because a job that is started again may have other settings. */
const keyOf = ({ id, startedAt }: Job): string => `${id} ${startedAt ?? ""}`;

/** Plans the job, unless it is planned or being planned already. */
export const planWatched = async (store: PageStore, backend: Backend, job: Job): Promise<void> => {
  const key = keyOf(job);
  const state = store.getState();
  if (state.watchPlan?.key === key) return;
  const laidOut = planOnPaper(state, job);
  store.setState({ watchPlan: { key, planned: laidOut, fault: null } });
  if (laidOut) return;
  try {
    const text = await backend.jobs.drawing(job.id);
    if (store.getState().watchPlan?.key !== key) return;
    const firmware = boardFirmware({ ...store.getState(), settings: job.settings });
    planner ??= plannerFor(store);
    planner.request({ drawing: { key, text }, settings: job.settings, firmware });
  } catch {
    // Tried again when the server is back.
    answer(store, key, null);
  }
};

/** The plan of the drawing in Prepare, if that is this job's: a large drawing is not planned twice. */
const planOnPaper = ({ drawing, planned, isPlanning }: PageState, job: Job): Planned | null =>
  drawing?.jobId === job.id && planned?.drawingKey === drawing.key && !isPlanning ? planned : null;

const plannerFor = (store: PageStore): Planner =>
  openPlanner({
    onPlanned: (planned) => {
      const key = planned.drawingKey;
      answer(store, key, { key, planned, fault: null });
    },
    onFault: (fault) => {
      const key = store.getState().watchPlan?.key;
      if (key !== undefined) answer(store, key, { key, planned: null, fault: fault.message });
    },
    onImported: () => undefined,
    onExported: () => undefined,
    onExportFailed: () => undefined,
  });

/** Stores the plan, unless another job is watched by now. */
const answer = (store: PageStore, key: string, watchPlan: WatchPlan | null): void =>
  store.setState((state) => (state.watchPlan?.key === key ? { watchPlan } : {}));
