/** The plug-in that announces plotwright.local on the network. It probes for the name of the last run first. */
import type { ServerPlugin } from "../server-plugin.js";
import { LocalName } from "./local-name.js";

const SETTING = "local-name";

export function localNamePlugin(): ServerPlugin {
  return {
    name: "the mDNS name",
    start: ({ store, log, setLocalName }) => {
      let localName: LocalName | null = null;
      const last = store.setting(SETTING);
      const onName = (name: string | null): void => {
        try {
          if (name !== null) store.saveSetting(SETTING, name);
        } catch (error) {
          log(`the local name is not stored: ${(error as Error).message}`);
        }
        setLocalName(name);
      };
      return {
        listening: (address) => {
          localName = new LocalName({
            ...address,
            log,
            onName,
            last: typeof last === "string" ? last : undefined,
          });
        },
        close: () => localName?.close(),
      };
    },
  };
}
