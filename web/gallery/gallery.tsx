import { useEffect, useState } from "react";
import { ENDED_STATES, type JobPage } from "../../src/schema/index.js";
import { useActions, useIsConnected, useListedPlotter, usePageState } from "../state/use-store.js";
import { Button } from "../ui/button.js";
import { Sheet } from "../ui/dialog.js";
import { TextField } from "../ui/fields/text-field.js";
import { SheetGrid } from "./sheet-tile.js";
import { galleryText as words } from "./text.js";
import "./gallery.css";

/** All finished plots, newest first, in pages from the server: of thousands only one page is in the document. */
export const Gallery = () => {
  const [name, setName] = useState("");
  return (
    <Sheet title={words.title} className="dialog-wide">
      <CloseWhenOpened />
      <TextField label={words.search} isLabelInside value={name} maxLength={200} onChange={setName} />
      <Pages key={name} name={name.trim()} />
    </Sheet>
  );
};

/** A drawing that was opened from the dialog lies under it. */
export const CloseWhenOpened = () => {
  const key = usePageState((state) => state.drawing?.key);
  const [first] = useState(key);
  const { closeDialog } = useActions();
  useEffect(() => {
    if (key !== first) closeDialog();
  }, [key, first, closeDialog]);
  return null;
};

/** Not at each key press. */
export const TYPING_MS = 250;

const Pages = ({ name }: { name: string }) => {
  /** The last job before each page; undefined: the first page. */
  const [starts, setStarts] = useState<readonly (string | undefined)[]>([undefined]);
  const after = starts.at(-1);
  const page = usePageOf(name, after);
  if (page === null) return <div className="sheet-grid" aria-busy="true" />;
  const last = page.jobs.at(-1);
  const isFirst = starts.length === 1;
  return (
    <>
      <SheetGrid
        jobs={page.jobs}
        onRemoved={page.reload}
        empty={name === "" ? words.empty : words.nothingFound(name)}
      />
      {(page.hasOlderJobs || !isFirst) && (
        <div className="gallery-pages">
          <Button disabled={isFirst} onClick={() => setStarts(starts.slice(0, -1))}>
            {words.newer}
          </Button>
          <span className="note">{words.page(starts.length)}</span>
          <Button disabled={!page.hasOlderJobs || !last} onClick={() => setStarts([...starts, last?.id])}>
            {words.older}
          </Button>
        </div>
      )}
    </>
  );
};

/** Fetches a page, and again when a plot has ended or was removed. Null: it has not arrived. */
const usePageOf = (name: string, after: string | undefined) => {
  const { fetchHistory } = useActions();
  const plotterId = useListedPlotter();
  const jobs = usePageState((state) => state.jobs);
  const isConnected = useIsConnected();
  const newestId = jobs.find(({ state }) => ENDED_STATES.includes(state))?.id;
  const [reloads, setReloads] = useState(0);
  const [page, setPage] = useState<(JobPage & { readonly after: string | undefined }) | null>(null);
  useEffect(() => {
    let isCurrent = true;
    const timer = setTimeout(
      () =>
        void fetchHistory({ after, name, plotterId }).then((answer) => {
          if (isCurrent && answer !== null) setPage({ ...answer, after });
        }),
      name === "" ? 0 : TYPING_MS,
    );
    return () => {
      isCurrent = false;
      clearTimeout(timer);
    };
  }, [fetchHistory, name, after, plotterId, newestId, reloads, isConnected]);
  if (page === null || page.after !== after) return null;
  // The page's own list is newer: a job of it may be plotted again meanwhile.
  const known = new Map(jobs.map((job) => [job.id, job]));
  const shown = page.jobs
    .map((job) => known.get(job.id) ?? job)
    .filter(({ state }) => ENDED_STATES.includes(state));
  return { jobs: shown, hasOlderJobs: page.hasOlderJobs, reload: () => setReloads(reloads + 1) };
};
