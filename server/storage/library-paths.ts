/** Which names and paths the library has: those that are the same file on every system, and lead nowhere else. */
import { z } from "zod";
import { printable } from "../../src/internal.js";

/** How deep folders may lie in each other. */
const MAX_DEPTH = 8;
/** File systems allow 255 bytes for a name. */
const MAX_NAME_BYTES = 200;
/** Not in names of files on Windows, or with a meaning in paths. */
const FORBIDDEN = /[<>:"/\\|?*]/;
/** Names of devices on Windows, with any extension. */
const DEVICE = /^(con|prn|aux|nul|com\d|lpt\d)(\.|$)/i;

/** Why a folder or file of the library can't have this name; null: it can. */
export function whyNotName(name: string): string | null {
  if (name === "") return "a name is empty";
  if (name.startsWith(".")) return "a name begins with a point";
  if (name !== name.trim() || name.endsWith("."))
    return "a name begins or ends with a space, or ends with a point";
  if (FORBIDDEN.test(name) || printable(name) !== name) return "a name has a character that files can't have";
  if (DEVICE.test(name)) return "a name is that of a device on Windows";
  // The same letters written in two ways would be two files, or one, depending on the computer.
  if (name.normalize("NFC") !== name) return "a name has letters in a form that is not usual";
  return bytesOf(name) > MAX_NAME_BYTES ? "a name is too long" : null;
}

/** In UTF-8. */
const bytesOf = (name: string): number => encodeURIComponent(name).replace(/%../g, "x").length;

/** Why this is not a path in the library; null: it is one. */
function whyNotPath(path: string): string | null {
  const names = path.split("/");
  if (names.length > MAX_DEPTH) return `there may be ${MAX_DEPTH - 1} folders in each other`;
  return names.reduce<string | null>((why, name) => why ?? whyNotName(name), null);
}

const pathSchema = (isAllowed: (path: string) => string | null) =>
  z
    .string()
    .max(MAX_DEPTH * MAX_NAME_BYTES)
    .superRefine((path, context) => {
      const why = isAllowed(path);
      if (why !== null) context.addIssue({ code: "custom", message: why });
    });

/** A folder: names with "/" between them; "" is the library itself. */
export const libraryFolderSchema = pathSchema((path) => (path === "" ? null : whyNotPath(path)));

/** A folder or a drawing. */
export const libraryPathSchema = pathSchema(whyNotPath);
