/** The plug-in that queues the drawings of a folder. */
import type { ServerPlugin } from "../server-plugin.js";
import { WatchFolder } from "./watch-folder.js";

export function watchFolderPlugin(dir: string): ServerPlugin {
  return {
    name: "the watched folder",
    start: async (host) => {
      const folder = await WatchFolder.open(dir, host);
      return { close: () => folder.close() };
    },
  };
}
