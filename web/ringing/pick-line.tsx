import { useEffect, useRef, useState } from "react";
import { ringingChecks, type Springs } from "../../src/internal.js";
import type { Job } from "../../src/schema/index.js";
import { usePageState, usePageStore, useActions } from "../state/use-store.js";
import type { PageStore } from "../state/store.js";
import { ringingText as words } from "./ringing-text.js";
import { Button } from "../ui/button.js";
import { formatNumber } from "../ui/format.js";
import { checkJobs, checksPlace, type SheetJob } from "./ringing-job.js";
import { SheetPicture } from "./sheet-picture.js";
import { useSprings } from "../motion/use-springs.js";
import { isStored, useStoreSprings } from "./use-store-springs.js";

/** The second sheet: the user picks the straightest of six lines. */
export const PickLine = () => {
  const springs = useSprings();
  // Picking a line changes the machine's springs, but the lines on the sheet stay as they were plotted.
  const [plotted, setPlotted] = useState(springs);
  const shown = plotted ?? springs;
  if (shown === null) return <p className="note">{words.pickNeeds}</p>;
  return <Lines springs={shown} onPlot={() => setPlotted(shown)} />;
};

const Lines = ({ springs, onPlot }: { springs: Springs; onPlot(): void }) => {
  const settings = usePageState((state) => state.settings);
  const known = useSprings();
  const store = useStoreSprings();
  /** The clicked line, even if it is not stored yet. */
  const [picked, setPicked] = useState<number | null>(null);
  const { run, at, hasStopped } = useSheetPlot();
  const checks = ringingChecks(springs);
  const labels = checks.map((check) =>
    check.springs === null
      ? words.unshaped
      : words.shapedFor(formatNumber(check.springs.xHz, 1), formatNumber(check.springs.yHz, 1)),
  );
  const place = checksPlace(settings, checks.length);
  const chosen = picked ?? checks.findIndex((check) => isStored(check.springs, known));
  const isUnshapedPicked = chosen === 0;
  const pick = async (index: number): Promise<void> => {
    setPicked(index);
    const better = checks[index].springs;
    if (better !== null && !(await store(better))) setPicked(null);
  };
  const plot = (): void => {
    onPlot();
    void run(checkJobs(settings, springs, ({ factor }) => words.checkJobName(factor)));
  };
  return (
    <>
      <section>
        <h3>{words.pickTitle}</h3>
        <p className="note">{words.pickHint}</p>
        <Button kind="primary" disabled={place === null || at !== null} onClick={plot}>
          {at === null ? words.plotChecks : words.plottingCheck(at + 1, checks.length)}
        </Button>
        {hasStopped && (
          <p className="note note-error" role="alert">
            {words.stopped}
          </p>
        )}
      </section>
      <div className="ringing-pick">
        <SheetPicture
          labels={labels}
          nextMm={place?.nextMm ?? 10}
          chosen={chosen < 0 ? null : chosen}
          onChoose={(index) => void pick(index)}
        />
        <fieldset className="pick-list">
          <legend>{words.picks}</legend>
          {labels.map((label, i) => (
            <label key={label} className="pick">
              <input type="radio" name="picked-line" checked={i === chosen} onChange={() => void pick(i)} />
              {label}
            </label>
          ))}
          {isUnshapedPicked && <p className="note">{words.unshapedHint}</p>}
          {known && !isUnshapedPicked && (
            <p className="note" role="status">
              {words.saved(formatNumber(known.xHz, 1), formatNumber(known.yHz, 1))}
            </p>
          )}
        </fieldset>
      </div>
    </>
  );
};

/** Plots the sheet's jobs one after the other; `at` is the index of the running one. */
const useSheetPlot = () => {
  const store = usePageStore();
  const { plotJob } = useActions();
  const [at, setAt] = useState<number | null>(null);
  const [hasStopped, setStopped] = useState(false);
  const isOpen = useRef(true);
  useEffect(() => {
    isOpen.current = true;
    return () => {
      isOpen.current = false;
    };
  }, []);
  const run = async (jobs: readonly SheetJob[]): Promise<void> => {
    setStopped(false);
    for (let i = 0; i < jobs.length && isOpen.current; i++) {
      setAt(i);
      const job = await plotJob(jobs[i]);
      if (job === null || (await endOf(store, job.id)) !== "done") {
        setStopped(true);
        break;
      }
    }
    setAt(null);
  };
  return { run, at, hasStopped };
};

const UNFINISHED: readonly Job["state"][] = ["queued", "plotting", "paused"];

/** The job's final state; null: it was removed. */
const endOf = (store: PageStore, id: string): Promise<Job["state"] | null> =>
  new Promise((resolve) => {
    let isSeen = false;
    const check = (): boolean => {
      const job = store.getState().jobs.find((one) => one.id === id);
      isSeen ||= job !== undefined;
      // For a job that was just added, the server's event may not have arrived yet.
      if ((job === undefined && !isSeen) || (job && UNFINISHED.includes(job.state))) return false;
      resolve(job?.state ?? null);
      return true;
    };
    if (check()) return;
    const stop = store.subscribe(() => {
      if (check()) stop();
    });
  });
