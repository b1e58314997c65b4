/** Takes pictures of the running plots with the cameras of their plotters. Faults of a camera never reach the plot. */
import { isDeepStrictEqual } from "node:util";
import { z } from "zod";
import { cameraSchema, type Camera, type CameraState, type Job } from "../../../src/schema/index.js";
import { CameraFault, fetchPicture, type CameraPicture } from "./fetch-picture.js";
import type { PictureFiles } from "./picture-files.js";

interface CameraParts {
  readonly store: {
    setting(key: string): unknown;
    saveSetting(key: string, value: unknown): void;
  };
  readonly files: Pick<PictureFiles, "add" | "addMissing" | "remove" | "sweep">;
  readonly plotterName: (id: string) => string;
  readonly log: (line: string) => void;
  readonly fetch?: (address: string, stop: AbortSignal) => Promise<CameraPicture>;
  readonly nowMs?: () => number;
}

/** In the store: the cameras by plotter id. */
const KEY = "cameras";
const camerasSchema = z.record(z.string(), cameraSchema);

export class Cameras {
  private cameras: Readonly<Record<string, Camera>>;
  private readonly lastTries = new Map<string, CameraState["last"]>();
  /** The jobs that are being plotted, by plotter id, and what stops taking their pictures. */
  private readonly plotting = new Map<string, { readonly jobId: string; readonly stop: AbortController }>();
  /** Jobs that were removed. */
  private readonly gone = new Set<string>();
  private readonly running = new Set<Promise<unknown>>();
  /** Why the last change of the stored pictures failed. */
  private storeFault: string | null = null;
  private readonly closing = new AbortController();
  private readonly fetch: NonNullable<CameraParts["fetch"]>;
  private readonly nowMs: () => number;

  constructor(private readonly parts: CameraParts) {
    this.cameras = camerasSchema.safeParse(parts.store.setting(KEY) ?? {}).data ?? {};
    this.fetch = parts.fetch ?? fetchPicture;
    this.nowMs = parts.nowMs ?? Date.now;
  }

  state(plotterId: string): CameraState {
    return { camera: this.cameras[plotterId] ?? null, last: this.lastTries.get(plotterId) ?? null };
  }

  /** Sets the camera and tries it. `last` of the answer says whether it works; it is kept in either case. */
  async set(plotterId: string, camera: Camera): Promise<CameraState> {
    this.save({ ...this.cameras, [plotterId]: camera });
    await this.picture(plotterId, camera);
    this.followAgain(plotterId);
    return this.state(plotterId);
  }

  remove(plotterId: string): void {
    this.keepOnly((id) => id !== plotterId);
    this.lastTries.delete(plotterId);
    this.followAgain(plotterId);
  }

  /** Forgets the cameras of plotters that were removed. */
  keepOnly(isPlotter: (id: string) => boolean): void {
    const kept = Object.fromEntries(Object.entries(this.cameras).filter(([id]) => isPlotter(id)));
    if (!isDeepStrictEqual(kept, this.cameras)) this.save(kept);
  }

  /** A picture at once, then one every few seconds as long as the job moves, and one of what is done. */
  changed(before: Job | null, { id, plotterId, state }: Job): void {
    const isSame = this.plotting.get(plotterId)?.jobId === id;
    if (state === "plotting" && !isSame) {
      // Those of an earlier plot of this job.
      const isNew = before?.state === "queued";
      this.begin(plotterId, id, isNew);
    } else if (state !== "plotting" && isSame) {
      this.end(plotterId);
      if (state === "done") this.track(this.keep(plotterId, id));
    }
  }

  /** A picture of a removed job that is still being taken is not kept. */
  removed(jobId: string): void {
    this.gone.add(jobId);
    this.track(this.parts.files.remove(jobId));
  }

  /** Removes the pictures of jobs that have been missing for long. */
  sweep(isJob: (id: string) => boolean): void {
    this.track(this.parts.files.sweep(isJob, this.nowMs()));
  }

