import { execFileSync } from "node:child_process";
import fs, {
  mkdirSync,
  readFileSync,
  renameSync,
  rmSync,
  symlinkSync,
  truncateSync,
  writeFileSync,
} from "node:fs";
import { syncBuiltinESMExports } from "node:module";
import { createServer } from "node:net";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { prepareDataDir } from "../../../../server/storage/data-dir.js";
import { DrawingFiles } from "../../../../server/storage/drawing-files.js";
import { JobQueue } from "../../../../host/queue/job-queue.js";
import { Notices } from "../../../../host/queue/notices.js";
import type { Planning } from "../../../../host/planning/planning.js";
import { Store } from "../../../../server/storage/store.js";
import { withDrawing } from "../../../../server/plugins/watch-folder/watched-file.js";
import { WatchFolder } from "../../../../server/plugins/watch-folder/watch-folder.js";
import { PlotwrightError } from "../../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { LED_PLANNING, LedPlotter } from "../../../support/jobs/led-plotter.js";
import { folderOfTest } from "../../../support/processes/folders.js";

let dir: string;
let watched: string;
let store: Store;
let queue: JobQueue;
let notices: Notices;
let folder: WatchFolder;
let logged: string[];
let planning: Planning;

beforeEach(() => {
  dir = folderOfTest();
  watched = join(dir, "in");
  mkdirSync(watched);
  prepareDataDir(dir);
  logged = [];
  planning = LED_PLANNING;
});
afterEach(async () => {
  await close();
});

async function open(stableMs = 100): Promise<void> {
  store = Store.open(dir);
  const plotter = new LedPlotter();
  const files = new DrawingFiles(dir, 100_000);
  const announce = (): void => undefined;
  const nowIso = (): string => new Date().toISOString();
  queue = new JobQueue({
    store,
    files,
    planning,
    plotters: new Map([[plotter.id, plotter]]),
    announce,
    nowIso,
  });
  notices = new Notices({ store, announce, nowIso });
  const log = (line: string): void => void logged.push(line);
  folder = await WatchFolder.open(watched, { queue, files, store, notices, log, stableMs });
}
async function close(): Promise<void> {
  await folder.close();
  await queue.close();
  store.close();
}
const put = (name: string, text = `<svg>${name}</svg>`): void => writeFileSync(join(watched, name), text);
const names = (): string[] => queue.list().map(({ name }) => name);
const queued = (...wanted: string[]): Promise<void> =>
  expect.poll(() => [...names()].sort()).toEqual([...wanted].sort());

/** Runs `work` when a folder has been read and is not watched yet. */
function justBeforeWatching(folder: string, work: () => void): void {
  const { watch } = fs;
  const replace = (by: typeof watch): void => {
    fs.watch = by;
    syncBuiltinESMExports();
  };
  const first = (...args: Parameters<typeof watch>): fs.FSWatcher => {
    if (args[0] === folder) {
      replace(watch);
      work();
    }
    return watch(...args);
  };
  replace(first as typeof watch);
}

