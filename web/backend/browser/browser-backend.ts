/** The page's backend without a server: a worker of the page, or of another tab, operates the plotter. */
import { clientOf, OPERATIONS, type OperationGroup, type ServerEvent } from "../../../src/schema/index.js";
import { BackendFault, type Backend } from "../backend.js";
import { whyNoPort } from "./capabilities.js";
import { HostClient } from "./host-client.js";
import { browserText } from "./text.js";

/** `?virtual-speed=50`: how many times faster than real time the virtual board runs. */
const virtualSpeed = (): number => {
  const speed = Number(new URLSearchParams(location.search).get("virtual-speed") ?? 1);
  return speed >= 1 && speed <= 1_000 ? speed : 1;
};

/** `sampleFiles`: the files of samples/ in the build. */
export const createBrowserBackend = (sampleFiles: SampleFiles): Backend => {
  const client = new HostClient(virtualSpeed());
  watchOverPlots(client);
  const operations = clientOf(OPERATIONS, (_one, input, group, name) =>
    client.call({ group: group as OperationGroup, name, input }),
  );
  return {
    ...operations,
    state: {
      ...operations.state,
      me: () => Promise.resolve({ role: "operate", id: client.tab, name: null }),
    },
    operator: {
      ...operations.operator,
      take: async () => {
        await client.takeOver();
        return { operator: { id: client.tab, name: "" } };
      },
    },
    samples: {
      list: () => Promise.resolve({ samples: sampleList(sampleFiles) }),
      get: (name) => sampleText(sampleFiles, name),
    },
    features: { sharing: false, library: false, asksForPort: true, whyNoPort: whyNoPort() },
    listen: (listener) => client.listen(listener),
    live: async (id, wanted) => {
      const { beginLive } = await import("../live.js");
      return beginLive((report, lost) => client.openLive(id, report, lost), wanted);
    },
    connect: async (id) => {
      await askForPort(client);
      return client.callOwn("reconnect", id);
    },
    fileOf: async ({ of, id }, maxBytes) => {
      const file = of === "job" ? await operations.jobs.drawing(id) : await sampleText(sampleFiles, id);
      return (typeof file === "string" ? file.length : file.byteLength) > maxBytes ? null : file;
    },
  };
};

/** Opens the browser's own dialog, which works only in a click handler. */
const askForPort = async (client: HostClient): Promise<void> => {
  const reason = whyNoPort();
  if (reason !== null) throw new BackendFault("not-allowed", reason);
  const filters = await client.callOwn("portFilters");
  try {
    await (navigator as { serial: Serial }).serial.requestPort({ filters });
  } catch {
    throw new BackendFault("no-board", browserText.noneChosen);
  }
};

/** By the file's path: a function that loads its URL. */
type SampleFiles = Readonly<Record<string, () => Promise<string>>>;

const nameOf = (path: string): string => path.replace(/^.*\//, "");

/** "many-short-strokes.svg" -> "Many short strokes" */
const titleOf = (name: string): string => {
  const words = name.replace(/\.svg$/, "").replaceAll("-", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
};

const sampleList = (files: SampleFiles): { readonly name: string; readonly title: string }[] =>
  Object.keys(files)
    .map(nameOf)
    .sort()
    .map((name) => ({ name, title: titleOf(name) }));

const sampleText = async (files: SampleFiles, name: string): Promise<string> => {
  const load = Object.entries(files).find(([path]) => nameOf(path) === name)?.[1];
  const response = await load?.()
    .then((url) => fetch(url))
    .catch(() => null);
  if (response?.ok !== true) throw new BackendFault("unreachable", browserText.sampleMissing(name));
  return response.text();
};

/** While this page runs a plot: keeps the screen on, and asks before the page is closed. */
const watchOverPlots = (client: HostClient): void => {
  const plotting = new Set<string>();
  let wakeLock: Promise<WakeLockSentinel | null> | null = null;
  const isHere = (): boolean => client.isHost && plotting.size > 0;

  const keepAwake = (): void => {
    if (!isHere()) {
      void wakeLock?.then((sentinel) => sentinel?.release());
      wakeLock = null;
    } else if (wakeLock === null && "wakeLock" in navigator && document.visibilityState === "visible") {
      // If it is refused (low battery), the computer's own settings apply.
      wakeLock = navigator.wakeLock.request("screen").catch(() => null);
    }
  };
  const note = (id: string, state: string): void => {
    if (state === "plotting") plotting.add(id);
    else plotting.delete(id);
  };
  const onEvent = (event: ServerEvent): void => {
    if (event.type === "snapshot") {
      plotting.clear();
      for (const { id, state } of event.snapshot.jobs) note(id, state);
    } else if (event.type === "job") note(event.job.id, event.job.state);
    else return;
    keepAwake();
  };

  client.listen({ onEvent, onLink: () => undefined });
  // The browser releases the lock when the page is hidden.
  document.addEventListener("visibilitychange", () => {
    if (document.visibilityState === "visible") {
      wakeLock = null;
      keepAwake();
    }
  });
  window.addEventListener("beforeunload", (event) => {
    if (isHere()) event.preventDefault();
  });
};
