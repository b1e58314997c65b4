/** The plug-in that reads cameras and keeps their pictures with the jobs. */
import { PlotwrightError } from "../../../src/index.js";
import type { ServerHandlers } from "../../http/operation-routes.js";
import type { PluginCore, PluginHost, ServerPlugin } from "../server-plugin.js";
import { Cameras } from "./cameras.js";
import { PictureFiles } from "./picture-files.js";

export function cameraPlugin({ store, plotters, log, dataDir }: PluginCore): ServerPlugin {
  const files = new PictureFiles(dataDir);
  const plotterName = (id: string): string => plotters.get(id)?.snapshot().name ?? id;
  const cameras = new Cameras({ store, files, plotterName, log });
  return {
    name: "the cameras",
    jobs: {
      withChange: (before, after) => cameras.changed(before, after),
      onRemoved: (jobId) => cameras.removed(jobId),
    },
    start: (host) => {
      const ids = new Set(store.jobs().map(({ id }) => id));
      cameras.sweep((id) => ids.has(id));
      return {
        operations: { cameras: cameraOperations(host, cameras, files) },
        close: () => cameras.close(),
      };
    },
  };
}

const cameraOperations = ({ plotters, queue }: PluginHost, cameras: Cameras, files: PictureFiles) => {
  const mustExist = (plotterId: string): string => {
    if (plotters.has(plotterId)) return plotterId;
    throw new PlotwrightError("not-found", `There is no plotter ${plotterId}.`);
  };
  return {
    get: (id) => cameras.state(mustExist(id)),
    set: (id, camera) => {
      cameras.keepOnly((one) => plotters.has(one));
      return cameras.set(mustExist(id), camera);
    },
    remove: (id) => cameras.remove(mustExist(id)),
    pictures: async (id) => {
      const { id: jobId } = queue.get(id);
      const kept = await files.list(jobId);
      return {
        pictures: kept.map(({ atMs, bytes }) => ({ at: new Date(atMs).toISOString(), bytes })),
        missing: await files.missing(jobId),
      };
    },
    picture: async (id, { at }) => {
      const bytes = await files.read(queue.get(id).id, Date.parse(at));
      return new Uint8Array(bytes).buffer;
    },
  } satisfies ServerHandlers["cameras"];
};
