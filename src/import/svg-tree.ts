/**
 * XML text to a tree of SVG elements in columns: no object per element, so 25 MB stays affordable.
 *
 * Element i has the attributes [attributeOffsets[i], attributeOffsets[i + 1]); names are numbers into
 * `names`. Elements stand in document order, so a child's index is above its parent's. Text is kept,
 * as elements named "#text", only inside the elements whose text means something. Values are kept as places in
 * the file's text, which is held anyway; only those that read otherwise there (entities, line ends) as strings.
 *
 * Of entities only XML's own five and numeric ones are expanded, so no entity can grow the text.
 */
import { SaxesParser } from "saxes";
import { PlotwrightError } from "../errors.js";
import { ColumnBuffer } from "../geometry/growable.js";

export const TEXT_NODE = "#text";
/** Attributes written `xlink:href` or `href` are both kept under this name. */
export const HREF = "href";
/** The inkscape and sodipodi attributes that mean something, by their local name. */
const KEPT_PREFIXES = new Set(["inkscape", "xml"]);

const SVG_NAMESPACE = "http://www.w3.org/2000/svg";
/** Characters between two yields: under 10 ms of parsing. */
const SLICE_CHARS = 1 << 18;
const TEXT_PARENTS = new Set(["style", "text", "tspan", "textPath", "tref", "a"]);
const SKIPPED = new Set(["metadata", "foreignObject", "script", "desc"]);

/** Added to a value's place: it is not in the text but a string of its own, with that number. */
const OWN_STRING = 0x80000000;

/** Faults of the XML that leave no doubt about what was meant; browsers accept them in pages. */
const HARMLESS = ["undefined entity", "unquoted attribute value", "attribute without value", "]]>"];

export interface SvgTree {
  readonly count: number;
  readonly names: readonly string[];
  readonly tags: Uint32Array;
  readonly parents: Int32Array;
  readonly firstChildren: Int32Array;
  readonly nextSiblings: Int32Array;
  readonly attributeOffsets: Uint32Array;
  readonly attributeNames: Uint32Array;
  /** Read by `attributeValue`. */
  readonly values: AttributeValues;
  readonly lines: Uint32Array;
  readonly elementById: ReadonlyMap<string, number>;
  /** What the parser forgave: its words, with line and column. */
  readonly repairs: readonly string[];
  readonly foreignObjects: number;
  readonly hasStylesheetLink: boolean;
}

/** Where in `text` each value stands, up to a quote like the one before it; or `OWN_STRING` + where in `own`. */
interface AttributeValues {
  readonly text: string;
  readonly places: Uint32Array;
  readonly own: readonly string[];
}

/** The value of attribute `index` of all. */
export function attributeValue({ values }: SvgTree, index: number): string {
  const { text, own } = values;
  const place = values.places[index];
  if (place >= OWN_STRING) return own[place - OWN_STRING];
  return text.slice(place, text.indexOf(text[place - 1], place));
}

/** The value of an attribute, or undefined. Linear in the element's own attributes. */
export function attribute(tree: SvgTree, element: number, name: string): string | undefined {
  const end = tree.attributeOffsets[element + 1];
  for (let i = tree.attributeOffsets[element]; i < end; i++) {
    if (tree.names[tree.attributeNames[i]] === name) return attributeValue(tree, i);
  }
  return undefined;
}

export const tagOf = (tree: SvgTree, element: number): string => tree.names[tree.tags[element]];

/** Parses in steps; run the generator to its end for the tree. Throws PlotwrightError("bad-file"). */
export function* parseSvgTree(text: string): Generator<void, SvgTree> {
  const start = skipBlank(text);
  rejectOtherFormats(text, start);
  const builder = new TreeBuilder(text, start);
  for (let at = start; at < text.length; at += SLICE_CHARS) {
    builder.write(text.slice(at, at + SLICE_CHARS));
    yield;
  }
  return builder.finish();
}

function skipBlank(text: string): number {
  let start = 0;
  while (start < text.length && (text.charCodeAt(start) <= 32 || text.charCodeAt(start) === 0xfeff)) start++;
  return start;
}

function countLines(text: string, end: number): number {
  let lines = 0;
  for (let i = 0; i < end; i++) if (text.charCodeAt(i) === 10) lines++;
  return lines;
}

const notAnSvg = (what: string): PlotwrightError =>
  new PlotwrightError(
    "bad-file",
    `This is not an SVG file: ${what}. Export the drawing as SVG and try again.`,
  );

const OTHER_FORMATS: readonly (readonly [string, string])[] = [
  ["%PDF", "it is a PDF"],
  ["%!PS", "it is PostScript"],
  ["\u0089PNG", "it is a PNG picture"],
  ["\ufffdPNG", "it is a PNG picture"],
  ["GIF8", "it is a GIF picture"],
  ["\u00ff\u00d8", "it is a JPEG picture"],
  ["\ufffd\ufffd\ufffd", "it is binary"],
  ["\u001f\u008b", "it is compressed (svgz); unpack it first"],
  ["\u001f\ufffd", "it is compressed (svgz); unpack it first"],
  ["PK\u0003\u0004", "it is a zip archive"],
];

