/**
 * A quick way through what large files have most of: elements without content and without anything odd, one after the
 * other. They are read by the engine's own searches, where the XML parser looks at every character.
 *
 *   <path d="M10 45L11 45" stroke-width="0.3"/>\n   <path …
 *   └─head──┘└──value────┘└─────head─────┘└─┘└─┘└─┘
 *                                      value  end gap
 *
 * What stands around the values is compared with that of the leaf before; only where it differs the tag is taken apart.
 * Where leaves follow that differ from one another in the same values only, each of these and what stands between it and
 * the next one is one search for a pattern (`readRun`).
 * Whatever is not plain (entities, line ends in values, other characters than ASCII's, content, faults) is left to the
 * parser, with every judgement about it.
 */
import { grown } from "../../geometry/growable.js";
import { OUTLINE_ATTRIBUTES } from "./outline-attributes.js";

/** How a leaf is written, apart from what its attributes say. */
export interface LeafForm {
  readonly tag: string;
  /** Of its attributes, as written. */
  readonly names: readonly string[];
  /** What stands before each value, quotes included, and last what ends the tag. */
  readonly heads: readonly string[];
  /** Line ends in the tag, and right after its name. */
  readonly lines: number;
  readonly linesAfterName: number;
}

const NOT_PLAIN = /[^\n\t -%'-~]/;
const NAME = /<([A-Za-z][\w.-]*)/y;
const ATTRIBUTE = /[ \n\t]+([A-Za-z_][\w.:-]*)=(["'])/y;
const END = /[ \n\t]*\/>/y;
const BLANKS = /[ \n\t]*/y;
/** What a value may hold that is read as it stands, by the quote around it. */
const PLAIN_VALUE: Readonly<Record<string, string>> = { '"': "[ !#-%'-;=-~]*", "'": "[ -%(-;=-~]*" };
const SPECIAL = /[\\^$.*+?()[\]{}|/]/g;
/** Characters looked through at a time. */
const LOOK_AHEAD = 1 << 16;
/** Longer values are hardly written twice. */
const LONGEST_REPEATED = 64;
/** Runs longer than this are worth the search for them; after others nobody looks for the next so many leaves at most. */
const LONG_RUN = 8;
const LONGEST_WAIT = 500;

export class PlainLeaves {
  /** Of the leaf read last. */
  form: LeafForm | null = null;
  /** Where its values stand; one that the leaf before had too stands where it stood there. */
  readonly places: number[] = [];
  /** Line ends in what was read last; of a run in each leaf. */
  lines = 0;
  /** Which values of the leaf read last were others than those of the leaf before, the first ones of `differing`. */
  private readonly differing: number[] = [];
  private differingCount = 0;
  /** Whether that was of the same form. */
  private isAgain = false;
  /** After `readRun`: which values are others in each leaf, and where these stand, leaf by leaf. */
  changed: readonly number[] = [];
  runPlaces = new Uint32Array(256);
  /** Where the run ends. */
  runEnd = 0;
  /** So many leaves are to be read before a run is looked for, and were the last time. */
  private wait = 0;
  private lastWait = 0;
  /** The values read last, with the quotes after them; "" for what is too long to be kept. */
  private readonly values: string[] = [];
  private gap = "";
  private gapLines = 0;
  /** The text is plain from where it was looked at last to here; here it is not, or nobody has looked. */
  private plainEnd = 0;
  private isOddThere = false;
  /** The next line end and the next tab from where they were looked for last. */
  private lineAt = -1;
  private tabAt = -1;

  constructor(private readonly text: string) {}

  /** Answers where the blanks end that begin at `at`. */
  skipBlanks(at: number): number {
    BLANKS.lastIndex = at;
    BLANKS.test(this.text);
    this.lines = linesIn(this.text.slice(at, BLANKS.lastIndex));
    return BLANKS.lastIndex;
  }

  /** Reads the leaf at `at` and blanks after it. Answers where they end, or −1 where no plain leaf stands there. */
  read(at: number): number {
    const next = this.text.indexOf("<", at + 1);
    if (next < 0 || !this.isPlain(at, next)) return -1;
    let { form } = this;
    let end = form === null ? -1 : this.readAs(form, at, next);
    this.isAgain = end >= 0;
    if (form === null || end < 0) {
      form = formAt(this.text, at);
      if (form === null) return -1;
      this.values.fill("");
      end = this.readAs(form, at, next);
      if (end < 0) return -1;
      this.form = form;
    }
    this.lines = form.lines;
    if (!this.isGap(end, next)) return end;
    this.lines += this.gapLines;
    return next;
  }

  /**
   * Reads as many leaves as follow at `at` that are like the one just read, from `from` to there, in all but the values in
   * which that differs from the one before it, about up to `limit`. Answers how many.
   */
  readRun(from: number, at: number, limit: number): number {
    if (this.wait-- > 0 || !this.mayRun()) return 0;
    const changed = (this.changed = this.differing.slice(0, this.differingCount));
    const { text, places } = this;
    const many = changed.length;
    const head = text.slice(from, places[changed[0]]);
    if (!text.startsWith(head, at)) return 0;
    const patterns = this.runPatterns(at, head);
    let { runPlaces } = this;
    let count = 0;
    let n = 0;
    for (let end = at + head.length; at < limit; count++) {
      if (n + many > runPlaces.length) runPlaces = this.runPlaces = grown(runPlaces);
      let k = 0;
      for (; k < many; k++) {
        const pattern = patterns[k];
        runPlaces[n + k] = end;
        pattern.lastIndex = end;
        if (!pattern.test(text)) break;
        end = pattern.lastIndex;
      }
      if (k < many) break;
      n += many;
      at = end - head.length;
    }
    this.runEnd = at;
    this.wait = this.lastWait = count > LONG_RUN ? 0 : Math.min(2 * this.lastWait + 1, LONGEST_WAIT);
    return count;
  }

  /** Whether others like the leaf read last may differ from it as it does from the one before. */
  private mayRun(): boolean {
    const { differing, differingCount, form } = this;
    if (!this.isAgain || form === null || differingCount === 0) return false;
    for (let k = 0; k < differingCount; k++) {
      if (!OUTLINE_ATTRIBUTES.has(form.names[differing[k]])) return false;
    }
    return true;
  }

  /** Each value of `changed` and what stands behind it up to the next of them, in the leaf that ends at `at`. */
  private runPatterns(at: number, head: string): RegExp[] {
    const { text, changed, places } = this;
    return changed.map((value, k) => {
      const quote = text[places[value] - 1];
      const end = text.indexOf(quote, places[value]);
      const rest =
        k + 1 < changed.length ? text.slice(end, places[changed[k + 1]]) : text.slice(end, at) + head;
      return new RegExp(PLAIN_VALUE[quote] + rest.replace(SPECIAL, "\\$&"), "y");
    });
  }

  private isPlain(from: number, to: number): boolean {
    if (to > this.plainEnd && !(this.isOddThere && from <= this.plainEnd)) {
      const part = this.text.slice(from, Math.max(to, from + LOOK_AHEAD));
      const odd = part.search(NOT_PLAIN);
      this.isOddThere = odd >= 0;
      this.plainEnd = from + (odd < 0 ? part.length : odd);
    }
    return to <= this.plainEnd;
  }

  /** Where the tag ends; −1 where it is of another form or goes on beyond `next`. */
  private readAs({ heads }: LeafForm, at: number, next: number): number {
    const { text, places, values, differing } = this;
    const count = heads.length - 1;
    this.differingCount = 0;
    for (let i = 0; i < count; i++) {
      const head = heads[i];
      if (!text.startsWith(head, at)) return -1;
      at += head.length;
      const value = values[i];
      if (value !== undefined && value !== "" && text.startsWith(value, at)) {
        at += value.length - 1;
        continue;
      }
      const end = text.indexOf(head[head.length - 1], at);
      if (end < 0 || end > next || this.hasBreak(at, end)) return -1;
      places[i] = at;
      differing[this.differingCount++] = i;
      values[i] = end - at < LONGEST_REPEATED ? text.slice(at, end + 1) : "";
      at = end;
    }
    const tail = heads[count];
    const end = at + tail.length;
    return end <= next && text.startsWith(tail, at) ? end : -1;
  }

  /** Whether the value from `at` to `end` has blanks that XML reads as other blanks. */
  private hasBreak(at: number, end: number): boolean {
    if (this.lineAt < at) this.lineAt = placeOf("\n", this.text, at);
    if (this.tabAt < at) this.tabAt = placeOf("\t", this.text, at);
    return this.lineAt < end || this.tabAt < end;
  }

  /** Whether only blanks stand between `end` and `next`. */
  private isGap(end: number, next: number): boolean {
    const { gap } = this;
    if (next - end === gap.length && this.text.startsWith(gap, end)) return true;
    BLANKS.lastIndex = end;
    BLANKS.test(this.text);
    if (BLANKS.lastIndex !== next) return false;
    this.gap = this.text.slice(end, next);
    this.gapLines = linesIn(this.gap);
    return true;
  }
}

/** Of the tag at `at`; null where that is none without content, or one that the parser should judge. */
function formAt(text: string, at: number): LeafForm | null {
  NAME.lastIndex = at;
  const tag = NAME.exec(text)?.[1];
  if (tag === undefined) return null;
  const names: string[] = [];
  const heads: string[] = [];
  const nameEnd = NAME.lastIndex;
  let end = at;
  for (ATTRIBUTE.lastIndex = nameEnd; ;) {
    const before = ATTRIBUTE.lastIndex;
    const match = ATTRIBUTE.exec(text);
    if (match === null) {
      END.lastIndex = before;
      if (!END.test(text)) return null;
      heads.push(text.slice(end, END.lastIndex));
      break;
    }
    const [, name, quote] = match;
    if (names.includes(name)) return null;
    names.push(name);
    heads.push(text.slice(end, ATTRIBUTE.lastIndex));
    end = text.indexOf(quote, ATTRIBUTE.lastIndex);
    if (end < 0) return null;
    ATTRIBUTE.lastIndex = end + 1;
  }
  return {
    tag,
    names,
    heads,
    lines: linesIn(heads.join("")),
    linesAfterName: text[nameEnd] === "\n" ? 1 : 0,
  };
}

function placeOf(char: string, text: string, from: number): number {
  const at = text.indexOf(char, from);
  return at < 0 ? text.length : at;
}

function linesIn(text: string): number {
  let lines = 0;
  for (let at = text.indexOf("\n"); at >= 0; at = text.indexOf("\n", at + 1)) lines++;
  return lines;
}