  async close(): Promise<void> {
    this.closing.abort();
    for (const plotterId of [...this.plotting.keys()]) this.end(plotterId);
    await Promise.all(this.running);
  }

  private save(cameras: Readonly<Record<string, Camera>>): void {
    this.parts.store.saveSetting(KEY, cameras);
    this.cameras = cameras;
  }

  private begin(plotterId: string, jobId: string, isNew: boolean): void {
    this.end(plotterId);
    const stop = new AbortController();
    this.plotting.set(plotterId, { jobId, stop });
    if (isNew) this.track(this.parts.files.remove(jobId));
    this.track(this.follow(plotterId, jobId, stop.signal));
  }

  private end(plotterId: string): void {
    this.plotting.get(plotterId)?.stop.abort();
    this.plotting.delete(plotterId);
  }

  /** With another camera, or none. */
  private followAgain(plotterId: string): void {
    const now = this.plotting.get(plotterId);
    if (now !== undefined) this.begin(plotterId, now.jobId, false);
  }

  private async follow(plotterId: string, jobId: string, stop: AbortSignal): Promise<void> {
    for (;;) {
      const camera = this.cameras[plotterId];
      if (camera === undefined || stop.aborted) return;
      const beganMs = this.nowMs();
      await this.keep(plotterId, jobId);
      await pause(Math.max(0, beganMs + 1_000 * camera.everyS - this.nowMs()), stop);
    }
  }

  private async keep(plotterId: string, jobId: string): Promise<void> {
    const camera = this.cameras[plotterId];
    const picture = camera && (await this.picture(plotterId, camera));
    if (!camera || this.gone.has(jobId) || this.closing.signal.aborted) return;
    if (picture && (await this.isDone(this.parts.files.add(jobId, picture, this.nowMs())))) {
      this.storeFault = null;
    } else await this.isDone(this.parts.files.addMissing(jobId));
  }

  /** Waits for a change of the stored pictures. False: it failed, such as on a full disk, which is logged once. */
  private async isDone(change: Promise<void>): Promise<boolean> {
    try {
      await change;
      return true;
    } catch (error) {
      // The message has the name of the file.
      const fault = (error as NodeJS.ErrnoException).code ?? String(error);
      if (fault !== this.storeFault)
        this.parts.log(`the pictures of a job can't be changed: ${String(error)}`);
      this.storeFault = fault;
      return false;
    }
  }

  /** Null: the camera has none; that is logged once. */
  private async picture(plotterId: string, { url }: Camera): Promise<CameraPicture | null> {
    let picture: CameraPicture | null = null;
    let fault: string | null = null;
    try {
      picture = await this.fetch(url, this.closing.signal);
    } catch (error) {
      if (this.closing.signal.aborted) return null;
      // Others might have the address, with its password.
      fault = error instanceof CameraFault ? error.message : "The camera can't be reached.";
    }
    const before = this.lastTries.get(plotterId)?.fault ?? null;
    this.lastTries.set(plotterId, { at: new Date(this.nowMs()).toISOString(), fault });
    const of = `camera of ${JSON.stringify(this.parts.plotterName(plotterId))}`;
    if (fault !== null && fault !== before) this.parts.log(`${of}: ${fault}`);
    if (fault === null && before !== null) this.parts.log(`${of}: it works again`);
    return picture;
  }

  private track(work: Promise<void>): void {
    const tracked: Promise<unknown> = this.isDone(work).finally(() => this.running.delete(tracked));
    this.running.add(tracked);
  }
}

/** Ends early when stopped. Does not keep the program running. */
const pause = (ms: number, stop: AbortSignal): Promise<void> =>
  new Promise((resolve) => {
    if (stop.aborted) return resolve();
    const done = (): void => {
      clearTimeout(timer);
      stop.removeEventListener("abort", done);
      resolve();
    };
    const timer = setTimeout(done, ms);
    timer.unref();
    stop.addEventListener("abort", done);
  });
