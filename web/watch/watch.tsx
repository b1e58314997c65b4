import { useEffect } from "react";
import { watchedJob, boardFirmware, type PageState, type PageStore, type WatchPlan } from "../state/store.js";
import { useActions, useBackend, useIsConnected, usePageState, usePageStore } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { Notices } from "../ui/notices.js";
import { stateOf } from "../queue/job-head.js";
import { DrawButton, StatusCard } from "./status-card.js";
import { watchText as words } from "./text.js";
import { WatchSheet } from "./watch-sheet.js";
import { ENDED_STATES, type Job } from "../../src/schema/index.js";
import type { Backend } from "../backend/backend.js";
import { openPlanner, type Planner } from "../worker/planner.js";
import type { Planned } from "../worker/protocol.js";
import { lazyPart } from "../ui/lazy-part.js";
import "./watch.css";

const Timelapse = lazyPart(async () => (await import("./timelapse.js")).Timelapse);

const DrawMode = lazyPart(async () => (await import("./hand-drawing/draw-mode.js")).DrawMode);

export const Watch = () => {
  const isDrawing = usePageState(({ handDrawing }) => handDrawing !== null);
  return isDrawing ? <DrawMode /> : <WatchedPlot />;
};

/** The running plot, or the last one: its progress and its sheet. */
const WatchedPlot = () => {
  const job = usePageState(watchedJob);
  const hasPictures = useBackend().features.sharing;
  usePlan();
  return (
    <section className="watch" aria-label={words.status} data-state={job && stateOf(job)}>
      {job ? <StatusCard job={job} /> : <NothingCard />}
      <div className="watch-area">
        <WatchSheet />
        <Notices />
        {job && hasPictures && ENDED_STATES.includes(job.state) && <Timelapse job={job} />}
      </div>
    </section>
  );
};

/** Plans the watched job. Again when the server is back, because the drawing may not have arrived before. */
const usePlan = (): void => {
  const store = usePageStore();
  const backend = useBackend();
  const id = usePageState((state) => watchedJob(state)?.id ?? null);
  const startedAt = usePageState((state) => watchedJob(state)?.startedAt ?? null);
  const isConnected = useIsConnected();
  useEffect(() => {
    const job = watchedJob(store.getState());
    if (job && isConnected) void planWatched(store, backend, job);
  }, [store, backend, id, startedAt, isConnected]);
};

const NothingCard = () => {
  const { showView } = useActions();
  const isWatcher = usePageState((state) => state.me?.role === "watch");
  return (
    <>
      <div id="plot-status" tabIndex={-1} className="status-words">
        <p className="status-name">
          <strong>{words.nothing}</strong>
        </p>
      </div>
      {!isWatcher && (
        <div className="status-actions">
          <div className="button-row">
            <Button onClick={() => showView("prepare")}>{words.toPrepare}</Button>
            <DrawButton />
          </div>
        </div>
      )}
    </>
  );
};

/** Made when the first job is watched. */
let planner: Planner | null = null;

/** Includes the start time, because a job that is started again may have other settings. */
const keyOf = ({ id, startedAt }: Job): string => `${id} ${startedAt ?? ""}`;

/** Plans the job, unless it is planned or being planned already. */
const planWatched = async (store: PageStore, backend: Backend, job: Job): Promise<void> => {
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
