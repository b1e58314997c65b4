import { useEffect } from "react";
import { watchedJob } from "../state/store.js";
import { useActions, useBackend, useIsConnected, usePageState, usePageStore } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { Notices } from "../ui/notices.js";
import { StatusCard } from "./status-card.js";
import { watchText as words } from "./text.js";
import { planWatched } from "./watch-plan.js";
import { WatchSheet } from "./watch-sheet.js";
import "./watch.css";

/** The running plot, or the last one: its progress and its sheet. */
export const Watch = () => {
  const job = usePageState(watchedJob);
  usePlan();
  return (
    <div className="watch">
      {job ? <StatusCard job={job} /> : <NothingCard />}
      <div className="watch-area">
        <WatchSheet />
        <Notices />
      </div>
    </div>
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
    <section id="plot-status" tabIndex={-1} className="status-card" aria-label={words.status}>
      <div className="status-words">
        <p className="status-name">
          <strong>{words.nothing}</strong>
        </p>
      </div>
      {!isWatcher && (
        <div className="status-actions">
          <Button onClick={() => showView("prepare")}>{words.toPrepare}</Button>
        </div>
      )}
    </section>
  );
};
