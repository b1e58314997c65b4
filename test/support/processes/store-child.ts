/**
 * Changes a store endlessly until it is killed. Reports before each change the expected content ("try"), and
 * after it that it is stored ("done"). Arguments: DATA_DIR SEED
 */
import { writeSync } from "node:fs";
import { prepareDataDir } from "../../../server/storage/data-dir.js";
import { applyJobEvent, type JobEvent } from "../../../host/queue/job-states.js";
import { Store } from "../../../server/storage/store.js";
import { drawingOf, makeJob } from "../jobs/jobs.js";
import { pictureOf } from "./store-picture.js";

const [dataDir = "", seed = "1"] = process.argv.slice(2);
prepareDataDir(dataDir);
const store = Store.open(dataDir);
let random = Number(seed);
const next = (below: number): number => {
  random = (random * 1_103_515_245 + 12_345) % 2 ** 31;
  return Math.floor((random / 2 ** 31) * below);
};
const tell = (what: "try" | "done", picture: string): void => {
  writeSync(1, `${what} ${picture}\n`);
};

tell("done", pictureOf(store.jobs()));
for (let count = 0; ; count++) {
  const jobs = store.jobs();
  const queued = jobs.filter((job) => job.state === "queued");
  const choice = next(5);
  const any = queued[next(queued.length)];
  if (any === undefined || (choice === 0 && queued.length < 12)) {
    const job = makeJob(`${seed}-${count}`);
    const ended = jobs.filter((one) => one.state !== "queued");
    tell("try", pictureOf([...queued, job, ...ended]));
    store.addJob(job, drawingOf(job.id));
  } else if (choice === 1) {
    tell("try", pictureOf(jobs.filter((job) => job !== any)));
    store.removeJob(any.id);
  } else if (choice === 2) {
    const ended = jobs.filter((one) => one.state !== "queued");
    tell("try", pictureOf([...queued.filter((job) => job !== any), any, ...ended]));
    store.moveJob(any.id, null);
  } else {
    const event: JobEvent = { type: "cancel", place: null };
    const cancelled = applyJobEvent(any, event, new Date(2_000_000_000_000 + Date.now()).toISOString());
    tell(
      "try",
      pictureOf([
        ...jobs.filter((job) => job !== any && job.state === "queued"),
        cancelled,
        ...jobs.filter((job) => job.state !== "queued"),
      ]),
    );
    store.saveJob(cancelled);
  }
  tell("done", pictureOf(store.jobs()));
}
