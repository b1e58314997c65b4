/** The import rule of ARCHITECTURE.md, checked on the real imports. */
import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import ts from "typescript";
import { describe, expect, it } from "vitest";

const ROOT = path.join(import.meta.dirname, "..", "..");

/** What each folder of src may import, besides itself. The keys are all existing folders. */
const MAY_IMPORT: Readonly<Record<string, readonly string[]>> = {
  geometry: ["units", "errors"],
  drawing: ["geometry", "units", "errors"],
  settings: ["drawing", "units", "errors"],
  import: ["drawing", "geometry", "units", "errors"],
  machines: ["settings", "units", "errors"],
  prepare: ["drawing", "geometry", "machines", "settings", "units", "errors"],
  plan: ["prepare", "drawing", "geometry", "machines", "settings", "units", "errors"],
  drivers: ["plan", "prepare", "drawing", "geometry", "machines", "settings", "units", "errors"],
  job: [
    "import",
    "drivers",
    "plan",
    "prepare",
    "drawing",
    "geometry",
    "machines",
    "settings",
    "units",
    "errors",
  ],
  export: ["plan", "prepare", "drawing", "geometry", "machines", "settings", "units", "errors"],
  schema: ["drivers", "plan", "prepare", "drawing", "geometry", "machines", "settings", "units", "errors"],
};

/** The folders of server, lowest first: each imports only those before it. The entry files may import all. */
const SERVER_LAYERS = [
  "server/storage",
  "server/serial",
  "server/security",
  "server/planning",
  "server/plotter",
  "server/queue",
  "server/http",
  "server/plugins",
  "server/plugins/*",
  "server/composition",
  "server/cli",
];

interface Import {
  readonly from: string;
  readonly to: string;
}

/** Paths from the project's root with forward slashes; `to` is a bare name for a package. */
function importsOf(file: string): Import[] {
  const text = readFileSync(path.join(ROOT, file), "utf8");
  return ts.preProcessFile(text, true, true).importedFiles.map(({ fileName }) => ({
    from: file,
    to: fileName.startsWith(".")
      ? path.posix.join(path.posix.dirname(file), fileName).replace(/\.jsx?$/, "")
      : fileName,
  }));
}

function sourceFiles(folder: string): string[] {
  return readdirSync(path.join(ROOT, folder), { recursive: true, encoding: "utf8" })
    .map((file) => path.posix.join(folder, file.split(path.sep).join("/")))
    .filter((file) => /\.tsx?$/.test(file) && !file.endsWith(".d.ts"));
}

/** String literals, and the first piece of each template. */
function literalsOf(file: string): string[] {
  const source = ts.createSourceFile(
    file,
    readFileSync(path.join(ROOT, file), "utf8"),
    ts.ScriptTarget.ES2022,
    true,
    file.endsWith("x") ? ts.ScriptKind.TSX : ts.ScriptKind.TS,
  );
  const found: string[] = [];
  const visit = (node: ts.Node): void => {
    if (ts.isStringLiteralLike(node) || ts.isTemplateHead(node)) found.push(node.text);
    ts.forEachChild(node, visit);
  };
  visit(source);
  return found;
}

const importsIn = (folder: string): Import[] => sourceFiles(folder).flatMap(importsOf);
const write = ({ from, to }: Import): string => `${from} imports ${to}`;

/** The imports that TypeScript writes at the top of a file, without `import("…")`. */
function staticImportsOf(file: string): Import[] {
  const source = ts.createSourceFile(
    file,
    readFileSync(path.join(ROOT, file), "utf8"),
    ts.ScriptTarget.ES2022,
  );
  return source.statements.flatMap((statement) => {
    const isImport = ts.isImportDeclaration(statement) || ts.isExportDeclaration(statement);
    const from = isImport ? statement.moduleSpecifier : undefined;
    if (from === undefined || !ts.isStringLiteral(from) || !from.text.startsWith(".")) return [];
    return [{ from: file, to: path.posix.join(path.posix.dirname(file), from.text).replace(/\.jsx?$/, "") }];
  });
}

/** The same imports between folders: "server/http/app.ts" → "server/http". */
const betweenFolders = (imports: readonly Import[]): Import[] =>
  imports
    .map(({ from, to }) => ({ from: path.posix.dirname(from), to: path.posix.dirname(to) }))
    .filter(({ from, to }) => from !== to);

/** "src/plan/corner" → "plan"; "src/units" → "units". */
const layerOf = (file: string): string => (file.split("/")[1] ?? "").replace(/\.ts$/, "");

/** "web/queue/jobs.tsx" → "web/queue"; web itself counts as a folder of its own. */
const folderOf = (file: string): string => file.split("/").slice(0, 2).join("/");

