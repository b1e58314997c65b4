/**
 * The library: drawings in folders of the data folder, which the user may fill with other programs too. Only regular
 * files and folders whose names the schema allows are listed, read and removed: nothing hidden, no links, nothing
 * outside. Nothing is ever overwritten.
 */
import { constants, type Stats } from "node:fs";
import {
  copyFile,
  lstat,
  mkdir,
  open,
  opendir,
  realpath,
  rm,
  rmdir,
  type FileHandle,
} from "node:fs/promises";
import { join } from "node:path";
import { PlotwrightError } from "../../src/index.js";
import { isDrawingName } from "../../src/internal.js";
import { type LibraryFileInfo, type LibraryList, type LibraryRequest } from "../../src/schema/index.js";
import { parseWith } from "../../host/parse-with.js";
import { libraryFolderSchema, libraryPathSchema, whyNotName } from "./library-paths.js";
import { fileFault } from "./file-fault.js";

/** More are not listed: the search finds them. */
const MAX_LISTED = 500;
/** Entries that one request reads, so that a library of any size is answered in bounded time. */
const MAX_READ = 20_000;
const MAX_DEPTH = 8;
/** Copies of a name: "moonrise 2.svg". */
const MAX_COPIES = 1_000;

export class LibraryFiles {
  private readonly dir: string;

  /** @param maxBytes size limit of a drawing */
  constructor(
    dataDir: string,
    private readonly maxBytes: number,
  ) {
    this.dir = join(dataDir, "library");
  }

  /** Of a folder that is not there: nothing, since a folder is made with its first drawing. */
  async list({ folder = "", name = "" }: LibraryRequest): Promise<LibraryList> {
    const search = name.trim().toLowerCase();
    const found: Found = { folders: [], files: [], readCount: 0 };
    const full = await this.existing(folder);
    if (full !== null) await this.read(full, folder, search, found, 0);
    const inOrder = <T>(items: readonly T[], pathOf: (item: T) => string): T[] =>
      [...items].sort((a, b) => BY_NAME.compare(pathOf(a), pathOf(b)));
    const files = inOrder(found.files, (path) => path).slice(0, MAX_LISTED);
    const infos = await Promise.all(files.map((path) => this.info(path)));
    return {
      folder,
      folders: search === "" ? inOrder(found.folders, (path) => path).slice(0, MAX_LISTED) : [],
      files: infos.filter((info) => info !== null),
      isCut:
        found.readCount >= MAX_READ ||
        found.files.length > MAX_LISTED ||
        (search === "" && found.folders.length > MAX_LISTED),
    };
  }

  /** Opens a drawing for reading; the caller closes it. Throws `not-found`, `too-large`. */
  async open(path: string): Promise<{ readonly file: FileHandle; readonly bytes: number }> {
    const full = await this.file(path);
    // If it became a link or a pipe meanwhile, this neither follows nor waits for it.
    const flags = constants.O_RDONLY | (constants.O_NOFOLLOW ?? 0) | (constants.O_NONBLOCK ?? 0);
    const file = await open(full, flags).catch(() => {
      throw notFound(path);
    });
    const found = await file.stat();
    if (found.isFile() && found.size <= this.maxBytes) return { file, bytes: found.size };
    await file.close();
    if (!found.isFile()) throw notFound(path);
    throw new PlotwrightError(
      "too-large",
      `"${path}" is larger than this server reads. Simplify the drawing.`,
    );
  }

  /** Throws `bad-setting` for a path that no drawing can have, and `conflict` if something has it. */
  async mustBeFree(path: string): Promise<void> {
    mustBeDrawing(path);
    const found = await lstat(join(this.dir, ...path.split("/"))).catch(() => null);
    if (found !== null) throw taken(path);
  }

  /** Copies a file to a path. Throws `conflict` if something has that path. */
  async add(path: string, source: string): Promise<LibraryFileInfo> {
    mustBeDrawing(path);
    const target = join(await this.makeFolder(folderOf(path)), nameOf(path));
    try {
      await copyFile(source, target, constants.COPYFILE_EXCL);
    } catch (cause) {
      if ((cause as NodeJS.ErrnoException).code === "EEXIST") throw taken(path);
      await rm(target, { force: true });
      throw new PlotwrightError("disk-full", `"${path}" can't be stored: ${fileFault(cause)}.`, { cause });
    }
    return (await this.info(path)) ?? { path, bytes: 0, changedAt: new Date().toISOString() };
  }

  /** As `add`; if the name is taken, a number is added to it. */
  async addFree(folder: string, name: string, source: string): Promise<LibraryFileInfo> {
    const [, stem = name, extension = ""] = /^(.*?)(\.\w+)?$/.exec(name) ?? [];
    for (let copy = 1; copy <= MAX_COPIES; copy++) {
      const path = [folder, copy === 1 ? name : `${stem} ${copy}${extension}`].filter(Boolean).join("/");
      try {
        return await this.add(path, source);
      } catch (error) {
        if (!(error instanceof PlotwrightError) || error.code !== "conflict") throw error;
      }
    }
    throw taken(name);
  }

