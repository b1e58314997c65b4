/**
 * SVG path data (SVG 2, §9.3) directly into a ShapeBuffer: no token objects, one pass.
 *
 * Everything before an error is kept, as the specification requires. Numbers: digits are accumulated in an
 * integer; below 2^53 and with at most 22 decimals, one division by a power of ten gives the correctly
 * rounded double (Clinger 1990). Everything else goes through Number().
 */
import { drawSvgArc } from "./arc.js";
import { ShapeBuffer } from "./shape-buffer.js";

const POWERS = Array.from({ length: 23 }, (_, i) => Number(`1e${i}`));
const MAX_EXACT = 2 ** 53;

/** Reads numbers from a text; used for path data and point lists. */
export class NumberReader {
  at = 0;
  /** The number read by `read`. */
  value = 0;

  constructor(public text: string) {}

  /** Skips blanks and at most one comma. */
  skipSeparator(): void {
    this.skipBlanks();
    if (this.text.charCodeAt(this.at) === 44) {
      this.at++;
      this.skipBlanks();
    }
  }

  skipBlanks(): void {
    const text = this.text;
    let at = this.at;
    for (;;) {
      const c = text.charCodeAt(at);
      if (c === 32 || (c >= 9 && c <= 13)) at++;
      else break;
    }
    this.at = at;
  }

  /** Reads a number at the current position into `value`; returns whether there was one. */
  read(): boolean {
    const text = this.text;
    const start = this.at;
    let at = start;
    let c = text.charCodeAt(at);
    const negative = c === 45;
    if (negative || c === 43) c = text.charCodeAt(++at);
    let mantissa = 0;
    let digits = 0;
    let decimals = 0;
    while (c >= 48 && c <= 57) {
      mantissa = mantissa * 10 + (c - 48);
      digits++;
      c = text.charCodeAt(++at);
    }
    if (c === 46) {
      c = text.charCodeAt(++at);
      // A decimal point must be followed by a digit (SVG 2, §9.3.9).
      if (!(c >= 48 && c <= 57)) return false;
      while (c >= 48 && c <= 57) {
        mantissa = mantissa * 10 + (c - 48);
        digits++;
        decimals++;
        c = text.charCodeAt(++at);
      }
    }
    if (digits === 0) return false;
    let hasExponent = false;
    if (c === 101 || c === 69) {
      let e = at + 1;
      c = text.charCodeAt(e);
      if (c === 43 || c === 45) c = text.charCodeAt(++e);
      if (c >= 48 && c <= 57) {
        hasExponent = true;
        while (c >= 48 && c <= 57) c = text.charCodeAt(++e);
        at = e;
      }
    }
    this.at = at;
    if (hasExponent || mantissa >= MAX_EXACT || decimals > 22) this.value = Number(text.slice(start, at));
    else this.value = (negative ? -mantissa : mantissa) / POWERS[decimals];
    return true;
  }

  /** Reads the number after a separator. */
  readNext(): boolean {
    this.skipSeparator();
    return this.read();
  }

  /** Reads an arc flag: one character, so that "a1 1 0 01.5.5" reads as 0, 1, .5, .5. */
  readFlag(): boolean {
    const c = this.text.charCodeAt(this.at);
    if (c !== 48 && c !== 49) return false;
    this.value = c - 48;
    this.at++;
    return true;
  }
}

/**
 * Appends the path to `shape`. `arcTolerance` in the path's units. Returns the index of the first character
 * that is not path data, or −1.
 */
export function drawPathData(shape: ShapeBuffer, text: string, arcTolerance: number): number {
  return pathReader.run(shape, text, arcTolerance);
}

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
/** Argument count by character code; −1 if it is not a command. */
const COUNT_OF_CODE = new Int8Array(128).fill(-1);
for (const [letter, count] of Object.entries(ARGUMENTS)) {
  COUNT_OF_CODE[letter.charCodeAt(0)] = count;
  COUNT_OF_CODE[letter.toUpperCase().charCodeAt(0)] = count;
}

class PathDataReader {
  private readonly reader = new NumberReader("");
  private shape = new ShapeBuffer();
  private arcTolerance = 1;
  private readonly args = new Float64Array(7);
  /** Control point of the last curve, for S and T; valid while `previous` is of that kind. */
  private controlX = 0;
  private controlY = 0;
  private previous = 0;