describe("the watched folder", () => {
  it("queues a drawing that is saved while the folder is being opened, once", async () => {
    put("early.svg");
    mkdirSync(join(watched, "folder"));
    put("folder/not-watched.svg");
    let isSaved = false;
    justBeforeWatching(watched, () => {
      put("meanwhile.svg");
      isSaved = true;
    });
    await open();
    await queued("early.svg", "meanwhile.svg");
    expect(isSaved).toBe(true);
    put("late.svg");
    await queued("early.svg", "meanwhile.svg", "late.svg");
  });

  it("queues present and new files, once each, and nothing twice after a restart", async () => {
    put("a.svg");
    await open();
    await queued("a.svg");
    put("b.dxf");
    put("notes.txt");
    put(".hidden.svg");
    await queued("a.svg", "b.dxf");
    // Exported again with the same content, or temporarily under another name.
    put("a.svg");
    renameSync(join(watched, "b.dxf"), join(watched, "c.tmp"));
    renameSync(join(watched, "c.tmp"), join(watched, "b.dxf"));
    await close();
    put("late.svg");
    await open();
    await queued("a.svg", "b.dxf", "late.svg");
    put("a.svg", "<svg>changed</svg>");
    await queued("a.svg", "a.svg", "b.dxf", "late.svg");
  });

  it("takes every readable format, and no settings files", async () => {
    await open();
    for (const name of ["settings.json", "a.settings.json", "notes.txt", "a.hgl", "b.json", "c.PLT"])
      put(name, "{}");
    await queued("a.hgl", "b.json", "c.PLT");
  });

  it("takes a file only when its size is stable", async () => {
    await open(1_500);
    const whole = "<svg><!-- 1 2 3 4 5 6 --></svg>";
    for (let length = 5; length < whole.length; length += 5) {
      put("slow.svg", whole.slice(0, length));
      await new Promise((resolve) => setImmediate(resolve));
    }
    put("slow.svg", whole);
    await queued("slow.svg");
    put("next.svg");
    await queued("slow.svg", "next.svg");
    const slow = queue.list().find(({ name }) => name === "slow.svg");
    expect(readFileSync(new DrawingFiles(dir, 1).path(queue.drawingOf(slow?.id ?? "")), "utf8")).toBe(whole);
  });

  it("names what can't be plotted in the log and in a notice, once, and continues", async () => {
    planning = {
      ...LED_PLANNING,
      measure: (...args) =>
        notices.list().length === 0
          ? Promise.reject(new PlotwrightError("bad-file", "The file breaks off."))
          : LED_PLANNING.measure(...args),
    };
    put("torn.svg");
    await open();
    await expect.poll(() => notices.list().length).toBe(1);
    const message = '"torn.svg" in the watched folder can\'t be plotted: The file breaks off.';
    expect(notices.list()[0]?.message).toBe(message);
    expect(logged).toContain(message);
    put("empty.svg", "");
    put("huge.svg", "x".repeat(100_001));
    put("good.svg");
    await queued("good.svg");
    await expect.poll(() => notices.list().length).toBe(3);
    await close();
    await open();
    put("more.svg");
    await queued("good.svg", "more.svg");
    expect(notices.list()).toHaveLength(3);
  });

  it("tries again after an error that may pass, with one notice, when the file is saved again or it restarts", async () => {
    let failuresLeft = 2;
    planning = {
      ...LED_PLANNING,
      measure: (...args) =>
        failuresLeft-- > 0
          ? Promise.reject(new PlotwrightError("too-large", "It needs more memory."))
          : LED_PLANNING.measure(...args),
    };
    put("a.svg");
    await open();
    await expect.poll(() => notices.list().length).toBe(1);
    await close();
    await open();
    await expect.poll(() => logged.length).toBe(2);
    expect(notices.list()).toHaveLength(1);
    expect(names()).toEqual([]);
    put("a.svg");
    await queued("a.svg");
  });

  it("takes its settings from the last job; a settings file beside the drawing overrides them", async () => {
    put("a.settings.json", JSON.stringify({ pen: { ...DEFAULT_PLOT_SETTINGS.pen, downPct: 12 } }));
    put("a.svg");
    await open();
    await queued("a.svg");
    expect(queue.list()[0]?.settings).toEqual({
      ...DEFAULT_PLOT_SETTINGS,
      pen: { ...DEFAULT_PLOT_SETTINGS.pen, downPct: 12 },
    });
    put("b.svg");
    await queued("a.svg", "b.svg");
    expect(queue.list()[1]?.settings.pen.downPct).toBe(12);
    put("c.settings.json", '{ "pen": { "downPct": 400 } }');
    put("c.svg");
    await expect.poll(() => notices.list()[0]?.message).toMatch(/c\.settings\.json: pen\./);
  });

  it.each([
    ["a.settings.json", '{ "pen": { "downPct": 400 } }', "a.settings.json"],
    ["settings.json", "{", "settings.json"],
  ])("plots a drawing when its bad %s is mended", async (file, bad, named) => {
    put(file, bad);
    put("a.svg");
    await open();
    await expect.poll(() => notices.list()[0]?.message).toContain(`can't be plotted: ${named}`);
    put(file, '{ "pen": { "downPct": 12 } }');
    await queued("a.svg");
    expect(queue.list()[0]?.settings.pen.downPct).toBe(12);
    expect(notices.list()).toHaveLength(1);
  });

  it("plots a drawing when its bad settings are removed, or mended while the server is off", async () => {
    put("settings.json", "{}}");
    put("a.svg");
    await open();
    await expect.poll(() => notices.list().length).toBe(1);
    rmSync(join(watched, "settings.json"));
    await queued("a.svg");
    put("settings.json", "{");
    put("b.svg");
    await expect.poll(() => notices.list().length).toBe(2);
    await close();
    put("settings.json", "{}");
    await open();
    await queued("a.svg", "b.svg");
  });

  it("tries a drawing that is larger than the paper again with other settings", async () => {
    planning = {
      ...LED_PLANNING,
      measure: (drawing, settings, ...rest) =>
        settings.prepare.paper.widthMm < 100
          ? Promise.reject(new PlotwrightError("out-of-bounds", "It is larger than the paper."))
          : LED_PLANNING.measure(drawing, settings, ...rest),
    };
    const paper = { widthMm: 50, heightMm: 50 };
    put("settings.json", JSON.stringify({ prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, paper } }));
    put("a.svg");
    await open();
    await expect.poll(() => notices.list()[0]?.message).toContain("larger than the paper");
    put("settings.json", "{}");
    await queued("a.svg");
  });

  it("does not follow links out of the folder, and reports a missing folder", async () => {
    writeFileSync(join(dir, "secret.svg"), "<svg/>");
    symlinkSync(join(dir, "secret.svg"), join(watched, "link.svg"));
    await open();
    put("a.svg");
    await queued("a.svg");
    const parts = {
      queue,
      store,
      notices,
      files: new DrawingFiles(dir, 1),
    };
    await expect(WatchFolder.open(join(dir, "none"), { ...parts, log: () => undefined })).rejects.toThrow(
      "does not exist",
    );
  });
});

