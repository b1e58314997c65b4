/** Any file that we read to a Drawing, told apart by what is in it; the name decides only in doubt. */
import type { Drawing } from "../drawing/drawing.js";
import { PlotwrightError } from "../errors.js";
import { importDxf } from "./dxf/import-dxf.js";
import { importHpgl } from "./hpgl/import-hpgl.js";
import { importPolylines } from "./json/import-polylines.js";
import type { ImportOptions } from "./import-options.js";
import { importSvgSteps, type Pause } from "./svg/import-svg.js";

export const DRAWING_FORMATS = ["svg", "dxf", "hpgl", "json"] as const;
export type DrawingFormat = (typeof DRAWING_FORMATS)[number];

const FORMAT_OF_ENDING: ReadonlyMap<string, DrawingFormat> = new Map([
  ["svg", "svg"],
  ["dxf", "dxf"],
  ["hpgl", "hpgl"],
  ["hpg", "hpgl"],
  ["hgl", "hpgl"],
  ["plt", "hpgl"],
  ["json", "json"],
]);
const PORT_SET_UP = /^(?:\u001b(?:\.[^;:()A-Za-z]*[;:()@]?|%-?\d*[A-Z]|[A-Z]))+/;
const HPGL_START =
  /^\s*(IN|DF|SP|PU|PD|PA|PR|IP|SC|VS|LT|PE|BP|CO|RO)\s*(?:[-\d;,"\s\u0003]|SP|PU|PD|PA|IP|SC)/i;
const HEAD_CHARS = 4096;

/** What the text is; null where nothing fits. */
export function formatOf(name: string, text: string): DrawingFormat | null {
  const head = text.slice(0, HEAD_CHARS).replace(/^[\ufeff\s]+/, "");
  if (head.startsWith("<")) return "svg";
  if (head.startsWith("{") || head.startsWith("[")) return "json";
  if (/^(AutoCAD Binary DXF|0\s*\r?\n\s*SECTION|999\s*\r?\n)/.test(head)) return "dxf";
  // Escape sequences may set up the port before the first command.
  const commands = head.replace(PORT_SET_UP, "");
  if (HPGL_START.test(commands)) return "hpgl";
  const ending = /\.([a-z]+)$/i.exec(name)?.[1].toLowerCase() ?? "";
  return FORMAT_OF_ENDING.get(ending) ?? null;
}

/**
 * The drawing in the text of a file. Throws PlotwrightError("bad-file").
 *
 * @example
 * const drawing = importDrawing("box.dxf", text);
 */
export function importDrawing(name: string, text: string, options: ImportOptions = {}): Drawing {
  const steps = importDrawingSteps(name, text, options);
  for (;;) {
    const step = steps.next();
    if (step.done) return step.value;
  }
}

/** As `importDrawing`, pausing after every few milliseconds of an SVG's work; the others go in one step. */
export async function importDrawingWithPauses(
  name: string,
  text: string,
  pause: Pause,
  options: ImportOptions = {},
): Promise<Drawing> {
  const steps = importDrawingSteps(name, text, options);
  for (;;) {
    const step = steps.next();
    if (step.done) return step.value;
    await pause();
  }
}

function* importDrawingSteps(name: string, text: string, options: ImportOptions): Generator<void, Drawing> {
  switch (formatOf(name, text)) {
    case "svg":
      return yield* importSvgSteps(text, options);
    case "dxf":
      return importDxf(text, options);
    case "hpgl":
      return importHpgl(text, options);
    case "json":
      return importPolylines(text);
    case null:
      // The SVG reader knows the marks of PDF, PNG and others, and says which it is.
      if (/^(%|\u0089|\ufffd|\u001f|GIF8|PK)/.test(text)) return yield* importSvgSteps(text, options);
      throw new PlotwrightError(
        "bad-file",
        `${name || "The file"} is no drawing that can be read: it is neither SVG, DXF, HPGL nor JSON polylines. Export it as SVG.`,
      );
  }
}