function rejectOtherFormats(text: string, start: number): void {
  if (start === text.length) throw notAnSvg("it is empty");
  for (const [magic, what] of OTHER_FORMATS) {
    if (text.startsWith(magic, start) || text.startsWith(magic)) throw notAnSvg(what);
  }
  if (text.charCodeAt(start) !== 60) throw notAnSvg("it does not begin with <");
}

class TreeBuilder {
  private readonly parser = new SaxesParser({ xmlns: false, position: true });
  private readonly nameIds = new Map<string, number>();
  private readonly names: string[] = [];
  private readonly tags = new ColumnBuffer(Uint32Array);
  private readonly parents = new ColumnBuffer(Int32Array);
  private readonly firstChildren = new ColumnBuffer(Int32Array);
  private readonly nextSiblings = new ColumnBuffer(Int32Array);
  private readonly attributeOffsets = new ColumnBuffer(Uint32Array);
  private readonly attributeNames = new ColumnBuffer(Uint32Array);
  private readonly valuePlaces = new ColumnBuffer(Uint32Array);
  private readonly ownStrings: string[] = [];
  /** The attributes of the tag that is being read: its names, values, and where in the text these end. */
  private tagCount = 0;
  private readonly tagNames: string[] = [];
  private readonly tagValues: string[] = [];
  private readonly tagValueEnds: number[] = [];
  /** By name as written: the number of the name it is kept under, −1 for none. */
  private readonly keptNames = new Map<string, number>();
  private readonly lines = new ColumnBuffer(Uint32Array);
  private readonly elementById = new Map<string, number>();
  private readonly repairs: string[] = [];
  private readonly lineOffset: number;
  private foreignObjects = 0;
  private hasStylesheetLink = false;
  /** Element now open, and its last child so far; −1 for none. */
  private open = -1;
  private readonly lastChildren: number[] = [];
  /** Depth inside an element whose content is not kept. */
  private skipDepth = 0;
  private depth = 0;
  private keepsText = false;
  private svgPrefix = "";
  private startLine = 0;

  constructor(
    private readonly text: string,
    private readonly start: number,
  ) {
    this.lineOffset = countLines(text, start);
    const parser = this.parser;
    // Seven events at most: with an eighth the parser's properties are too many for V8 to keep them fast.
    parser.on("error", (error) => this.onError(error));
    parser.on("opentagstart", () => {
      this.startLine = parser.line;
      this.tagCount = 0;
    });
    parser.on("attribute", ({ name, value }) => {
      const i = this.tagCount++;
      this.tagNames[i] = name;
      this.tagValues[i] = value;
      this.tagValueEnds[i] = parser.position;
    });
    parser.on("opentag", (tag) => this.onOpen(tag.name));
    parser.on("closetag", () => this.onClose());
    parser.on("text", (text) => this.onText(text));
    parser.on("cdata", (text) => this.onText(text));
  }

  write(slice: string): void {
    this.parser.write(slice);
  }

  finish(): SvgTree {
    this.parser.close();
    if (this.tags.length === 0) throw notAnSvg("it has no <svg> element");
    this.attributeOffsets.push(this.attributeNames.length);
    return {
      count: this.tags.length,
      names: this.names,
      tags: this.tags.data,
      parents: this.parents.data,
      firstChildren: this.firstChildren.data,
      nextSiblings: this.nextSiblings.data,
      attributeOffsets: this.attributeOffsets.data,
      attributeNames: this.attributeNames.data,
      values: {
        text: this.text,
        places: this.valuePlaces.data,
        own: this.ownStrings,
      },
      lines: this.lines.data,
      elementById: this.elementById,
      repairs: this.repairs,
      foreignObjects: this.foreignObjects,
      hasStylesheetLink: this.hasStylesheetLink,
    };
  }

  private onError(error: Error): void {
    const line = this.parser.line + this.lineOffset;
    const column = this.parser.column + 1;
    const what = error.message.replace(/^[^ ]*\d+:\d+: /, "").replace(/\.$/, "");
    const where = `line ${line}, column ${column}`;
    if (HARMLESS.some((known) => what.includes(known))) {
      if (this.repairs.length < 1000) this.repairs.push(`${what} at ${where}`);
      return;
    }
    if (this.tags.length === 0) throw notAnSvg(`${what} at ${where}`);
    const truncated = what.startsWith("unclosed tag") || what.startsWith("unexpected end");
    const advice = truncated
      ? "The file is cut off: save or download it again."
      : "Open it in the program that made it and export it again.";
    throw new PlotwrightError("bad-file", `The SVG is damaged at ${where}: ${what}. ${advice}`, {
      cause: error,
    });
  }

