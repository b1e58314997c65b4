/** Requests about plotters, access, webhooks and the shared queue. */
import type {
  NewKey,
  NewPlotter,
  NewSharedJob,
  NewWebhook,
  PlotterPatch,
  SharedJob,
} from "../../src/schema/index.js";
import type { Backend, StudioBackend } from "../backend/backend.js";
import type { Actions } from "../state/actions.js";
import type { DrawingText } from "../worker/drawing-text.js";

export type StudioApi = ReturnType<typeof studioApi>;

/** Each returns null if it failed, and the user has seen why. */
export const studioApi = (backend: Backend, { attempt }: Pick<Actions, "attempt">) => {
  const ask = <T>(name: string, request: (studio: StudioBackend) => Promise<T>): Promise<T | null> =>
    attempt(name, async () => request(await backend.studio()));
  return {
    devices: () => ask("devices", (studio) => studio.devices()),
    addPlotter: (plotter: NewPlotter) => ask("plotter", (studio) => studio.addPlotter(plotter)),
    patchPlotter: (id: string, patch: PlotterPatch) =>
      ask("plotter", (studio) => studio.patchPlotter(id, patch)),
    removePlotter: (id: string) => ask("plotter", (studio) => done(studio.removePlotter(id))),
    pairing: () => ask("pairing", (studio) => studio.pairing()),
    access: () => ask("access", (studio) => studio.access()),
    addKey: (key: NewKey) => ask("key", (studio) => studio.addKey(key)),
    revoke: (id: string) => ask("access", (studio) => done(studio.revoke(id))),
    webhooks: () => ask("webhooks", (studio) => studio.webhooks()),
    addWebhook: (webhook: NewWebhook) => ask("webhook", (studio) => studio.addWebhook(webhook)),
    /** Polled while it is shown, so a failure is ignored. `jobs` is null if there is no shared queue. */
    sharedJobs: async (): Promise<{ readonly jobs: readonly SharedJob[] | null } | null> => {
      try {
        return { jobs: await (await backend.studio()).sharedJobs() };
      } catch {
        return null;
      }
    },
    shareJob: (job: Omit<NewSharedJob, "drawing">, drawing: DrawingText) =>
      ask("share", (studio) => done(studio.shareJob(job, drawing))),
    giveBackShared: (id: string) => ask("shared-job", (studio) => done(studio.giveBackShared(id))),
    withdrawShared: (id: string) => ask("shared-job", (studio) => done(studio.withdrawShared(id))),
    removeWebhook: (id: string) => ask("webhook", (studio) => done(studio.removeWebhook(id))),
  };
};

/** For requests without an answer, so that null still means failure. */
const done = async (request: Promise<void>): Promise<true> => {
  await request;
  return true;
};
