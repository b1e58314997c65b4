/**
 * Parses MTEXT: paragraphs of runs, each in its own format (Autodesk, "Format codes for multiline text";
 * ezdxf, "MTEXT Internals"). Braces limit the scope of a format. Unknown codes are dropped, but never text.
 *
 *   \P \N \X ^J  a new paragraph          \Hv; \Hvx;  height, or factor        \S1/2; 1#2 1^2   stacked
 *   \pqc,i1,l2;  centred, indented        \Wv; \Tv;   width, tracking            \An;  baseline, middle, top
 *   \Cn; \cn;    colour, by index or RGB  \Qv;        slant, degrees             \f \F font  \L \O \K lines: not drawn
 */
import { aciColor } from "./aci-color.js";
import { clamp } from "../../geometry/polyline.js";

export interface MtextFormat {
  /** Height of capitals, in the file's units. */
  readonly height: number;
  readonly widthFactor: number;
  readonly tracking: number;
  readonly slantDeg: number;
  /** 0xrrggbb; null for the entity's own. */
  readonly color: number | null;
  /** Font name; "" for the font of the text's style. */
  readonly font: string;
  /** 0 on the baseline, 1 centred, 2 hanging from the top of its line. */
  readonly valign: number;
}

/** A piece of text in one format; or two stacked parts with a bar, a slash, or nothing between them. */
export interface MtextRun {
  readonly format: MtextFormat;
  readonly text: string;
  readonly stacked: {
    readonly over: string;
    readonly under: string;
    readonly between: "/" | "#" | "^";
  } | null;
}

export interface MtextParagraph {
  readonly runs: readonly MtextRun[];
  /** Alignment of its lines in the text's width; null: that of the text's attachment. */
  readonly align: "left" | "center" | "right" | null;
  /** Indents of its first line, of all lines, and from the right; times the text's height. */
  readonly first: number;
  readonly left: number;
  readonly right: number;
}

/** A line break; a stack; a code with a value; a code without; braces; a caret code. */
const CODE =
  /\\(?:([PNX])|S((?:\\.|[^;\\])*);?|([ACcHWQT])([-+.\d]*[xX]?);?|([fFp])([^;\\{}]*);?|M\+[0-9A-Fa-f]{5}|(~)|(?!U\+)([^A-Za-z0-9])|(?!U\+)[A-Za-z0-9])|([{}])|\^(.)/gs;
const ALIGNS = { l: "left", c: "center", r: "right", j: "left", d: "left" } as const;
const DEEPEST = 64;

export function readMtext(text: string, height: number): MtextParagraph[] {
  return new Reader(height).read(text);
}

class Reader {
  private format: MtextFormat;
  private readonly outer: MtextFormat[] = [];
  private layout: Omit<MtextParagraph, "runs"> = { align: null, first: 0, left: 0, right: 0 };
  private runs: MtextRun[] = [];
  private readonly paragraphs: MtextParagraph[] = [];

  constructor(height: number) {
    this.format = {
      height,
      widthFactor: 1,
      tracking: 1,
      slantDeg: 0,
      color: null,
      font: "",
      valign: 0,
    };
  }

  read(text: string): MtextParagraph[] {
    let at = 0;
    for (const match of text.matchAll(CODE)) {
      this.write(text.slice(at, match.index));
      at = match.index + match[0].length;
      this.take(match);
    }
    this.write(text.slice(at));
    this.endParagraph();
    return this.paragraphs;
  }

  private take([
    ,
    end,
    stack,
    sizing,
    size,
    code,
    value,
    blank,
    itself,
    brace,
    control,
  ]: RegExpMatchArray): void {
    if (end !== undefined || control === "J") this.endParagraph();
    else if (stack !== undefined) this.stack(stack);
    else if (sizing !== undefined) this.set(sizing, size);
    else if (code === "p") this.setLayout(value);
    else if (code !== undefined) this.format = { ...this.format, font: value.split("|", 1)[0].trim() };
    else if (blank !== undefined) this.write("\u00a0");
    else if (itself !== undefined) this.write(itself);
    else if (brace === "{" && this.outer.length < DEEPEST) this.outer.push(this.format);
    else if (brace === "}") this.format = this.outer.pop() ?? this.format;
    else if (control === "I") this.write(" ");
    else if (control === " ") this.write("^");
  }

  private set(code: string, value: string): void {
    const number = parseFloat(value);
    const factor = /x\s*$/i.test(value);
    const { format } = this;
    if (!Number.isFinite(number)) return;
    if (code === "A") this.format = { ...format, valign: clamp(number, 0, 2) };
    else if (code === "C") this.format = { ...format, color: indexColor(number) };
    // Here blue is the highest byte.
    else if (code === "c")
      this.format = { ...format, color: ((number & 255) << 16) | (number & 0xff00) | ((number >> 16) & 255) };
    else if (code === "Q") this.format = { ...format, slantDeg: clamp(number, -85, 85) };
    else if (!(number > 0)) return;
    else if (code === "H") this.format = { ...format, height: factor ? format.height * number : number };
    else if (code === "W")
      this.format = { ...format, widthFactor: factor ? format.widthFactor * number : number };
    else this.format = { ...format, tracking: number };
  }

  private setLayout(value: string): void {
    for (const [, name, argument] of value.matchAll(/(q[lcrjd]|[ilr])(\*|[-+.\d]*)/g)) {
      const number = argument === "*" ? 0 : parseFloat(argument);
      if (name.startsWith("q"))
        this.layout = { ...this.layout, align: ALIGNS[name.charAt(1) as keyof typeof ALIGNS] };
      else if (Number.isFinite(number))
        this.layout = { ...this.layout, [name === "i" ? "first" : name === "l" ? "left" : "right"]: number };
    }
  }

  private write(text: string): void {
    const plain = plainText(text);
    if (plain !== "") this.runs.push({ format: this.format, text: plain, stacked: null });
  }

  private stack(value: string): void {
    const [, over = "", between = "", under = ""] = /^((?:\\.|[^\\/#^])*)([/#^]?)(.*)$/s.exec(value) ?? [];
    const part = (text: string): string => plainText(text).replace(/\\(.)/g, "$1").trim();
    if (between === "") this.write(part(over));
    else {
      const stacked = { over: part(over), under: part(under), between: between as "/" | "#" | "^" };
      this.runs.push({ format: this.format, text: "", stacked });
    }
  }

  private endParagraph(): void {
    this.paragraphs.push({ ...this.layout, runs: this.runs });
    this.runs = [];
  }
}

/** By block and by layer mean the entity's own colour; 7 is black on paper. */
const indexColor = (index: number): number | null =>
  index === 0 || index === 256 ? null : index === 7 ? 0 : aciColor(index);

const SIGNS: Readonly<Record<string, string>> = { d: "°", c: "Ø", p: "±", "%": "%", u: "", o: "", k: "" };

/** Resolves %%-codes, and replaces \U+ and four hexadecimal digits by that character. */
export const plainText = (text: string): string =>
  text
    .replace(/%%(?:(\d{3})|([dcpuok%]))/gi, (_, code: string | undefined, sign: string) =>
      code === undefined ? SIGNS[sign.toLowerCase()] : String.fromCharCode(Number(code)),
    )
    .replace(/\\U\+([0-9A-F]{4})/gi, (_, hex: string) => String.fromCharCode(parseInt(hex, 16)));