/** The imports of one search that form a cycle, as a readable chain; empty if there is none. */
function findCycle(imports: readonly Import[]): string[] {
  const next = new Map<string, string[]>();
  for (const { from, to } of imports) {
    const key = from.replace(/\.tsx?$/, "");
    next.set(key, [...(next.get(key) ?? []), to]);
  }
  const done = new Set<string>();
  const visit = (file: string, way: readonly string[]): string[] => {
    if (way.includes(file)) return [...way.slice(way.indexOf(file)), file];
    if (done.has(file)) return [];
    for (const to of next.get(file) ?? []) {
      const cycle = visit(to, [...way, file]);
      if (cycle.length > 0) return cycle;
    }
    done.add(file);
    return [];
  };
  for (const file of next.keys()) {
    const cycle = visit(file, []);
    if (cycle.length > 0) return cycle;
  }
  return [];
}

describe("the layers of src", () => {
  const inside = importsIn("src").filter(({ to }) => to.startsWith("src/"));

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

  it("have no cycles among their files", () => {
    expect(findCycle(inside)).toEqual([]);
  });

  it("know nothing of Node, of server, web or test", () => {
    const wrong = importsIn("src").filter(({ to }) => /^(node:|server\/|web\/|test\/|scripts\/)/.test(to));
    expect(wrong.map(write)).toEqual([]);
  });

  it("keep zod to src/schema, so the planning worker does not carry it", () => {
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
  const inside = importsIn("host").filter(({ to }) => to.startsWith("host/"));

  it("imports only src, itself and zod, so it runs in Node and in a browser's worker", () => {
    const wrong = importsIn("host").filter(({ to }) => !/^(src|host)\//.test(to) && to !== "zod");
    expect(wrong.map(write)).toEqual([]);
  });

  it("is used by server and web only", () => {
    const wrong = importsIn("src").filter(({ to }) => to.startsWith("host/"));
    expect(wrong.map(write)).toEqual([]);
  });

  it("has folders that are layers: planning, plotter, queue", () => {
    const level = (file: string): number =>
      ["host", "host/planning", "host/plotter", "host/queue"].indexOf(path.posix.dirname(file));
    expect(inside.filter(({ from, to }) => level(from) < level(to)).map(write)).toEqual([]);
    expect(findCycle(inside)).toEqual([]);
  });

  it("keeps zod out of what the planner's thread loads", () => {
    const files = ["stages", "plot-planner", "planning", "lane"].map((name) => `host/planning/${name}.ts`);
    const loaded = files.flatMap(staticImportsOf).filter(({ to }) => to === "zod");
    expect(loaded.map(write)).toEqual([]);
  });
});

describe("the folders of server", () => {
  const inside = importsIn("server").filter(({ to }) => to.startsWith("server/"));
  const levelOf = (file: string): number => {
    const folder = path.posix.dirname(file);
    if (folder === "server") return SERVER_LAYERS.length;
    return SERVER_LAYERS.indexOf(folder.startsWith("server/plugins/") ? "server/plugins/*" : folder);
  };
  const pluginOf = (file: string): string | null => /^server\/plugins\/[^/]+(?=\/)/.exec(file)?.[0] ?? null;

  it("have no circles", () => {
    expect(findCycle(betweenFolders(inside))).toEqual([]);
  });

  it("are layers, each of which imports only those below it", () => {
    expect(sourceFiles("server").filter((file) => levelOf(file) === -1)).toEqual([]);
    const wrong = inside.filter(({ from, to }) => levelOf(from) < levelOf(to));
    expect(wrong.map(write)).toEqual([]);
  });

  it("are not the place of entries, which are the only files beside them", () => {
    const files = sourceFiles("server").filter((file) => path.posix.dirname(file) === "server");
    expect(files.sort()).toEqual(["server/index.ts", "server/main.ts"]);
  });

  it("load a plug-in only when it is asked for: nothing outside imports it statically", () => {
    const wrong = sourceFiles("server")
      .flatMap(staticImportsOf)
      .filter(({ from, to }) => pluginOf(to) !== null && pluginOf(from) !== pluginOf(to));
    expect(wrong.map(write)).toEqual([]);
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
  const inside = importsIn("web").filter(({ to }) => to.startsWith("web/"));

  it("have no cycles among their files", () => {
    expect(findCycle(inside)).toEqual([]);
  });

  it("use host only in the backend without a server", () => {
    const wrong = importsIn("web").filter(
      ({ from, to }) => to.startsWith("host/") && !from.startsWith("web/backend/browser/"),
    );
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
      (file) => !/^web\/(backend\/(server|browser)|pwa)\//.test(file) && file !== "web/vite.config.ts",
    );
    const wrong = others.filter((file) => {
      const text = readFileSync(path.join(ROOT, file), "utf8");
      return (
        /\b(fetch\(|EventSource|XMLHttpRequest|sendBeacon|WebSocket)/.test(text) ||
        literalsOf(file).some((literal) => literal.includes("/api/"))
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

describe("the seams", () => {
  const PRODUCT = ["src", "host", "server", "web"].flatMap(sourceFiles);
  const EBB_COMMAND =
    /^(EM|SC|SP|S2|SM|XM|LM|LT|L3|T3|TD|TR|HM|ES|QS|QM|QG|QB|QC|QU|QE|QP|QL|SL|CS|CU|PI|PD)(,[\d-]|,$|$)/;

  /** A line of G-code, a system command, or the greeting. */
  const GRBL_COMMAND = /^(G\d+([A-Z$]|$)|M[345](S|$)|\$([XHIGC#$]|SLP)$|\$(J|RST)=|Grbl(HAL)?( |$))/;

  it("keep the commands of the EiBotBoard in its driver's folder", () => {
    // HPGL has commands of the same names; the console's field shows one as its example.
    const exempt = ["src/drivers/ebb/", "src/import/hpgl/", "web/plotter/console.tsx"];
    const others = PRODUCT.filter((file) => !exempt.some((start) => file.startsWith(start)));
    const wrong = others.flatMap((file) =>
      literalsOf(file)
        .filter((text) => EBB_COMMAND.test(text))
        .map((text) => `${file}: "${text}"`),
    );
    expect(wrong).toEqual([]);
  });

  it("keep the commands of Grbl in its driver's folder", () => {
    // Its profile's fields name the settings of the firmware, for the user.
    const exempt = ["src/drivers/grbl/", "src/machines/controllers.ts"];
    const others = PRODUCT.filter((file) => !exempt.some((start) => file.startsWith(start)));
    const wrong = others.flatMap((file) =>
      literalsOf(file)
        .filter((text) => GRBL_COMMAND.test(text))
        .map((text) => `${file}: "${text}"`),
    );
    expect(wrong).toEqual([]);
  });

  it("let no driver use another one", () => {
    const driverOf = (file: string): string | undefined => /^src\/drivers\/([^/]+)\//.exec(file)?.[1];
    const wrong = importsIn("src/drivers").filter(({ from, to }) => {
      const [own, other] = [driverOf(from), driverOf(to)];
      return own !== undefined && other !== undefined && own !== other;
    });
    expect(wrong.map(write)).toEqual([]);
  });

  it("leave planning and compiling to planJob and the drivers", () => {
    const wrong = ["host", "server", "web"].flatMap(sourceFiles).filter((file) => {
      const text = readFileSync(path.join(ROOT, file), "utf8");
      return /import [^;]*\b(plan|compile|motionForFirmware)\b[^;]* from "[./]+src\/(index|internal)\.js"/.test(
        text,
      );
    });
    expect(wrong).toEqual([]);
  });

  it("have no cycle among the files of server", () => {
    expect(findCycle(importsIn("server").filter(({ to }) => to.startsWith("server/")))).toEqual([]);
  });

  it("would find a command elsewhere", () => {
    const texts = ["EM,0,0", "SP,1,", "QS", "S2,", "plan", "S", "SVG", "Esc"];
    expect(texts.filter((text) => EBB_COMMAND.test(text))).toEqual(["EM,0,0", "SP,1,", "QS", "S2,"]);
    const lines = [
      "G1X",
      "G4P0",
      "G21G90",
      "M3S",
      "$X",
      "$SLP",
      "$I",
      "Grbl 1.1h",
      "G",
      "M4",
      "Grbl's",
      "$5",
      "M10 30H90",
    ];
    expect(lines.filter((text) => GRBL_COMMAND.test(text))).toEqual(lines.slice(0, 8).concat("M4"));
  });
});

describe("the folders of src", () => {
  const files = sourceFiles("src");
  const isLeaf = (folder: string): boolean =>
    !files.some((file) => path.posix.dirname(file).startsWith(`${folder}/`));
  /** "src/drivers/ebb/compile/leg" → "src/drivers/ebb/compile"; a file beside folders stands for itself. */
  const folderOf = (file: string): string => {
    const folder = path.posix.dirname(file);
    return isLeaf(folder) ? folder : file.replace(/\.ts$/, "");
  };

  it("have no circles among them, deep ones too", () => {
    const between = importsIn("src")
      .filter(({ to }) => to.startsWith("src/"))
      .map(({ from, to }) => ({ from: folderOf(from), to: folderOf(to) }))
      .filter(({ from, to }) => from !== to);
    expect(findCycle(between)).toEqual([]);
  });
});

describe("the search for cycles", () => {
  it("finds an existing one", () => {
    const circle = [
      { from: "src/a.ts", to: "src/b" },
      { from: "src/b.ts", to: "src/c" },
      { from: "src/c.ts", to: "src/b" },
    ];
    expect(findCycle(circle)).toEqual(["src/b", "src/c", "src/b"]);
  });

  it("finds one among folders whose files have none", () => {
    const imports = [
      { from: "server/http/app.ts", to: "server/index" },
      { from: "server/main.ts", to: "server/http/listen" },
    ];
    expect(findCycle(imports)).toEqual([]);
    expect(findCycle(betweenFolders(imports))).toEqual(["server/http", "server", "server/http"]);
  });
});
