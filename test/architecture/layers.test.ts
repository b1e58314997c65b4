/** The import rule of ARCHITECTURE.md, checked on the real imports. */
import { readdirSync } from "node:fs";
import path from "node:path";
import { describe, expect, it } from "vitest";
import {
  cycleOfFiles,
  cycleOfFolders,
  findCycle,
  foreignCommands,
  foreignKinds,
  privateIdentifiers,
  importsBetweenDrivers,
  importsOf,
  inside as importsInside,
  literalsOf,
  localTypesNamedLikeExported,
  plannedElsewhere,
  ROOT,
  sourceFiles,
  sourcesIn,
  staticPluginImports,
  typesExportedTwice,
  write,
  type Import,
} from "./checks.js";

/** Files that all folders of src may import. */
const BASE = ["units", "errors", "check-arguments", "get-or-add", "plain-text"];

/** What each folder of src may import, besides itself. The keys are all existing folders. */
const MAY_IMPORT: Readonly<Record<string, readonly string[]>> = {
  "check-arguments": ["errors"],
  geometry: [...BASE],
  drawing: ["geometry", ...BASE],
  settings: ["drawing", ...BASE],
  import: ["drawing", "geometry", ...BASE],
  machines: ["settings", ...BASE],
  prepare: ["drawing", "geometry", "machines", "settings", ...BASE],
  plan: ["prepare", "drawing", "geometry", "machines", "settings", ...BASE],
  position: ["plan", "prepare", "drawing", "geometry", "machines", "settings", ...BASE],
  drivers: ["position", "plan", "prepare", "drawing", "geometry", "machines", "settings", ...BASE],
  job: [
    "import",
    "drivers",
    "position",
    "plan",
    "prepare",
    "drawing",
    "geometry",
    "machines",
    "settings",
    ...BASE,
  ],
  export: ["plan", "prepare", "drawing", "geometry", "machines", "settings", ...BASE],
  schema: ["drivers", "position", "plan", "prepare", "drawing", "geometry", "machines", "settings", ...BASE],
};

/** The folders of server, lowest first: each imports only those before it. The entry files may import all. */
const SERVER_LAYERS = [
  "server/storage",
  "server/serial",
  "server/security",
  "server/planning",
  "server/plotter",
  "server/http",
  "server/plugins",
  "server/plugins/*",
  "server/composition",
  "server/cli",
];

const SOURCES = sourcesIn("src", "host", "server", "web");
const importsIn = (folder: string): Import[] =>
  importsOf(SOURCES).filter(({ from }) => from.startsWith(`${folder}/`));

/** "src/plan/corner" → "plan"; "src/units" → "units". */
const layerOf = (file: string): string => (file.split("/")[1] ?? "").replace(/\.ts$/, "");

/** "web/queue/jobs.tsx" → "web/queue"; web itself counts as a folder. */
const folderOf = (file: string): string => file.split("/").slice(0, 2).join("/");

describe("the layers of src", () => {
  const inside = importsInside("src", SOURCES);

  it("are the folders in the rule's table", () => {
    const folders = readdirSync(path.join(ROOT, "src"), { withFileTypes: true })
      .filter((entry) => entry.isDirectory())
      .map((entry) => entry.name);
    expect(folders.filter((folder) => !(folder in MAY_IMPORT))).toEqual([]);
  });

  it("import only layers below them", () => {
    const wrong = inside.filter(({ from, to }) => {
      const layer = layerOf(from);
      const target = layerOf(to);
      if (layer === "index" || layer === "internal" || target === layer) return false;
      return !(MAY_IMPORT[layer] ?? []).includes(target);
    });
    expect(wrong.map(write)).toEqual([]);
  });

  it("have no import cycle among their files or folders, however long", () => {
    expect(cycleOfFiles("src", SOURCES)).toEqual([]);
    expect(cycleOfFolders("src", SOURCES)).toEqual([]);
  });

  it("use nothing of Node, server, web or test", () => {
    const wrong = importsIn("src").filter(({ to }) => /^(node:|server\/|web\/|test\/|scripts\/)/.test(to));
    expect(wrong.map(write)).toEqual([]);
  });

  it("use zod only in src/schema, so that the planning worker does not load it", () => {
    const wrong = importsIn("src").filter(({ from, to }) => to === "zod" && !from.startsWith("src/schema/"));
    expect(wrong.map(write)).toEqual([]);
    expect(
      inside.filter(({ from, to }) => !from.startsWith("src/schema/") && to.startsWith("src/schema/")),
    ).toEqual([]);
  });
});