  run(shape: ShapeBuffer, text: string, arcTolerance: number): number {
    const { reader } = this;
    this.shape = shape;
    this.arcTolerance = arcTolerance;
    this.previous = 0;
    reader.text = text;
    reader.at = 0;
    reader.skipBlanks();
    if (reader.at === text.length || text === "none") return -1;
    if ((text.charCodeAt(reader.at) | 32) !== 109) return reader.at;
    while (reader.at < text.length) {
      const stoppedAt = reader.at;
      const code = text.charCodeAt(stoppedAt);
      const count = code < 128 ? COUNT_OF_CODE[code] : -1;
      if (count < 0) return stoppedAt;
      reader.at++;
      if (count === 0) {
        this.shape.close();
        this.previous = 122;
        reader.skipBlanks();
      } else {
        const fault = this.readRuns(code, count);
        if (fault >= 0) return fault;
      }
    }
    return -1;
  }

  /** Skips blanks and a comma; returns whether another set of arguments follows. */
  private hasMore(text: string): boolean {
    const { reader } = this;
    let c = text.charCodeAt(reader.at);
    if (c <= 32) {
      reader.skipBlanks();
      c = text.charCodeAt(reader.at);
    }
    if (c === 44) {
      reader.at++;
      reader.skipBlanks();
      return true;
    }
    return (c >= 48 && c <= 57) || c === 45 || c === 46 || c === 43;
  }

  /** The reader's position, but at most the last character. */
  private faultAt(): number {
    const { at, text } = this.reader;
    return at < text.length ? at : Math.max(0, text.length - 1);
  }

  /** Reads every set of arguments after one command letter. */
  private readRuns(code: number, count: number): number {
    const { reader, args } = this;
    const { text } = reader;
    const relative = code >= 97;
    let kind = code | 32;
    reader.skipBlanks();
    for (;;) {
      for (let i = 0; i < count; i++) {
        if (!this.readArgument(kind, i)) return this.faultAt();
        args[i] = reader.value;
      }
      this.draw(kind, relative);
      this.previous = kind;
      // Further points after a move are lines.
      if (kind === 109) kind = 108;
      if (!this.hasMore(text)) return -1;
    }
  }

  private readArgument(kind: number, i: number): boolean {
    const { reader } = this;
    if (i === 0) return reader.read();
    if (kind !== 97 || (i !== 3 && i !== 4)) return reader.readNext();
    reader.skipSeparator();
    return reader.readFlag();
  }

  private draw(kind: number, relative: boolean): void {
    const { shape, args } = this;
    const x0 = shape.x;
    const y0 = shape.y;
    const dx = relative ? x0 : 0;
    const dy = relative ? y0 : 0;
    switch (kind) {
      case 109: // m
        shape.moveTo(args[0] + dx, args[1] + dy);
        return;
      case 108: // l
        shape.lineTo(args[0] + dx, args[1] + dy);
        return;
      case 104: // h
        shape.lineTo(args[0] + dx, y0);
        return;
      case 118: // v
        shape.lineTo(x0, args[0] + dy);
        return;
      case 99: // c
        this.controlX = args[2] + dx;
        this.controlY = args[3] + dy;
        shape.cubicTo(args[0] + dx, args[1] + dy, this.controlX, this.controlY, args[4] + dx, args[5] + dy);
        return;
      case 115: {
        // s: the first control mirrors the last one, after c or s
        const smooth = this.previous === 99 || this.previous === 115;
        const cx = smooth ? 2 * x0 - this.controlX : x0;
        const cy = smooth ? 2 * y0 - this.controlY : y0;
        this.controlX = args[0] + dx;
        this.controlY = args[1] + dy;
        shape.cubicTo(cx, cy, this.controlX, this.controlY, args[2] + dx, args[3] + dy);
        return;
      }
      case 113: // q
        this.controlX = args[0] + dx;
        this.controlY = args[1] + dy;
        shape.quadraticTo(this.controlX, this.controlY, args[2] + dx, args[3] + dy);
        return;
      case 116: {
        // t: the control mirrors the last one, after q or t
        const smooth = this.previous === 113 || this.previous === 116;
        this.controlX = smooth ? 2 * x0 - this.controlX : x0;
        this.controlY = smooth ? 2 * y0 - this.controlY : y0;
        shape.quadraticTo(this.controlX, this.controlY, args[0] + dx, args[1] + dy);
        return;
      }
      default: // a
        drawSvgArc(
          shape,
          args[0],
          args[1],
          args[2],
          args[3] === 1,
          args[4] === 1,
          args[5] + dx,
          args[6] + dy,
          this.arcTolerance,
        );
    }
  }
}

/** Shared by all paths: creating a reader costs as much as reading a short path. */
const pathReader = new PathDataReader();