/** What else a name in a folder may belong to. Each of them makes it, and says why it can't be read. */
const ODD_FILES: Record<string, readonly [make: (path: string) => unknown, why: RegExp]> = {
  "a named pipe": [(path) => execFileSync("mkfifo", [path]), /it is not a file/],
  "a socket": [
    (path) => new Promise((resolve) => sockets.push(createServer().listen(path, () => resolve(null)))),
    /it is not a file/,
  ],
  "a folder": [(path) => mkdirSync(path), /it is a folder/],
  "a link that leads nowhere": [(path) => symlinkSync("none", path), /there is no such file/],
  "a link to itself": [(path) => symlinkSync(path, path), /leads in a circle/],
  "a link to an endless device": [(path) => symlinkSync("/dev/zero", path), /it is not a file/],
  "a file of 100 GB": [
    (path) => {
      writeFileSync(path, "");
      truncateSync(path, 100e9);
    },
    /larger than/,
  ],
};
const sockets: { close(): unknown }[] = [];

describe.skipIf(process.platform === "win32").each(Object.entries(ODD_FILES))(
  "in the watched folder, %s",
  (_, [make, why]) => {
    afterEach(() => sockets.splice(0).forEach((socket) => socket.close()));

    it.each(["settings.json", "a.settings.json"])(
      "named %s is reported, and the drawing is plotted when a file replaces it",
      async (name) => {
        await make(join(watched, name));
        put("a.svg");
        await open();
        await expect.poll(() => notices.list()[0]?.message).toMatch(why);
        expect(notices.list()[0].message).toContain(`${name} can't be read: `);
        rmSync(join(watched, name), { recursive: true });
        // The file system reports two changes as one if they follow at once.
        await new Promise((resolve) => setTimeout(resolve, 1_000));
        put(name, "{}");
        await queued("a.svg");
      },
    );

    it("named as a drawing holds up no other drawing", async () => {
      await make(join(watched, "a.svg"));
      await open();
      put("b.svg");
      await queued("b.svg");
    });
  },
);

it("a drawing that is replaced by a named pipe or a link while it is read is read from the file that it was", async () => {
  await open();
  const path = join(dir, "swapped.svg");
  writeFileSync(path, "<svg/>");
  const texts = await withDrawing(path, async (drawing) => {
    rmSync(path);
    symlinkSync("/dev/zero", path);
    const read = async (): Promise<string> => {
      let text = "";
      for await (const chunk of drawing.chunks()) text += chunk.toString();
      return text;
    };
    return [await read(), await read()];
  });
  expect(texts).toEqual(["<svg/>", "<svg/>"]);
  expect(await withDrawing(path, () => Promise.resolve("taken"))).toBeNull();
});
