/**
 * Splits an HPGL file into commands: two letters and their parameters, up to a semicolon or the next command. Texts are
 * read by their own rules, so that what they contain is never taken for commands. Escape sequences and
 * the printer language PCL around HP-GL/2 are skipped.
 */
import { GROUP_OF } from "./hpgl-commands.js";
import { clamp } from "../../geometry/polyline.js";

export interface HpglCommand {
  /** Two capital letters. */
  readonly name: string;
  readonly numbers: readonly number[];
  /** The label, character or encoded line. */
  readonly text: string;
  /** The text has no end, so the rest of the file would belong to it. */
  readonly isOpen?: boolean;
}

const ETX = "\u0003";
const BETWEEN_COMMANDS = /[^A-Za-z\u001b]*/y;
const NAME = /[A-Za-z]{2}/y;
/** Numbers and what separates them. */
const NUMBERS = /[^A-Za-z";\u0003\u001b]*/y;
/** HPGL has none, but programs write them, and no command has one letter. */
const EXPONENT = /(?<=[\d.])[Ee][+-]?\d+/y;
const NUMBER = /[+-]?(?:\d+\.?\d*|\.\d+)(?:[Ee][+-]?\d+)?/g;
const MESSAGE = /[^;\r\n\u0003]*/y;
/** A text without an end is taken to end with the line or at a semicolon. */
const OPEN_TEXT = /[^;\r\n]*/y;
/** The label terminator of DT, and whether it is drawn. A space is one, too. */
const TERMINATOR = /([^\0\n\r\u001b;])(?:,\s*(\d))?/y;
/** Leaves any printer language; lines for the print job may follow. */
const JOB_LINES = /\u001b%-12345X(?:\s*@PJL[^\n]*)*/y;
/** The first letter after the dot is a command to the port. Only a colon ends its numbers. */
const PORT_COMMAND = /\u001b\.[^\u001b](?:[\d;, ]*:)?/y;
/** To PCL. A reset (E) leads there only on printers, so only if HP-GL/2 is entered later. */
const TO_PCL = /\u001b(?:%-?\d*A|E)/y;
const OUT_OF_PCL = /\u001b%-?\d*B|(?=\u001b%-12345X)/g;
const PCL_COMMAND = /\u001b(?:[!-/][^\u001bA-Z@]*[A-Z@]?|[0-~])?/y;

/** What may come before HPGL's first command: lines for a print job, and settings of the port or the printer. */
const PREFACE = /^(?:\s*@PJL[^\n]*\n|\s*\u001b(?:\.[^;:()A-Za-z]*[;:()@]?|[%&(*]?[-a-z\d]*[A-Z]))+/;
const FIRST_COMMAND =
  /^\s*(IN|DF|SP|PU|PD|PA|PR|IP|SC|VS|LT|PE|BP|CO|RO)\s*(?:[-\d;,"\s\u0003]|SP|PU|PD|PA|IP|SC)/i;

/** Whether a text is HPGL, judged by its beginning. */
export const isHpglBegun = (head: string): boolean => FIRST_COMMAND.test(head.replace(PREFACE, ""));

export class HpglReader {
  private at = 0;
  private labelEnd = ETX;
  private isLabelEndDrawn = false;
  /** Terminators that do not occur again in the file. */
  private readonly lastEnds = new Set<string>();
  private hasMoreHpgl = true;

  constructor(private readonly text: string) {}

  /** The next command; null at the end. */
  next(): HpglCommand | null {
    const { text } = this;
    while (this.at < text.length) {
      this.take(BETWEEN_COMMANDS);
      if (text[this.at] === "\u001b") this.skipEscapeSequence();
      else {
        const name = this.take(NAME).toUpperCase();
        if (name !== "") return this.parametersOf(name);
        this.at++;
      }
    }
    return null;
  }

  private parametersOf(name: string): HpglCommand {
    if (name === "IN" || name === "DF") this.setTerminator(null);
    switch (GROUP_OF.get(name)?.reads) {
      case "label":
        return this.label(name);
      case "encoded":
        return { name, numbers: [], text: this.takeUntil(";") };
      case "character":
        return { name, numbers: [], text: name === "DT" ? this.terminator() : this.symbol() };
      case "message":
        return { name, numbers: [], text: this.message() };
      default:
        return { name, numbers: this.numbers(), text: "" };
    }
  }

  private numbers(): number[] {
    let text = this.take(NUMBERS);
    for (;;) {
      const isString = this.text[this.at] === '"';
      const exponent = isString ? "" : this.take(EXPONENT);
      if (isString) this.string();
      else if (exponent === "") break;
      text += `${isString ? " " : exponent}${this.take(NUMBERS)}`;
    }
    return (text.match(NUMBER) ?? []).map(Number);
  }

  private message(): string {
    while (this.text[this.at] === " ") this.at++;
    return this.text[this.at] === '"' ? this.string() : this.take(MESSAGE);
  }

  /** A string in double quotes; a doubled quote in it is a character. */
  private string(): string {
    let text = "";
    do {
      const end = this.text.indexOf('"', ++this.at);
      text += end < 0 ? this.take(OPEN_TEXT) : `${this.takeUntil('"')}"`;
    } while (this.text[this.at] === '"');
    return text;
  }

  private label(name: string): HpglCommand {
    const { labelEnd, isLabelEndDrawn } = this;
    if (!this.lastEnds.has(labelEnd) && !this.text.includes(labelEnd, this.at)) this.lastEnds.add(labelEnd);
    if (this.lastEnds.has(labelEnd)) return { name, numbers: [], text: this.take(OPEN_TEXT), isOpen: true };
    const text = this.takeUntil(labelEnd);
    return { name, numbers: [], text: isLabelEndDrawn ? `${text}${labelEnd}` : text };
  }

  private terminator(): string {
    TERMINATOR.lastIndex = this.at;
    const match = TERMINATOR.exec(this.text);
    if (match !== null) this.at = TERMINATOR.lastIndex;
    this.setTerminator(match);
    return this.labelEnd;
  }

  private setTerminator(match: readonly string[] | null): void {
    const [, char = ETX, mode] = match ?? [];
    this.labelEnd = char;
    this.isLabelEndDrawn = mode === "0";
  }

  /** "" for none. */
  private symbol(): string {
    const char = this.text[this.at] ?? "";
    if (char <= " " || char === ";") return "";
    this.at++;
    return char;
  }

  private skipEscapeSequence(): void {
    if (this.take(JOB_LINES) !== "" || this.take(PORT_COMMAND) !== "") return;
    const toPcl = this.take(TO_PCL);
    if (toPcl === "") this.take(PCL_COMMAND);
    else if (!this.skipPcl() && toPcl.endsWith("A")) this.at = this.text.length;
  }

  /** Skips to the next HP-GL/2; returns false if there is none. */
  private skipPcl(): boolean {
    OUT_OF_PCL.lastIndex = this.at;
    this.hasMoreHpgl = this.hasMoreHpgl && OUT_OF_PCL.test(this.text);
    if (this.hasMoreHpgl) this.at = OUT_OF_PCL.lastIndex;
    return this.hasMoreHpgl;
  }

  /** What matches here; "" if nothing does. */
  private take(pattern: RegExp): string {
    pattern.lastIndex = this.at;
    const match = pattern.exec(this.text);
    if (match === null) return "";
    this.at = pattern.lastIndex;
    return match[0];
  }

  /** The text before `end`, which is skipped. Without one, the rest. */
  private takeUntil(end: string): string {
    const from = this.at;
    const at = this.text.indexOf(end, from);
    this.at = at < 0 ? this.text.length : at + end.length;
    return this.text.slice(from, at < 0 ? undefined : at);
  }
}

/** What an encoded polyline does. */
interface EncodedTarget {
  pen(pen: number): void;
  move(x: number, y: number, isUp: boolean, isAbsolute: boolean): void;
}

const SEVEN_BITS = 0x7f;
const FIRST_DIGIT = 63;
const LAST_FLAG = 190;
const isDigit = (code: number): boolean =>
  (code >= FIRST_DIGIT && code < 127) || (code > LAST_FLAG && code < 255);

/**
 * HP-GL/2's encoded polyline (PE): numbers in base 64 or 32, least significant digit first; the last digit
 * has its own range; signs are zigzag-encoded. Flags: ":" pen, "<" up, "=" absolute, ">" fraction bits, "7"
 * base 32.
 */
export function readEncodedPolyline(text: string, target: EncodedTarget): void {
  let at = 0;
  let base = 64;
  let fractionBits = 0;
  let isUp = false;
  let isAbsolute = false;

  /** The next number, or null at the end. Blanks, control characters and others that are no digit are skipped. */
  const read = (): number | null => {
    let value = 0;
    let place = 1;
    while (at < text.length) {
      const code = text.charCodeAt(at++) & (base === 32 ? SEVEN_BITS : 0xff);
      const last = base === 64 ? 191 : 95;
      const isLast = code >= last && code < last + base;
      if (!isLast && !(code >= FIRST_DIGIT && code < FIRST_DIGIT + base)) continue;
      value += (code - (isLast ? last : FIRST_DIGIT)) * place;
      place *= base;
      if (isLast) return value % 2 === 1 ? -(value - 1) / 2 : value / 2;
    }
    return null;
  };

  while (at < text.length) {
    // The eighth bit of a flag counts for nothing. Digits with it are all above 190.
    const code = text.charCodeAt(at);
    const flag = String.fromCharCode(code > LAST_FLAG ? code : code & SEVEN_BITS);
    if (flag === "7") base = 32;
    else if (flag === "<") isUp = true;
    else if (flag === "=") isAbsolute = true;
    else if (flag === ":" || flag === ">") {
      at++;
      const value = read();
      if (value === null) return;
      if (flag === ":") target.pen(value);
      else fractionBits = clamp(value, -26, 26);
      continue;
    } else if (isDigit(code)) {
      const x = read();
      const y = read();
      if (x === null || y === null) return;
      const unit = 2 ** -fractionBits;
      target.move(x * unit, y * unit, isUp, isAbsolute);
      isUp = false;
      isAbsolute = false;
      continue;
    }
    at++;
  }
}
