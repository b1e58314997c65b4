/** The library: drawings that a server keeps in folders, apart from its jobs. */
import { z } from "zod";
import { nameSchema } from "./name.js";

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
