/** Commands to one job of a running server. */
import { PlotwrightError } from "../../../src/index.js";
import { printableJson } from "../../../src/internal.js";
import type { Job, JobState } from "../../../src/schema/index.js";
import { printed, row, type CliIo } from "../io.js";
import { JobPlot } from "./job-plot.js";
import { addJson, type Declare } from "../options.js";
import { plotReport } from "./plot-report.js";
import { cancelled } from "./plot-watch.js";
import { accessOf, addServer, serverState } from "../client/server-client.js";
import { serverClient, type ServerClient } from "../../../host/handle/server-client.js";

type JobCommandOptions = Parameters<typeof accessOf>[0] & { readonly json?: boolean };

/** The state of the jobs that a command is for, if it names none. */
const RUNNING: readonly JobState[] = ["plotting", "paused"];

const onJob =
  (usual: readonly JobState[], act: (client: ServerClient, job: Job) => Promise<Job | void>): Declare =>
  (command, { io }) => {
    const argument =
      usual.length === 0 ? command.argument("<job>", JOB) : command.argument("[job]", JOB_OR_ONLY);
    addJson(addServer(argument)).action(async (wanted: string | undefined, options: JobCommandOptions) => {
      const access = accessOf(options);
      const { jobs } = await serverState(access);
      const job = jobOf(jobs, wanted, usual);
      printJob((await act(serverClient(access), job)) ?? job, options, io);
    });
  };

const JOB = "its id or the beginning of it, or its name";
const JOB_OR_ONLY = `${JOB} (default: the only one in question)`;

export const declareStart = onJob(["queued"], (client, { id }) => client.jobs.start(id));
export const declarePause = onJob(["plotting"], (client, { id }) => client.jobs.pause(id));
export const declareCancel = onJob(RUNNING, (client, { id }) => client.jobs.cancel(id));
export const declareRemove = onJob([], (client, { id }) => client.jobs.remove(id).then(() => undefined));
/** An interrupted or cancelled job is paused at first, so that its user can check pen and paper. */
export const declareResume = onJob(["paused", "interrupted"], (client, { id, state }) =>
  state === "paused" ? client.jobs.resume(id) : client.jobs.recover(id),
);

export const declareFollow: Declare = (command, { io, setExitCode }) => {
  addJson(addServer(command.argument("[job]", JOB_OR_ONLY))).action(
    async (wanted: string | undefined, options: JobCommandOptions) => {
      const access = accessOf(options);
      const { jobs } = await serverState(access);
      const job = jobOf(jobs, wanted, RUNNING);
      setExitCode(await followJob(new JobPlot(serverClient(access), job.id), job, options, io));
    },
  );
};

/** Shows the progress until the job ends. Ctrl-C ends only this command. */
async function followJob(
  run: JobPlot,
  { name }: Job,
  options: JobCommandOptions,
  io: CliIo,
): Promise<number> {
  const report = plotReport(name, options, io);
  let isLeft = false;
  const forget = io.onInterrupt(() => {
    isLeft = true;
    void run.interrupt();
  });
  run.onProgress((progress) => report.progress(progress));
  run.onHeld((held, wait) => {
    report.held(held, wait);
    if (!held || options.json === true) return;
    io.err(wait === null ? "Paused.\n" : printed`It waits for the pen of "${wait.layerName}".\n`);
  });
  report.begins("Following");
  try {
    const { kind } = await run.finished;
    if (isLeft) return 0;
    report.ends(kind);
    return kind === "done" ? 0 : cancelled(io);
  } finally {
    io.status("");
    forget();
  }
}

/** The job with that id or name; if none is named, the only one in a usual state. */
function jobOf(jobs: readonly Job[], wanted: string | undefined, usual: readonly JobState[]): Job {
  const isUsual = ({ state }: Job): boolean => usual.includes(state);
  if (wanted === undefined) {
    const [job, ...others] = jobs.filter(isUsual);
    if (job === undefined) throw fault(`No job is ${usual.join(" or ")}`, jobs);
    // The first job of the queue is the next one.
    if (others.length > 0 && job.state !== "queued") throw fault("Say which job", [job, ...others]);
    return job;
  }
  if (wanted === "") throw fault("The name of the job is empty", jobs);
  const exact = jobs.find(({ id }) => id === wanted);
  if (exact !== undefined) return exact;
  const found = jobs.filter(({ id, name }) => id.startsWith(wanted) || name === wanted);
  const likely = found.length > 1 && found.some(isUsual) ? found.filter(isUsual) : found;
  if (likely.length === 1) return likely[0];
  throw likely.length === 0
    ? fault(`The server has no job ${wanted}`, jobs)
    : fault(`Several jobs are called ${wanted}: name one by its id`, likely);
}

const MAX_NAMED = 8;

function fault(what: string, jobs: readonly Job[]): PlotwrightError {
  const named = jobs.slice(0, MAX_NAMED).map(({ id, name, state }) => `${id} (${name}, ${state})`);
  const list = named.length === 0 ? "It has none." : `Jobs: ${named.join(", ")}.`;
  return new PlotwrightError("bad-setting", `${what}. ${list}`);
}

function printJob(job: Job, { json }: JobCommandOptions, io: CliIo): void {
  io.out(json === true ? `${printableJson(job)}\n` : row(job.id, job.state, job.name));
  if (json !== true && job.message !== null) io.err(printed`${job.message}\n`);
}