describe("server and web", () => {
  it.each(["host", "server", "web"])("%s uses src only through its three entries", (folder) => {
    const wrong = importsIn(folder).filter(
      ({ to }) => to.startsWith("src/") && !["src/index", "src/internal", "src/schema/index"].includes(to),
    );
    expect(wrong.map(write)).toEqual([]);
  });

  it("never import each other, nor a test", () => {
    const wrong = [...importsIn("server"), ...importsIn("web")].filter(({ from, to }) => {
      // It configures the build, and is not part of the page.
      if (from === "web/vite.config.ts") return false;
      const other = from.startsWith("web/") ? "server/" : "web/";
      return to.startsWith(other) || to.startsWith("test/") || to.startsWith("scripts/");
    });
    expect(wrong.map(write)).toEqual([]);
  });
});

describe("host", () => {
  const inside = importsInside("host", SOURCES);

  it("imports only src, itself and zod, so it runs in Node and in a browser's worker", () => {
    const wrong = importsIn("host").filter(({ to }) => !/^(src|host)\//.test(to) && to !== "zod");
    expect(wrong.map(write)).toEqual([]);
  });

  it("is used by server and web only", () => {
    const wrong = importsIn("src").filter(({ to }) => to.startsWith("host/"));
    expect(wrong.map(write)).toEqual([]);
  });

  it("has folders that are layers: planning, plotter, queue, operations, handle", () => {
    const level = (file: string): number =>
      ["host", "host/planning", "host/plotter", "host/queue", "host/operations", "host/handle"].indexOf(
        path.posix.dirname(file),
      );
    expect(inside.filter(({ from, to }) => level(from) < level(to)).map(write)).toEqual([]);
    expect(cycleOfFiles("host", SOURCES)).toEqual([]);
  });

  it("keeps zod out of what the planner's thread loads", () => {
    const wrong = importsIn("host").filter(
      ({ from, to }) => from.startsWith("host/planning/") && to === "zod",
    );
    expect(wrong.map(write)).toEqual([]);
  });
});

/** "server/cli/plan" → "server/cli". */
const twoLevels = (folder: string): string => folder.split("/").slice(0, 2).join("/");

describe("the folders of server", () => {
  const inside = importsInside("server", SOURCES);
  const levelOf = (file: string): number => {
    const folder = path.posix.dirname(file);
    if (folder === "server") return SERVER_LAYERS.length;
    return SERVER_LAYERS.indexOf(
      folder.startsWith("server/plugins/") ? "server/plugins/*" : twoLevels(folder),
    );
  };

  it("have no import cycle among their files or folders", () => {
    expect(cycleOfFiles("server", SOURCES)).toEqual([]);
    expect(cycleOfFolders("server", SOURCES)).toEqual([]);
  });

  it("are layers, each of which imports only those below it", () => {
    expect(sourceFiles("server").filter((file) => levelOf(file) === -1)).toEqual([]);
    const wrong = inside.filter(({ from, to }) => levelOf(from) < levelOf(to));
    expect(wrong.map(write)).toEqual([]);
  });

  it("contain no entries, which are the only files beside them", () => {
    const files = sourceFiles("server").filter((file) => path.posix.dirname(file) === "server");
    expect(files.sort()).toEqual(["server/index.ts", "server/main.ts"]);
  });

  it("load a plug-in only when it is asked for: nothing outside imports it statically", () => {
    expect(staticPluginImports(sourcesIn("server"))).toEqual([]);
  });

  it("have no two files whose names differ only by a plural", () => {
    const names = sourceFiles("server").map((file) => path.posix.basename(file, ".ts"));
    const singular = (name: string): string => name.replace(/s(?=-|$)/g, "");
    const twins = names.filter((name) =>
      names.some((other) => other !== name && singular(other) === singular(name)),
    );
    expect(twins).toEqual([]);
  });
});

describe("the folders of web", () => {
  const inside = importsInside("web", SOURCES);

  it("have no cycles among their files", () => {
    expect(cycleOfFiles("web", SOURCES)).toEqual([]);
  });

  it("use host only in the backend without a server, for live drawings, and in the entry for programs", () => {
    const users = /^web\/(backend\/(browser\/|live\.ts$|backend\.ts$)|serial\/open-plotter\.ts$)/;
    const wrong = importsIn("web").filter(({ from, to }) => to.startsWith("host/") && !users.test(from));
    expect(wrong.map(write)).toEqual([]);
  });

  it("have no cycles among themselves", () => {
    const between = inside
      .map(({ from, to }) => ({ from: folderOf(from), to: folderOf(to) }))
      .filter(({ from, to }) => from !== to);
    expect(findCycle(between)).toEqual([]);
  });

  it("leave requests to the implementations of the backend", () => {
    // The service worker and its helpers fetch the page's own files; the build configuration is not part of
    // the page.
    const others = sourceFiles("web").filter(
      (file) =>
        !/^web\/(backend\/(server|browser)|pwa)\//.test(file) &&
        // The entry for programs, which is no part of the page.
        !["web/vite.config.ts", "web/serial/open-plotter.ts"].includes(file),
    );
    const wrong = others.filter((file) => {
      const text = SOURCES[file];
      return (
        /\b(fetch\(|EventSource|XMLHttpRequest|sendBeacon|WebSocket)/.test(text) ||
        literalsOf(file, text).some((literal) => literal.includes("/api/"))
      );
    });
    expect(wrong).toEqual([]);
  });

  it("know the backend by its interface; only page-backend.ts chooses the implementation", () => {
    const wrong = inside.filter(
      ({ from, to }) =>
        /^web\/backend\/(server|browser)\//.test(to) &&
        path.posix.dirname(from) !== path.posix.dirname(to) &&
        from !== "web/backend/page-backend.ts",
    );
    expect(wrong.map(write)).toEqual([]);
  });
});

describe("the boundaries", () => {
  it("keep the commands of a controller in its driver's folder", () => {
    expect(foreignCommands(SOURCES)).toEqual([]);
  });

  it("keep the kinds of controllers in their folders and the registry", () => {
    expect(foreignKinds(SOURCES)).toEqual([]);
  });

  it("let no driver use another one", () => {
    expect(importsBetweenDrivers(SOURCES)).toEqual([]);
  });

  it("let private members be written in one way", () => {
    expect(privateIdentifiers(SOURCES)).toEqual([]);
  });

  it("leave planning and compiling to planJob and the drivers", () => {
    expect(plannedElsewhere(SOURCES)).toEqual([]);
  });
});

/** Plain nouns, and the settings of a section: as the name of a local type, what they mean is obvious in its file. */
const OBVIOUS = [
  ...["Axis", "Box", "Context", "Fault", "Frame", "Line", "Look", "Move", "Outline", "Paint", "Parameters"],
  ...["Part", "Place", "Point", "Rule", "Side", "Size", "Style"],
  ...["MotionSettings", "PenSettings", "PrepareSettings"],
];

describe("the name of a type", () => {
  it("is exported by one file only", () => {
    expect(typesExportedTwice(SOURCES)).toEqual([]);
  });

  it("is not the name of an exported type if it is local, unless its meaning is obvious", () => {
    expect(localTypesNamedLikeExported(SOURCES, OBVIOUS)).toEqual([]);
  });
});
