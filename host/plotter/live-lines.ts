/**
 * The lines of a live drawing as text, for programs in any language. One line is
 *
 *     120.5 80           the next point of the stroke that grows, in mm from home; also 120.5,80 or [120.5, 80]
 *     [[0, 0], [9, 9]]   a whole stroke
 *     up                 the stroke is complete; an empty line too
 */
import { PlotwrightError } from "../../src/index.js";

type LinePoint = readonly [x: number, y: number];

/** Takes the strokes of a live drawing. */
interface TakesLines {
  stroke(points: readonly LinePoint[]): void;
  lineTo(x: number, y: number): void;
  penUp(): void;
}

/** Adds what a line says. Throws `bad-file` for a line that says nothing, and the errors of `pen`. */
export function drawLine(line: string, pen: TakesLines): void {
  const text = line.trim();
  if (text === "" || text === "up") return pen.penUp();
  const value = text.startsWith("[") ? parsed(text) : text.split(/[\s,]+/).map(Number);
  if (isPoint(value)) pen.lineTo(value[0], value[1]);
  else if (Array.isArray(value) && value.length > 0 && value.every(isPoint)) pen.stroke(value);
  else {
    const shown = text.length > 60 ? `${text.slice(0, 60)}…` : text;
    throw new PlotwrightError(
      "bad-file",
      `"${shown}" is no point such as 120.5 80, no stroke such as [[0, 0], [9, 9]], and not up.`,
    );
  }
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}

const isPoint = (value: unknown): value is LinePoint =>
  Array.isArray(value) && value.length === 2 && value.every((one) => Number.isFinite(one));
