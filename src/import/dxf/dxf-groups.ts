/**
 * The groups of a text DXF: a line with a code, a line with its value. A group with code 0 begins a record: an
 * entity, an entry of a table, or the begin or end of a part of the file (AutoCAD DXF reference).
 */
import { PlotwrightError } from "../../errors.js";

export interface DxfGroup {
  readonly code: number;
  /** Without the blanks around it, except in texts. */
  readonly value: string;
}

/** Its type is the value of the group with code 0, in capitals. */
export interface DxfRecord {
  readonly type: string;
  readonly groups: readonly DxfGroup[];
}

export interface DxfPoint {
  readonly x: number;
  readonly y: number;
  /** Of the arc to the next point: the tangent of a quarter of its angle, positive if anticlockwise. */
  readonly bulge?: number;
}

export const distance = (a: DxfPoint, b: DxfPoint): number => Math.hypot(b.x - a.x, b.y - a.y);

/** A record that has a value that cannot be used. The message says which. Only that record is left out. */
export class OddValue extends Error {}

const COMMENT = 999;
/** Data of an application are between "{NAME" and "}". They may have the codes of the entity. */
const APPLICATION_DATA = 102;
/** Codes of texts. A long one is split, also at blanks. */
const TEXTS: ReadonlySet<string> = new Set(["1", "3"]);

/** The records up to EOF. Throws PlotwrightError("bad-file") if codes and values are out of step. */
export function* readRecords(text: string): Generator<DxfRecord> {
  const lines = text.split(/\r{0,2}\n|\r/);
  let record: { type: string; groups: DxfGroup[] } | null = null;
  let isOfApplication = false;
  for (let at = 0; at + 1 < lines.length; at += 2) {
    const code = lines[at].trim();
    const value = TEXTS.has(code) ? lines[at + 1] : lines[at + 1].trim();
    if (!/^-?\d{1,4}$/.test(code)) {
      if (code === "" && isBlankFrom(lines, at)) break;
      throw damaged(`at line ${at + 1}`, `"${code.slice(0, 20)}" is not a group code`);
    }
    if (Number(code) === APPLICATION_DATA) isOfApplication = value.startsWith("{");
    if (Number(code) !== 0) {
      if (Number(code) !== COMMENT && !isOfApplication) record?.groups.push({ code: Number(code), value });
      continue;
    }
    isOfApplication = false;
    if (record !== null) yield record;
    record = { type: value.toUpperCase(), groups: [] };
    if (record.type === "EOF") return;
  }
  // Some programs leave out EOF.
  if (record?.type === "ENDSEC") yield record;
  else throw damaged("at its end", "it has no EOF, so a part of the file is missing");
}

function isBlankFrom(lines: readonly string[], from: number): boolean {
  for (let at = from; at < lines.length; at++) if (lines[at].trim() !== "") return false;
  return true;
}

export const damaged = (where: string, what: string): PlotwrightError =>
  new PlotwrightError(
    "bad-file",
    `The DXF is damaged ${where}: ${what}. Save it again, preferably as DXF R12 or 2000.`,
  );

/** Some programs write the exponent with a D. */
const NUMBER = /^[-+]?(?:\d+\.?\d*|\.\d+)(?:[ed][-+]?\d+)?$/i;

/** Throws OddValue. */
export function numberOf({ code, value }: DxfGroup): number {
  const number = NUMBER.test(value) ? Number(value.replace(/d/i, "e")) : NaN;
  if (Number.isFinite(number)) return number;
  throw new OddValue(`group ${code} is "${value.slice(0, 20)}", not a number`);
}

/** Undefined if there is no such group; throws OddValue. */
export function numberIn(groups: readonly DxfGroup[], code: number): number | undefined {
  const group = groups.find((one) => one.code === code);
  return group === undefined ? undefined : numberOf(group);
}

export const numbersIn = (groups: readonly DxfGroup[], code: number): number[] =>
  groups.filter((group) => group.code === code).map(numberOf);

/** Throws OddValue if there is no such group. */
export function requiredIn(groups: readonly DxfGroup[], code: number): number {
  const number = numberIn(groups, code);
  if (number === undefined) throw new OddValue(`group ${code} is missing`);
  return number;
}

export const hasFlag = (groups: readonly DxfGroup[], code: number, flag: number): boolean =>
  ((numberIn(groups, code) ?? 0) & flag) !== 0;

export const textIn = (groups: readonly DxfGroup[], code: number): string =>
  groups.find((group) => group.code === code)?.value ?? "";

/** A name of a layer, block or linetype: letters outside the file's code page are written by their number. */
export const nameIn = (groups: readonly DxfGroup[], code: number): string =>
  textIn(groups, code).replace(/\\U\+([0-9A-F]{4})/gi, (_, hex: string) =>
    String.fromCharCode(parseInt(hex, 16)),
  );

/** Names in a DXF are the same in capital and small letters. */
export const keyOf = (name: string): string => name.toLowerCase();

/** x and y of the point whose x has this code; undefined if there is none. */
export const pointIn = (groups: readonly DxfGroup[], code: number): DxfPoint | undefined =>
  groups.some((group) => group.code === code) ? requiredPoint(groups, code) : undefined;

export const requiredPoint = (groups: readonly DxfGroup[], code: number): DxfPoint => ({
  x: requiredIn(groups, code),
  y: requiredIn(groups, code + 10),
});

/** All points whose x has this code; other groups between x and y are ignored. */
export const pointsIn = (groups: readonly DxfGroup[], code: number): DxfPoint[] =>
  splitAt(groups, code).map((point) => requiredPoint(point, code));

/** Splits before each group with that code; groups before the first are dropped. */
export function splitAt(groups: readonly DxfGroup[], code: number): DxfGroup[][] {
  const parts: DxfGroup[][] = [];
  for (const group of groups) {
    if (group.code === code) parts.push([group]);
    else parts.at(-1)?.push(group);
  }
  return parts;
}

/** Vertices from codes 10, 20 and 42; other groups between them are ignored. */
export const bulgedVertices = (groups: readonly DxfGroup[]): DxfPoint[] =>
  splitAt(groups, 10).map((vertex) => ({ ...requiredPoint(vertex, 10), bulge: numberIn(vertex, 42) ?? 0 }));
