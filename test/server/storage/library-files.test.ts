/** The library's files: nothing outside its folder, nothing hidden and no link is ever listed, read, written or removed. */
import fc from "fast-check";
import { execFileSync } from "node:child_process";
import {
  existsSync,
  mkdirSync,
  readdirSync,
  readFileSync,
  statSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { join } from "node:path";
import { beforeEach, describe, expect, it } from "vitest";
import { PlotwrightError } from "../../../src/index.js";
import { libraryPathSchema, whyNotName } from "../../../server/storage/library-paths.js";
import { LibraryFiles } from "../../../server/storage/library-files.js";
import { folderOfTest } from "../../support/processes/folders.js";

const SVG = "<svg/>";
const MAX_BYTES = 1_000;

let dir: string;
let source: string;
let library: LibraryFiles;

beforeEach(() => {
  dir = folderOfTest();
  source = join(dir, "source.svg");
  writeFileSync(source, SVG);
  writeFileSync(join(dir, "secret.svg"), "secret");
  library = new LibraryFiles(dir, MAX_BYTES);
});

const codeOf = (work: Promise<unknown>): Promise<string> =>
  work.then(
    () => "done",
    (error: unknown) => (error instanceof PlotwrightError ? error.code : String(error)),
  );
const textOf = async (path: string): Promise<string> => {
  const { file } = await library.open(path);
  try {
    return await file.readFile("utf8");
  } finally {
    await file.close();
  }
};
const pathsIn = async (...of: Parameters<LibraryFiles["list"]>) =>
  (await library.list(...of)).files.map(({ path }) => path);

describe("the library", () => {
  it("is empty before anything is kept, and makes the folders of a drawing", async () => {
    expect(await library.list({})).toEqual({ folder: "", folders: [], files: [], isCut: false });
    await library.add("plants/2026/fern.svg", source);
    expect(await library.list({})).toMatchObject({ folders: ["plants"], files: [] });
    expect(await library.list({ folder: "plants/2026" })).toMatchObject({
      files: [{ path: "plants/2026/fern.svg", bytes: SVG.length }],
    });
    expect(await textOf("plants/2026/fern.svg")).toBe(SVG);
    // Only its owner reads it.
    expect(statSync(join(dir, "library", "plants")).mode & 0o077).toBe(0);
  });

  it("lists in the order of names, with numbers as numbers, and finds names below a folder", async () => {
    for (const path of ["b/sheet 10.svg", "b/sheet 2.dxf", "b/deep/Sheet 3.svg", "other.svg"]) {
      await library.add(path, source);
    }
    expect(await pathsIn({ folder: "b" })).toEqual(["b/sheet 2.dxf", "b/sheet 10.svg"]);
    expect(await pathsIn({ name: "SHEET" })).toEqual([
      "b/deep/Sheet 3.svg",
      "b/sheet 2.dxf",
      "b/sheet 10.svg",
    ]);
    expect(await pathsIn({ folder: "b/deep", name: "sheet" })).toEqual(["b/deep/Sheet 3.svg"]);
    expect(await pathsIn({ folder: "none", name: "sheet" })).toEqual([]);
  });

  it("overwrites nothing, and numbers the name of a drawing that is kept again", async () => {
    await library.add("fern.svg", source);
    expect(await codeOf(library.add("fern.svg", join(dir, "secret.svg")))).toBe("conflict");
    expect(await textOf("fern.svg")).toBe(SVG);
    expect((await library.addFree("", "fern.svg", source)).path).toBe("fern 2.svg");
    expect((await library.addFree("new", "fern.svg", source)).path).toBe("new/fern.svg");
    // A file where a folder should be.
    expect(await codeOf(library.add("fern.svg/other.svg", source))).toBe("not-found");
  });

  it("removes a drawing, and a folder only when it is empty", async () => {
    await library.add("a/b/fern.svg", source);
    expect(await codeOf(library.remove("a"))).toBe("conflict");
    await library.remove("a/b/fern.svg");
    await library.remove("a/b");
    await library.remove("a");
    expect(await codeOf(library.remove("a"))).toBe("not-found");
    expect(readdirSync(join(dir, "library"))).toEqual([]);
  });

  it("leaves alone what is not a drawing, hidden, a link or a pipe", async () => {
    const root = join(dir, "library");
    mkdirSync(join(root, ".git"), { recursive: true });
    writeFileSync(join(root, ".git", "config.svg"), "secret");
    writeFileSync(join(root, ".hidden.svg"), "secret");
    writeFileSync(join(root, "notes.txt"), "secret");
    symlinkSync(join(dir, "secret.svg"), join(root, "link.svg"));
    symlinkSync(dir, join(root, "up"));
    execFileSync("mkfifo", [join(root, "pipe.svg")]);
    expect(await library.list({})).toEqual({ folder: "", folders: [], files: [], isCut: false });
    expect(await pathsIn({ name: "s" })).toEqual([]);
    for (const path of [
      "link.svg",
      "up/secret.svg",
      "pipe.svg",
      ".hidden.svg",
      ".git/config.svg",
      "notes.txt",
    ]) {
      expect([path, await codeOf(library.open(path))]).toEqual([
        path,
        expect.stringMatching(/^(not-found|bad-setting)$/),
      ]);
      expect([path, await codeOf(library.remove(path))]).toEqual([
        path,
        expect.stringMatching(/^(not-found|bad-setting)$/),
      ]);
      expect([path, await codeOf(library.add(path, source))]).not.toEqual([path, "done"]);
    }
    expect(await codeOf(library.remove("up"))).toBe("not-found");
    expect(await pathsIn({ folder: "up" })).toEqual([]);
    expect(await codeOf(library.add("up/new.svg", source))).toBe("not-found");
    expect(readFileSync(join(dir, "secret.svg"), "utf8")).toBe("secret");
    expect(existsSync(join(dir, "new.svg"))).toBe(false);
  });

  it("may itself be a link, which its owner has made", async () => {
    mkdirSync(join(dir, "disk"));
    symlinkSync(join(dir, "disk"), join(dir, "library"));
    await library.add("a/fern.svg", source);
    expect(await textOf("a/fern.svg")).toBe(SVG);
    expect(existsSync(join(dir, "disk", "a", "fern.svg"))).toBe(true);
  });

  it("does not read a file larger than the server's limit, and says so", async () => {
    await library.add("a.svg", source);
    writeFileSync(join(dir, "library", "a.svg"), "x".repeat(MAX_BYTES + 1));
    expect(await codeOf(library.open("a.svg"))).toBe("too-large");
  });

  it("lists at most 500 drawings, and says that there are more", async () => {
    await library.add("0.svg", source);
    for (let i = 1; i <= 500; i++) writeFileSync(join(dir, "library", `${i}.svg`), SVG);
    const list = await library.list({});
    expect([list.files.length, list.isCut]).toEqual([500, true]);
    expect((await library.list({ name: "500" })).files.map(({ path }) => path)).toEqual(["500.svg"]);
  });
});

/** Names with what paths, shells, terminals and other systems give a meaning to. */
const hostile = fc.oneof(
  fc.constantFrom(
    ...[
      "..",
      ".",
      "",
      "~",
      "/",
      "\\",
      "../secret.svg",
      "..\\secret.svg",
      "/etc/passwd",
      "C:\\x.svg",
      "a//b.svg",
    ],
    ...[
      "./a.svg",
      "a/../../secret.svg",
      "a/./b.svg",
      ".hidden.svg",
      "con.svg",
      "LPT1",
      "nul.tar.svg",
      "a\0.svg",
    ],
    ...[
      "a\n.svg",
      "a\u202egvs.svg",
      "a.svg.",
      "a.svg ",
      " a.svg",
      "%2e%2e/secret.svg",
      "a:b.svg",
      "e\u0301.svg",
    ],
    ...[
      "\ud800.svg",
      `${"x".repeat(300)}.svg`,
      Array.from({ length: 20 }, () => "d").join("/"),
      "secret.svg/",
      "a/",
    ],
  ),
  fc.string({ unit: "binary", maxLength: 30 }),
  fc
    .array(fc.constantFrom("..", ".", "a", "/", "\\", "\0", ".svg", " ", "%2f", "b"), { maxLength: 8 })
    .map((parts) => parts.join("")),
);

describe("hostile paths", () => {
  it("reach nothing outside the library, whatever is asked", { timeout: 60_000 }, async () => {
    await library.add("a/b.svg", source);
    const outside = (): string[] => readdirSync(dir).sort();
    const before = outside();
    await fc.assert(
      fc.asyncProperty(hostile, async (path) => {
        const read = await textOf(path).catch(() => null);
        expect(read === null || read === SVG).toBe(true);
        const added = await library.add(path, source).catch(() => null);
        if (added !== null) {
          expect(libraryPathSchema.safeParse(path).success).toBe(true);
          expect(readFileSync(join(dir, "library", ...path.split("/")), "utf8")).toBe(SVG);
          await library.remove(path);
        }
        await library.list({ folder: path }).catch(() => null);
        await library.remove(path).catch(() => null);
        expect(outside()).toEqual(before);
        expect(readFileSync(join(dir, "secret.svg"), "utf8")).toBe("secret");
      }),
      { numRuns: 300 },
    );
  });

  it("are allowed only as names that are the same file on every system", () => {
    fc.assert(
      fc.property(hostile, (name) => {
        if (whyNotName(name) !== null) return;
        expect(name).not.toMatch(/^\.|[/\\\0\n<>:"|?*]|[. ]$|^ /);
        expect(name).toBe(name.normalize("NFC"));
        expect(Buffer.byteLength(name)).toBeLessThanOrEqual(200);
      }),
      { numRuns: 2_000 },
    );
    for (const name of ["moonrise.svg", "Blätter 2026", "月.svg", "a-b_c (2).dxf", "con crete.svg"]) {
      expect([name, whyNotName(name)]).toEqual([name, null]);
    }
  });
});