  /** Removes a drawing, or an empty folder. Throws `not-found`, `conflict`. */
  async remove(path: string): Promise<void> {
    parseWith(libraryPathSchema, path);
    const full = join(await this.folder(folderOf(path)), nameOf(path));
    const found = await lstat(full).catch(() => null);
    if (found?.isFile() === true && isDrawingName(path)) return rm(full);
    if (found?.isDirectory() !== true) throw notFound(path);
    await rmdir(full).catch((cause: unknown) => {
      throw new PlotwrightError("conflict", `The folder "${path}" is not empty. Remove its drawings first.`, {
        cause,
      });
    });
  }

  /** The real path of a folder; null if there is none, or if a link leads there. */
  private async existing(path: string): Promise<string | null> {
    parseWith(libraryFolderSchema, path);
    const root = await realpath(this.dir).catch(() => null);
    if (root === null) return null;
    const full = path === "" ? root : join(root, ...path.split("/"));
    if ((await realpath(full).catch(() => null)) !== full) return null;
    return (await lstat(full)).isDirectory() ? full : null;
  }

  /** As `existing`, but throws `not-found`. */
  private async folder(path: string): Promise<string> {
    const full = await this.existing(path);
    if (full === null) throw notFound(path);
    return full;
  }

  private async file(path: string): Promise<string> {
    mustBeDrawing(path);
    const full = join(await this.folder(folderOf(path)), nameOf(path));
    const found: Stats | null = await lstat(full).catch(() => null);
    if (found?.isFile() !== true) throw notFound(path);
    return full;
  }

  /** Makes each folder of a path that is missing. */
  private async makeFolder(path: string): Promise<string> {
    parseWith(libraryFolderSchema, path);
    await mkdir(this.dir, { recursive: true, mode: 0o700 });
    const names = path === "" ? [] : path.split("/");
    for (let depth = 0; depth < names.length; depth++) {
      const parent = await this.folder(names.slice(0, depth).join("/"));
      await mkdir(join(parent, names[depth]), { mode: 0o700 }).catch((cause: NodeJS.ErrnoException) => {
        if (cause.code === "EEXIST") return;
        throw new PlotwrightError("disk-full", `The folder "${path}" can't be made: ${fileFault(cause)}.`, {
          cause,
        });
      });
    }
    return this.folder(path);
  }

  /** Null: it is gone. */
  private async info(path: string): Promise<LibraryFileInfo | null> {
    const found = await this.file(path)
      .then((full) => lstat(full))
      .catch(() => null);
    return found && { path, bytes: found.size, changedAt: found.mtime.toISOString() };
  }

  /** Adds a folder's entries to `found`; in a search also those of the folders in it. */
  private async read(
    full: string,
    folder: string,
    search: string,
    found: Found,
    depth: number,
  ): Promise<void> {
    const inside: string[] = [];
    for await (const entry of await opendir(full)) {
      if (++found.readCount > MAX_READ) break;
      if (whyNotName(entry.name) !== null) continue;
      const path = folder === "" ? entry.name : `${folder}/${entry.name}`;
      if (entry.isDirectory()) inside.push(path);
      else if (entry.isFile() && isDrawingName(entry.name) && entry.name.toLowerCase().includes(search)) {
        found.files.push(path);
      }
    }
    found.folders.push(...inside);
    if (search === "" || depth >= MAX_DEPTH) return;
    for (const path of inside) {
      if (found.readCount >= MAX_READ) return;
      await this.read(join(full, nameOf(path)), path, search, found, depth + 1);
    }
  }
}

interface Found {
  readonly folders: string[];
  readonly files: string[];
  readCount: number;
}

/** "sheet 2" before "sheet 10". */
const BY_NAME = new Intl.Collator("en", { numeric: true, sensitivity: "base" });

const nameOf = (path: string): string => path.slice(path.lastIndexOf("/") + 1);
const folderOf = (path: string): string => path.slice(0, Math.max(0, path.lastIndexOf("/")));

function mustBeDrawing(path: string): void {
  parseWith(libraryPathSchema, path);
  if (isDrawingName(path)) return;
  throw new PlotwrightError(
    "bad-setting",
    `"${path}" is not the name of a drawing. It must end with the extension of one, such as .svg.`,
  );
}

const notFound = (path: string): PlotwrightError =>
  new PlotwrightError("not-found", `The library has no "${path}".`);
const taken = (path: string): PlotwrightError =>
  new PlotwrightError(
    "conflict",
    `The library has "${path}" already. Choose another name, or remove that one first.`,
  );