  private onOpen(name: string): void {
    this.depth++;
    if (this.skipDepth > 0) return;
    const isRoot = this.tags.length === 0;
    if (isRoot) this.acceptRoot(name);
    const local = this.localTag(name);
    if (local === null || SKIPPED.has(local)) {
      if (local === "foreignObject") this.foreignObjects++;
      this.skipDepth = this.depth;
      return;
    }
    const element = this.addElement(local);
    for (let i = 0; i < this.tagCount; i++) {
      const kept = this.keptName(this.tagNames[i]);
      if (kept < 0) continue;
      const value = this.tagValues[i];
      this.attributeNames.push(kept);
      this.addValue(value, this.start + this.tagValueEnds[i] - 1 - value.length);
      if (this.names[kept] === "id" && !this.elementById.has(value)) this.elementById.set(value, element);
    }
    this.open = element;
    this.lastChildren.push(-1);
    this.keepsText = TEXT_PARENTS.has(local);
  }

  private acceptRoot(name: string): void {
    const prolog = this.text.slice(this.start, this.start + this.parser.position);
    this.hasStylesheetLink = prolog.includes("<?xml-stylesheet");
    const colon = name.indexOf(":");
    if (name.slice(colon + 1) !== "svg") {
      throw notAnSvg(`its outermost element is <${name.slice(0, 60)}>, not <svg>`);
    }
    if (colon >= 0) this.svgPrefix = name.slice(0, colon);
    else {
      for (let i = 0; i < this.tagCount; i++) {
        const key = this.tagNames[i];
        if (key.startsWith("xmlns:") && this.tagValues[i] === SVG_NAMESPACE) this.svgPrefix = key.slice(6);
      }
    }
  }

  /** The name without SVG's prefix; null for elements of another vocabulary. */
  private localTag(name: string): string | null {
    const colon = name.indexOf(":");
    if (colon < 0) return name;
    return name.slice(0, colon) === this.svgPrefix ? name.slice(colon + 1) : null;
  }

  private addElement(tag: string): number {
    const element = this.tags.length;
    const parent = this.open;
    this.tags.push(this.nameId(tag));
    this.parents.push(parent);
    this.firstChildren.push(-1);
    this.nextSiblings.push(-1);
    this.attributeOffsets.push(this.attributeNames.length);
    this.lines.push(this.startLine + this.lineOffset);
    if (parent >= 0) {
      const last = this.lastChildren[this.lastChildren.length - 1];
      if (last < 0) this.firstChildren.data[parent] = element;
      else this.nextSiblings.data[last] = element;
      this.lastChildren[this.lastChildren.length - 1] = element;
    }
    return element;
  }

  private onClose(): void {
    this.depth--;
    if (this.skipDepth > 0) {
      if (this.depth < this.skipDepth) this.skipDepth = 0;
      return;
    }
    this.open = this.parents.data[this.open];
    this.lastChildren.pop();
    this.keepsText = this.open >= 0 && TEXT_PARENTS.has(this.names[this.tags.data[this.open]]);
  }

  private onText(text: string): void {
    if (!this.keepsText || this.skipDepth > 0 || text === "") return;
    this.addElement(TEXT_NODE);
    this.attributeNames.push(this.nameId(TEXT_NODE));
    this.addValue(text, -1);
  }

  /** By its place in the text if it reads the same there, else as a string. `at` −1: place unknown. */
  private addValue(value: string, at: number): void {
    const isThere = at > 0 && this.isQuoted(value, at);
    this.valuePlaces.push(isThere ? at : OWN_STRING + this.ownStrings.length);
    if (!isThere) this.ownStrings.push(value);
  }

  private isQuoted(value: string, at: number): boolean {
    const { text } = this;
    const quote = text[at - 1];
    return (
      (quote === '"' || quote === "'") && text.startsWith(value, at) && text[at + value.length] === quote
    );
  }

  private keptName(name: string): number {
    let id = this.keptNames.get(name);
    if (id === undefined) {
      const kept = keptAttribute(name);
      id = kept === null ? -1 : this.nameId(kept);
      this.keptNames.set(name, id);
    }
    return id;
  }

  private nameId(name: string): number {
    let id = this.nameIds.get(name);
    if (id === undefined) {
      id = this.names.length;
      // As an object's key the name is the one string of its kind that comparisons know by its address.
      this.names.push(Object.keys({ [name]: id })[0]);
      this.nameIds.set(name, id);
    }
    return id;
  }
}

/** Attributes of other vocabularies are dropped, but for hrefs, labels and xml:space. */
function keptAttribute(name: string): string | null {
  const colon = name.indexOf(":");
  if (colon < 0) return name === "xmlns" ? null : name;
  const local = name.slice(colon + 1);
  if (local === HREF) return HREF;
  return KEPT_PREFIXES.has(name.slice(0, colon)) ? name : null;
}
