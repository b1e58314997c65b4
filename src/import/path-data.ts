/**
 * SVG path data (SVG 2, §9.3) into a ShapeBuffer. Everything before an error is kept, as the specification requires.
 */
import { drawSvgArc } from "./arc.js";
import type { ShapeBuffer } from "./shape-buffer.js";

/** A decimal point must be followed by a digit (SVG 2, §9.3.9). */
const NUMBER = /[+-]?(?:\d*\.\d+|\d+(?![\d.]))(?:[eE][+-]?\d+)?/y;
const BLANKS = /[ \t-\r]*/y;

/** Reads numbers from a text; used for path data and point lists. */
export class NumberReader {
  at = 0;

  constructor(readonly text: string) {}

  skipBlanks(): void {
    BLANKS.lastIndex = this.at;
    BLANKS.test(this.text);
    this.at = BLANKS.lastIndex;
  }

  /** Skips blanks and at most one comma. */
  skipSeparator(): void {
    this.skipBlanks();
    if (this.text[this.at] !== ",") return;
    this.at++;
    this.skipBlanks();
  }

  /** Reads the number at the current position; null if there is none. */
  read(): number | null {
    NUMBER.lastIndex = this.at;
    if (!NUMBER.test(this.text)) return null;
    const start = this.at;
    this.at = NUMBER.lastIndex;
    return Number(this.text.slice(start, this.at));
  }

  /** Reads an arc flag: one character, so that "a1 1 0 01.5.5" reads as 0, 1, .5, .5. */
  readFlag(): number | null {
    const flag = this.text[this.at];
    if (flag !== "0" && flag !== "1") return null;
    this.at++;
    return Number(flag);
  }
}

/**
 * Appends the path to `shape`. `arcTolerance` in the path's units. Returns the index of the first character
 * that is not path data, or −1.
 */
export function drawPathData(shape: ShapeBuffer, text: string, arcTolerance: number): number {
  return new PathDataReader(shape, text, arcTolerance).run();
}

/** How many arguments each command takes. */
const ARGUMENTS: Readonly<Record<string, number>> = {
  m: 2,
  l: 2,
  h: 1,
  v: 1,
  c: 6,
  s: 4,
  q: 4,
  t: 2,
  a: 7,
  z: 0,
};

class PathDataReader {
  private readonly reader: NumberReader;
  /** Control point of the last curve, for S and T; valid while `previous` is of that kind. */
  private controlX = 0;
  private controlY = 0;
  /** The previous command, as a lower-case letter. */
  private previous = "";

  constructor(
    private readonly shape: ShapeBuffer,
    private readonly text: string,
    private readonly arcTolerance: number,
  ) {
    this.reader = new NumberReader(text);
  }

  run(): number {
    const { reader, text } = this;
    reader.skipBlanks();
    if (reader.at === text.length || text === "none") return -1;
    if (text[reader.at] !== "m" && text[reader.at] !== "M") return reader.at;
    while (reader.at < text.length) {
      const letter = text[reader.at];
      const kind = letter.toLowerCase();
      const count = ARGUMENTS[kind];
      if (count === undefined) return reader.at;
      reader.at++;
      reader.skipBlanks();
      if (count === 0) {
        this.shape.close();
        this.previous = kind;
      } else if (!this.drawRuns(kind, letter === kind, count)) {
        return Math.min(reader.at, text.length - 1);
      }
    }
    return -1;
  }

  /** Draws every set of arguments after one command letter; false if an argument is missing. */
  private drawRuns(letter: string, isRelative: boolean, count: number): boolean {
    let kind = letter;
    do {
      const args = this.readArguments(kind, count);
      if (args === null) return false;
      this.draw(kind, isRelative, args);
      this.previous = kind;
      // Further points after a move are lines.
      if (kind === "m") kind = "l";
    } while (this.hasMore());
    return true;
  }

  private readArguments(kind: string, count: number): number[] | null {
    const { reader } = this;
    const args: number[] = [];
    for (let i = 0; i < count; i++) {
      if (i > 0) reader.skipSeparator();
      const isFlag = kind === "a" && (i === 3 || i === 4);
      const value = isFlag ? reader.readFlag() : reader.read();
      if (value === null) return null;
      args.push(value);
    }
    return args;
  }

  /** Skips blanks and a comma; returns whether another set of arguments follows. */
  private hasMore(): boolean {
    const { reader, text } = this;
    reader.skipBlanks();
    const hasComma = text[reader.at] === ",";
    reader.skipSeparator();
    return hasComma || /[\d.+-]/.test(text.charAt(reader.at));
  }

  private draw(kind: string, isRelative: boolean, args: readonly number[]): void {
    const { shape } = this;
    const x0 = shape.x;
    const y0 = shape.y;
    const dx = isRelative ? x0 : 0;
    const dy = isRelative ? y0 : 0;
    switch (kind) {
      case "m":
        shape.moveTo(args[0] + dx, args[1] + dy);
        return;
      case "l":
        shape.lineTo(args[0] + dx, args[1] + dy);
        return;
      case "h":
        shape.lineTo(args[0] + dx, y0);
        return;
      case "v":
        shape.lineTo(x0, args[0] + dy);
        return;
      case "c":
        this.controlX = args[2] + dx;
        this.controlY = args[3] + dy;
        shape.cubicTo(args[0] + dx, args[1] + dy, this.controlX, this.controlY, args[4] + dx, args[5] + dy);
        return;
      case "s": {
        // The first control point mirrors the last one of a curve before.
        const isSmooth = this.previous === "c" || this.previous === "s";
        const cx = isSmooth ? 2 * x0 - this.controlX : x0;
        const cy = isSmooth ? 2 * y0 - this.controlY : y0;
        this.controlX = args[0] + dx;
        this.controlY = args[1] + dy;
        shape.cubicTo(cx, cy, this.controlX, this.controlY, args[2] + dx, args[3] + dy);
        return;
      }
      case "q":
        this.controlX = args[0] + dx;
        this.controlY = args[1] + dy;
        shape.quadraticTo(this.controlX, this.controlY, args[2] + dx, args[3] + dy);
        return;
      case "t": {
        // The control point mirrors that of a quadratic curve before.
        const isSmooth = this.previous === "q" || this.previous === "t";
        this.controlX = isSmooth ? 2 * x0 - this.controlX : x0;
        this.controlY = isSmooth ? 2 * y0 - this.controlY : y0;
        shape.quadraticTo(this.controlX, this.controlY, args[0] + dx, args[1] + dy);
        return;
      }
      default: {
        const [rx, ry, turn, isLarge, isSweep, x, y] = args;
        drawSvgArc(shape, rx, ry, turn, isLarge === 1, isSweep === 1, x + dx, y + dy, this.arcTolerance);
      }
    }
  }
}
