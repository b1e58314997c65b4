/** The library: drawings that a server keeps in folders, apart from its jobs. */
import { z } from "zod";
import { nameSchema } from "./name.js";
import { okSchema, operation } from "./operation.js";

/** A folder: names with "/" between them; "" is the library itself. The server checks the names. */
const folderSchema = z.string().max(1_600);

/** With `name`: all drawings in the folder and below that have it in their name, in upper or lower case. */
export const libraryRequestSchema = z.object({ folder: folderSchema, name: z.string().max(200) }).partial();
export type LibraryRequest = z.infer<typeof libraryRequestSchema>;

export const libraryFileInfoSchema = z.object({
  /** From the library's folder, with "/" between the names. */
  path: z.string(),
  bytes: z.number(),
  /** ISO 8601. */
  changedAt: z.string(),
});
export type LibraryFileInfo = z.infer<typeof libraryFileInfoSchema>;

export const libraryListSchema = z.object({
  folder: z.string(),
  /** Paths of the folders in it, by name; none in a search. */
  folders: z.array(z.string()),
  /** By name. */
  files: z.array(libraryFileInfoSchema),
  /** There are more than are listed. */
  isCut: z.boolean(),
});
export type LibraryList = z.infer<typeof libraryListSchema>;

/** Where a job's drawing is kept; without a name, that of the job. */
export const keepRequestSchema = z.object({ folder: folderSchema, name: nameSchema(200) }).partial();
export type KeepRequest = z.infer<typeof keepRequestSchema>;

/** Rows of the table in operations.ts. Only a server has a library. A path has "/" between its names, as %2F in an address. */
export const LIBRARY_OPERATIONS = {
  list: operation(
    "get",
    "/library",
    "Lists folders and drawings of the library, in ?folder=PATH; with ?name=PART all drawings there and below that have it in their name",
    libraryListSchema,
    { query: libraryRequestSchema, role: "watch" },
  ),
  get: operation("get", "/library/:path", "Returns a drawing of the library", "file", { role: "watch" }),
  save: operation(
    "put",
    "/library/:path",
    "Stores a drawing in the library, the file as the body; folders that are missing are made, nothing is overwritten",
    libraryFileInfoSchema,
    { body: "file", status: 201 },
  ),
  remove: operation(
    "delete",
    "/library/:path",
    "Removes a drawing or an empty folder of the library",
    okSchema,
  ),
  keep: operation(
    "post",
    "/jobs/:id/keep",
    "Copies a job's drawing into the library; if the name is taken, a number is added",
    libraryFileInfoSchema,
    { body: keepRequestSchema, isBodyOptional: true, status: 201 },
  ),
} as const;
