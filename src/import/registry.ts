/**
 * The drawing formats. A new one needs an entry in FORMATS, a line in READERS and its reader; page, server,
 * watched folder and command line use these tables.
 *
 * FORMATS is separate from READERS, so that the page knows the file extensions without loading the readers.
 */
import { checkText } from "../check-arguments.js";
import type { Drawing } from "../drawing/drawing.js";
import { PlotwrightError } from "../errors.js";
import { importDxf } from "./dxf/import-dxf.js";
import { isHpglBegun } from "./hpgl/hpgl-reader.js";
import { importHpgl } from "./hpgl/import-hpgl.js";
import { checkImportOptions, type ImportOptions } from "./import-options.js";
import { importPolylines } from "./json/import-polylines.js";
import { importSheet, isSheetBegun } from "./sheet/import-sheet.js";
import { importSvg } from "./svg/import-svg.js";

type DrawingFormat = "svg" | "dxf" | "hpgl" | "sheet" | "json";

interface Format {
  /** Common name. */
  readonly name: string;
  /** File extensions without the dot; the usual one first. */
  readonly extensions: readonly string[];
  /** Whether a text is in this format, judged by its first few thousand characters, without leading blanks. */
  readonly isBegun: (head: string) => boolean;
}

const FORMATS: Readonly<Record<DrawingFormat, Format>> = {
  svg: { name: "SVG", extensions: ["svg"], isBegun: (head) => head.startsWith("<") },
  dxf: {
    name: "DXF",
    extensions: ["dxf"],
    isBegun: (head) => /^(AutoCAD Binary DXF|0\s*\r?\n\s*SECTION|999\s*\r?\n)/.test(head),
  },
  hpgl: {
    name: "HPGL",
    extensions: ["hpgl", "hpg", "hgl", "plt"],
    isBegun: isHpglBegun,
  },
  // Before polylines, which are JSON too.
  sheet: { name: "plotwright sheet", extensions: [], isBegun: isSheetBegun },
  json: { name: "JSON polylines", extensions: ["json"], isBegun: (head) => /^[{[]/.test(head) },
};

/** Throws PlotwrightError("bad-file"). */
type Reader = (text: string, options: ImportOptions) => Drawing | Promise<Drawing>;

const READERS: Readonly<Record<DrawingFormat, Reader>> = {
  svg: importSvg,
  dxf: importDxf,
  hpgl: importHpgl,
  sheet: (text, { pxPerInch: _ofOneFile, ...options }) =>
    importSheet(text, (file) => importDrawing("", file, options)),
  json: importPolylines,
};

const DRAWING_FORMATS = Object.keys(FORMATS) as DrawingFormat[];
/** The extensions of all formats, without the dot. */
export const DRAWING_EXTENSIONS: readonly string[] = DRAWING_FORMATS.flatMap(
  (format) => FORMATS[format].extensions,
);

const HEAD_CHARS = 4096;

const extensionOf = (name: string): string => /\.([a-z\d]+)$/i.exec(name)?.[1].toLowerCase() ?? "";

/** Whether a file's extension is that of a drawing format. */
export const isDrawingName = (name: string): boolean => DRAWING_EXTENSIONS.includes(extensionOf(name));

/** The format of a text by its content, or else by its name. Null if nothing matches. */
export function formatOf(name: string, text: string): DrawingFormat | null {
  const head = text.slice(0, HEAD_CHARS).replace(/^[\ufeff\s]+/, "");
  const extension = extensionOf(name);
  return (
    DRAWING_FORMATS.find((format) => FORMATS[format].isBegun(head)) ??
    DRAWING_FORMATS.find((format) => FORMATS[format].extensions.includes(extension)) ??
    null
  );
}

/**
 * Reads the text of an SVG, DXF, HPGL or JSON file. The format is detected from the text and the file's name.
 *
 * @throws PlotwrightError "bad-file" for an unknown format or a damaged file
 * @example
 * const drawing = await importDrawing("box.dxf", text);
 */
export async function importDrawing(
  name: string,
  text: string,
  options: ImportOptions = {},
): Promise<Drawing> {
  checkText("importDrawing(name, text)", text);
  checkImportOptions(options);
  return readerOf(name, text)(text, options);
}

function readerOf(name: string, text: string): Reader {
  const format = formatOf(name, text);
  if (format !== null) return READERS[format];
  // The SVG reader recognises PDF, PNG and others, and names them in its error.
  if (/^(%|\u0089|\ufffd|\u001f|GIF8|PK)/.test(text)) return READERS.svg;
  const names = DRAWING_FORMATS.map((one) => FORMATS[one].name);
  const why =
    text.trim() === "" ? "it is empty" : `it is neither ${names.slice(0, -1).join(", ")} nor ${names.at(-1)}`;
  throw new PlotwrightError(
    "bad-file",
    `${name || "The file"} cannot be read as a drawing: ${why}. Export it as SVG.`,
  );
}
