import { useCallback, useEffect, useState } from "react";
import type { MachineProfile } from "../../src/index.js";
import { findMachine } from "../../src/internal.js";
import {
  withoutPlotterPart,
  type Plotter,
  type SharedJob,
  type SharedTarget,
  SERVER_LOST_AFTER_MS,
} from "../../src/schema/index.js";
import { BackendFault, type Backend } from "../backend/backend.js";
import { profileOf } from "../state/plotter-sync.js";
import { textOfDrawing } from "../state/sheet-actions.js";
import { useActions, useBackend, usePageState } from "../state/use-store.js";
import { sharingText as words } from "./text.js";
import { Button } from "../ui/button.js";
import { Select } from "../ui/fields/choice.js";
import { formatWhen } from "../ui/format.js";
import { useNow } from "../ui/use-now.js";
import { useFetched, useSharing } from "./use-sharing.js";

const POLL_MS = 3_000;

/** The shared queue: its jobs, which server took them, and adding the current drawing. */
export const SharedSection = () => {
  const backend = useBackend();
  const [answer, askAgain] = useFetched(useCallback(() => sharedJobs(backend), [backend]));
  useEffect(() => {
    const timer = setInterval(askAgain, POLL_MS);
    return () => clearInterval(timer);
  }, [askAgain]);
  if (answer?.jobs === null) {
    return (
      <ul className="sharing-list">
        <li className="note">{words.notShared}</li>
      </ul>
    );
  }
  return (
    <>
      <p className="note">{words.sharedHint}</p>
      <ul className="sharing-list">
        {(answer?.jobs ?? []).map((job) => (
          <SharedRow key={job.id} job={job} onChanged={askAgain} />
        ))}
        {answer?.jobs.length === 0 && <li className="note">{words.noShared}</li>}
      </ul>
      <ShareForm onSent={askAgain} />
    </>
  );
};

/**
 * Polled while it is shown, so a failure is ignored: null. `jobs` is null if there is no shared queue.
 */
const sharedJobs = async (
  backend: Backend,
): Promise<{ readonly jobs: readonly SharedJob[] | null } | null> => {
  try {
    return await backend.sharedJobs.list();
  } catch (error) {
    return error instanceof BackendFault && error.code === "not-found" ? { jobs: null } : null;
  }
};

const SharedRow = ({ job, onChanged }: { job: SharedJob; onChanged(): void }) => {
  const sharing = useSharing();
  const nowMs = useNow();
  const action = possibleAction(job, nowMs);
  const plotters = usePageState((state) => state.plotters);
  const machine = usePageState((state) => profileOf(state, machineWanted(job)));
  const parts = [
    words.sharedStates[job.state],
    machine === null ? words.sharedFor(job.target) : words.sharedForAny(machine.name),
    ...(job.server !== null ? [words.sharedWith(job.server)] : []),
    ...(job.hasBegun ? [words.sharedBegun] : []),
    ...(isServerGone(job, nowMs) ? [words.sharedGone] : []),
    formatWhen(job.createdAt, nowMs),
  ];
  const runAction = async (): Promise<void> => {
    await (action === "withdraw" ? sharing.sharedJobs.withdraw(job.id) : sharing.sharedJobs.giveBack(job.id));
    onChanged();
  };
  return (
    <li>
      <span>
        <strong>{job.name}</strong>
        <span className="note">{parts.join(", ")}</span>
        {job.message !== null && <span className="note note-error">{job.message}</span>}
        {action === "give-back" && <span className="note">{words.giveBackHint}</span>}
        {leftOut(job, plotters).map((plotter) => (
          <LeftOut key={plotter.id} plotter={plotter} machine={machine} />
        ))}
      </span>
      {action !== null && (
        <Button
          kind="small"
          aria-label={(action === "withdraw" ? words.withdrawNamed : words.giveBackNamed)(job.name)}
          onClick={() => void runAction()}
        >
          {action === "withdraw" ? words.withdraw : words.giveBack}
        </Button>
      )}
    </li>
  );
};

interface LeftOutProps {
  readonly plotter: Plotter;
  readonly machine: MachineProfile | null;
}

/** A plotter without a model, and a button that sets the one that the job needs. */
const LeftOut = ({ plotter, machine }: LeftOutProps) => {
  const sharing = useSharing();
  return (
    <span className="note left-out">
      {words.modelUnknown(plotter.name)}
      {machine !== null && (
        <Button
          kind="small"
          aria-label={words.isOfModelNamed(machine.name, plotter.name)}
          onClick={() => void sharing.plotters.patch(plotter.id, { machine: machine.id })}
        >
          {words.isOfModel(machine.name)}
        </Button>
      )}
    </span>
  );
};

const ANY = "machine";

const ShareForm = ({ onSent }: { onSent(): void }) => {
  const sharing = useSharing();
  const actions = useActions();
  const drawing = usePageState((state) => state.drawing);
  const settings = usePageState((state) => state.settings);
  const plotters = usePageState((state) => state.plotters);
  const [to, setTo] = useState(ANY);
  if (!drawing) return <p className="note">{words.shareNothing}</p>;
  const machine = findMachine(settings)?.name ?? settings.machine;
  const named = plotters.find(({ id }) => id === to);
  const target: SharedTarget = named ? { plotter: named.name } : { machine: settings.machine };
  const send = async (): Promise<void> => {
    const uploaded = await sharing.drawings.upload(await textOfDrawing(drawing, settings));
    const job = { name: drawing.name, settings: withoutPlotterPart(settings), target };
    if (!uploaded || !(await sharing.sharedJobs.add({ ...job, drawingId: uploaded.id }))) return;
    actions.notify("info", words.shareSent(drawing.name));
    onSent();
  };
  return (
    <form
      className="sharing-form"
      onSubmit={(event) => {
        event.preventDefault();
        void send();
      }}
    >
      <h3>{words.shareThis}</h3>
      <Select
        label={words.shareFor}
        value={named ? to : ANY}
        options={[
          { value: ANY, label: words.anyMachine(machine) },
          ...plotters.map(({ id, name }) => ({ value: id, label: name })),
        ]}
        onChange={setTo}
      />
      <Button type="submit">{words.shareSend(drawing.name)}</Button>
    </form>
  );
};

/** The server that took the job has not reported for long. It may be off, or have no connection. */
export const isServerGone = ({ state, serverSeenAt }: SharedJob, nowMs: number): boolean =>
  (state === "taken" || state === "stored") &&
  (serverSeenAt === null || nowMs - Date.parse(serverSeenAt) > SERVER_LOST_AFTER_MS);

export const possibleAction = (job: SharedJob, nowMs: number): "withdraw" | "give-back" | null => {
  if (job.state === "waiting") return "withdraw";
  return isServerGone(job, nowMs) && !job.hasBegun ? "give-back" : null;
};

/** For a job that any plotter of one machine may take: the machine's id. Null for a job of a named plotter. */
export const machineWanted = ({ target }: SharedJob): string | null =>
  /^machine (.+)$/.exec(target)?.[1] ?? null;

/** This server's plotters that can't take a waiting job because their model is not set. */
export const leftOut = (job: SharedJob, plotters: readonly Plotter[]): readonly Plotter[] =>
  job.state === "waiting" && machineWanted(job) !== null
    ? plotters.filter(({ machine }) => machine === null)
    : [];
