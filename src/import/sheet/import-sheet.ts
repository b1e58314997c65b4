/**
 * plotwright's sheet: several drawings placed on one sheet, each of them once or several times.
 *
 *   { "format": "plotwright-sheet", "version": 1, "widthMm": 297, "heightMm": 210,
 *     "files": [ { "name": "leaf", "text": "<svg …" } ],
 *     "items": [ { "file": 0, "matrix": [1, 0, 0, 1, 20, 30] } ] }
 *
 * A file is the text of an SVG, DXF, HPGL or JSON drawing. An item places a file: its matrix maps the file's page to the
 * sheet, both in mm, as SVG's matrix(a b c d e f). Later items lie over earlier ones. With "crop": true, what lies outside
 * the file's page is cut off. A file may have a "layerPrefix", which begins the ids of its layers.
 */
import { combine, type SheetItem, type SheetSource } from "../../drawing/combine.js";
import type { Drawing } from "../../drawing/drawing.js";
import { PlotwrightError } from "../../errors.js";
import { isFiniteAffine, type Affine } from "../../geometry/affine.js";

/** A sheet as it is stored. */
export interface SheetFile {
  readonly format: "plotwright-sheet";
  readonly version: 1;
  readonly widthMm: number;
  readonly heightMm: number;
  readonly files: readonly {
    readonly name: string;
    readonly text: string;
    readonly layerPrefix: string;
  }[];
  readonly items: readonly {
    /** Index of the file. */
    readonly file: number;
    readonly matrix: readonly [number, number, number, number, number, number];
    readonly crop?: boolean;
  }[];
}

const MAX_PAGE_MM = 100_000;
const MAX_ITEMS = 10_000;

/** Whether a text is a sheet, by its beginning: the format is named before the first list. */
export const isSheetBegun = (head: string): boolean => /^\{[^[]*"format"\s*:\s*"plotwright-sheet"/.test(head);

const bad = (what: string): PlotwrightError =>
  new PlotwrightError(
    "bad-file",
    `The sheet cannot be read: ${what}. It should be { "format": "plotwright-sheet", "version": 1, "widthMm", "heightMm", "files": [{ "name", "text" }], "items": [{ "file", "matrix": [a, b, c, d, e, f] }] }.`,
  );

/** Throws PlotwrightError("bad-file"). */
export function parseSheet(text: string): SheetFile {
  let file: unknown;
  try {
    file = JSON.parse(text);
  } catch (cause) {
    throw new PlotwrightError("bad-file", `The sheet is damaged: ${(cause as Error).message.slice(0, 200)}`, {
      cause,
    });
  }
  const { version, widthMm, heightMm, files, items } = objectOf(file, "the file");
  if (version !== 1) throw bad(`its version is ${JSON.stringify(version)}, and this program knows version 1`);
  if (!Array.isArray(files)) throw bad("it has no list of files");
  if (!Array.isArray(items)) throw bad("it has no list of items");
  if (items.length > MAX_ITEMS) throw bad(`it has more than ${MAX_ITEMS} items`);
  return {
    format: "plotwright-sheet",
    version: 1,
    widthMm: pageSide(widthMm, "widthMm"),
    heightMm: pageSide(heightMm, "heightMm"),
    files: files.map((one: unknown, index) => {
      const where = `file ${index + 1}`;
      const { name = where, text: content, layerPrefix } = objectOf(one, where);
      if (typeof content !== "string") throw bad(`${where} has no text`);
      if (typeof name !== "string") throw bad(`the name of ${where} is not a text`);
      const prefix = layerPrefix ?? (index === 0 ? "" : `${index + 1}/`);
      if (typeof prefix !== "string") throw bad(`the layerPrefix of ${where} is not a text`);
      return { name, text: content, layerPrefix: prefix };
    }),
    items: items.map((one: unknown, index) => {
      const where = `item ${index + 1}`;
      const { file: number, matrix, crop = false } = objectOf(one, where);
      if (!Number.isInteger(number) || !Object.hasOwn(files, number as number)) {
        throw bad(`${where} names a file that is not in the list`);
      }
      if (!isMatrix(matrix)) throw bad(`the matrix of ${where} is not a list of 6 numbers`);
      if (typeof crop !== "boolean") throw bad(`the crop of ${where} is neither true nor false`);
      return { file: number as number, matrix, ...(crop ? { crop } : {}) };
    }),
  };
}

/**
 * The sheet as one drawing.
 *
 * @param read reads one of its files
 * @throws PlotwrightError "bad-file", naming the file
 */
export async function importSheet(text: string, read: (text: string) => Promise<Drawing>): Promise<Drawing> {
  const sheet = parseSheet(text);
  const sources: SheetSource[] = [];
  for (const { name, text: content, layerPrefix } of sheet.files) {
    sources.push({ drawing: await readNamed(name, content, read), name, layerPrefix });
  }
  return combine(sources, sheet.items.map(itemOf), sheet);
}

async function readNamed(
  name: string,
  text: string,
  read: (text: string) => Promise<Drawing>,
): Promise<Drawing> {
  try {
    return await read(text);
  } catch (cause) {
    if (!(cause instanceof PlotwrightError)) throw cause;
    throw new PlotwrightError(cause.code, `"${name}" of the sheet: ${cause.message}`, { cause });
  }
}

const itemOf = ({ file, matrix, crop }: SheetFile["items"][number]): SheetItem => ({
  source: file,
  map: affineOf(matrix),
  isCropped: crop,
});

const affineOf = ([a, b, c, d, e, f]: readonly number[]): Affine => ({ a, b, c, d, e, f });

const isMatrix = (value: unknown): value is SheetFile["items"][number]["matrix"] =>
  Array.isArray(value) &&
  value.length === 6 &&
  value.every((number) => typeof number === "number") &&
  isFiniteAffine(affineOf(value));

function objectOf(value: unknown, what: string): Record<string, unknown> {
  if (typeof value === "object" && value !== null && !Array.isArray(value)) {
    return value as Record<string, unknown>;
  }
  throw bad(`${what} is not an object`);
}

function pageSide(value: unknown, name: string): number {
  if (typeof value === "number" && value > 0 && value <= MAX_PAGE_MM) return value;
  throw bad(`${name} must be a number of mm above 0`);
}
