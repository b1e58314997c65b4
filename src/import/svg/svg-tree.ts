/**
 * XML text to a tree of SVG elements.
 *
 * The tree is stored in columns, with one number or string per element and attribute, because an object per
 * element would not fit into memory for files of many megabytes. Element i has the attributes
 * [attributeOffsets[i], attributeOffsets[i + 1]); names are indices into `names`. Elements are in document
 * order, so a child's index is greater than its parent's. Text is stored, as elements named "#text", only
 * where it is relevant. Values are stored as positions in the file's text, which is in memory anyway; values
 * that are written differently there (entities, line ends) are stored as separate strings.
 */
import { SaxesParser } from "saxes";
import { PlotwrightError } from "../../errors.js";
import { ColumnBuffer } from "../../geometry/growable.js";
import { getOrAdd } from "../../get-or-add.js";
import { expandEntities, XmlNames } from "./xml.js";

export const TEXT_NODE = "#text";
/** Attributes written `xlink:href` or `href` are both stored under this name. */
export const HREF = "href";

const TEXT_PARENTS = new Set(["style", "text", "tspan", "textPath", "tref", "a"]);
const SKIPPED = new Set(["metadata", "foreignObject", "script", "desc"]);
const MAX_REPAIRS = 1000;
/** Added to an index into `own`: the value is not in the text but a separate string. */
const OWN_STRING = 0x80000000;

/** XML errors whose meaning is clear; browsers accept them in pages. */
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
  /** Errors that the parser recovered from: its messages, with line and column. */
  readonly repairs: readonly string[];
  readonly foreignObjects: number;
  readonly hasStylesheetLink: boolean;
}

/** Where each value begins in `text` (it ends at the quote that precedes it), or `OWN_STRING` + index in `own`. */
interface AttributeValues {
  readonly text: string;
  readonly places: Uint32Array;
  readonly own: readonly string[];
}

/** The value of the attribute with this index in the whole tree. */
export function attributeValue({ values }: SvgTree, index: number): string {
  const { text, own } = values;
  const place = values.places[index];
  if (place >= OWN_STRING) return own[place - OWN_STRING];
  return text.slice(place, text.indexOf(text[place - 1], place));
}

/** The value of an attribute, or undefined. Linear in the element's number of attributes. */
export function attribute(tree: SvgTree, element: number, name: string): string | undefined {
  const end = tree.attributeOffsets[element + 1];
  for (let i = tree.attributeOffsets[element]; i < end; i++) {
    if (tree.names[tree.attributeNames[i]] === name) return attributeValue(tree, i);
  }
  return undefined;
}

/** The children of an element, texts included, in document order. */
export function* childrenOf(tree: SvgTree, element: number): Generator<number> {
  for (let child = tree.firstChildren[element]; child >= 0; child = tree.nextSiblings[child]) yield child;
}

export const tagOf = (tree: SvgTree, element: number): string => tree.names[tree.tags[element]];

/** The characters of a "#text" element. */
export const textOf = (tree: SvgTree, element: number): string =>
  attributeValue(tree, tree.attributeOffsets[element]);

/** Throws PlotwrightError("bad-file"). */
export function parseSvgTree(source: string): SvgTree {
  const visible = source.search(/[^\0-\x20\ufeff]/);
  const start = visible < 0 ? source.length : visible;
  rejectOtherFormats(source, start);
  const text = expandEntities(source);
  return new TreeBuilder(text, start).build();
}

const notAnSvg = (what: string): PlotwrightError =>
  new PlotwrightError(
    "bad-file",
    `This is not an SVG file: ${what}. Export the drawing as SVG and try again.`,
  );

/** Other file formats, by their first characters. */
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

/** @param start where the text begins after blanks */
function rejectOtherFormats(text: string, start: number): void {
  if (start === text.length) throw notAnSvg("it is empty");
  for (const [magic, what] of OTHER_FORMATS) {
    if (text.startsWith(magic, start) || text.startsWith(magic)) throw notAnSvg(what);
  }
  if (text.charCodeAt(start) !== 60) throw notAnSvg("it does not begin with <");
}

interface Written {
  readonly name: string;
  readonly value: string;
  /** Where the value ends in the text. */
  readonly end: number;
}

class TreeBuilder {
  private readonly parser = new SaxesParser({ xmlns: false, position: true });
  private readonly xmlNames = new XmlNames();
  private readonly nameIds = new Map<string, number>();
  private readonly names: string[] = [];
  private readonly tags = new ColumnBuffer(Uint32Array);
  private readonly parents = new ColumnBuffer(Int32Array);
  private readonly firstChildren = new ColumnBuffer(Int32Array);
  private readonly nextSiblings = new ColumnBuffer(Int32Array);
  private readonly attributeOffsets = new ColumnBuffer(Uint32Array);
  private readonly lines = new ColumnBuffer(Uint32Array);
  private readonly attributeNames = new ColumnBuffer(Uint32Array);
  private readonly places = new ColumnBuffer(Uint32Array);
  private readonly ownStrings: string[] = [];
  private readonly elementById = new Map<string, number>();
  private readonly repairs: string[] = [];
  private foreignObjects = 0;
  private hasStylesheetLink = false;
  /** The attributes of the current tag, as written. */
  private written: Written[] = [];
  private startLine = 0;
  /** The open element, −1 for none, and the last child so far of each open element. */
  private open = -1;
  private readonly lastChildren: number[] = [];
  private depth = 0;
  /** Depth of the element whose content is skipped; 0 for none. */
  private skipDepth = 0;
  private keepsText = false;

  /** Lines before the text that is passed to the parser. */
  private readonly lineOffset: number;

  constructor(
    private readonly text: string,
    private readonly start: number,
  ) {
    const { parser } = this;
    this.lineOffset = text.slice(0, start).split("\n").length - 1;
    parser.on("error", (error) => this.onError(error));
    parser.on("processinginstruction", ({ target }) => {
      if (target === "xml-stylesheet") this.hasStylesheetLink = true;
    });
    parser.on("opentagstart", () => {
      this.startLine = parser.line;
      this.written = [];
    });
    parser.on("attribute", ({ name, value }) => {
      this.written.push({ name, value, end: start + parser.position - 1 });
    });
    parser.on("opentag", ({ name }) => this.onOpen(name));
    parser.on("closetag", () => this.onClose());
    parser.on("text", (text) => this.onText(text));
    parser.on("cdata", (text) => this.onText(text));
  }

  build(): SvgTree {
    this.parser.write(this.text.slice(this.start)).close();
    const count = this.tags.length;
    if (count === 0) throw notAnSvg("it has no <svg> element");
    this.attributeOffsets.push(this.places.length);
    return {
      count,
      names: this.names,
      tags: this.tags.view(),
      parents: this.parents.view(),
      firstChildren: this.firstChildren.view(),
      nextSiblings: this.nextSiblings.view(),
      attributeOffsets: this.attributeOffsets.view(),
      attributeNames: this.attributeNames.view(),
      values: { text: this.text, places: this.places.view(), own: this.ownStrings },
      lines: this.lines.view(),
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
      if (this.repairs.length < MAX_REPAIRS) this.repairs.push(`${what} at ${where}`);
      return;
    }
    if (this.tags.length === 0) throw notAnSvg(`${what} at ${where}`);
    const truncated = what.startsWith("unclosed tag") || what.startsWith("unexpected end");
    const advice = truncated
      ? "The file is incomplete: save or download it again."
      : "Open it in the program that made it and export it again.";
    throw new PlotwrightError("bad-file", `The SVG is damaged at ${where}: ${what}. ${advice}`, {
      cause: error,
    });
  }

  private onOpen(name: string): void {
    this.depth++;
    if (this.skipDepth > 0) return;
    const tag = this.xmlNames.enter(name, this.written);
    if (this.tags.length === 0 && tag !== "svg") {
      throw notAnSvg(`its outermost element is <${name.slice(0, 60)}>, not <svg>`);
    }
    if (tag === null || SKIPPED.has(tag)) {
      if (tag === "foreignObject") this.foreignObjects++;
      this.skipDepth = this.depth;
      return;
    }
    const element = this.addElement(tag);
    for (const { name, value, end } of this.written) {
      const kept = this.xmlNames.keptName(name);
      // A plain href overrides one with a prefix (SVG 2, §16.1.5).
      if (kept === null || (kept === HREF && name !== HREF && this.isWritten(HREF))) continue;
      this.addAttribute(kept, value, end - value.length);
      if (kept === "id" && !this.elementById.has(value)) this.elementById.set(value, element);
    }
    this.open = element;
    this.lastChildren.push(-1);
    this.keepsText = TEXT_PARENTS.has(tag);
  }

  private onClose(): void {
    if (this.skipDepth === 0) {
      this.open = this.parents.data[this.open];
      this.lastChildren.pop();
      this.keepsText = this.open >= 0 && TEXT_PARENTS.has(this.names[this.tags.data[this.open]]);
    }
    if (this.skipDepth === 0 || this.skipDepth === this.depth) {
      this.skipDepth = 0;
      this.xmlNames.leave();
    }
    this.depth--;
  }

  private onText(text: string): void {
    if (!this.keepsText || this.skipDepth > 0 || text === "") return;
    this.addElement(TEXT_NODE);
    this.addAttribute(TEXT_NODE, text, 0);
  }

  private addElement(tag: string): number {
    const { lastChildren } = this;
    const element = this.tags.length;
    this.tags.push(this.nameId(tag));
    this.parents.push(this.open);
    this.firstChildren.push(-1);
    this.nextSiblings.push(-1);
    this.attributeOffsets.push(this.places.length);
    this.lines.push(this.startLine + this.lineOffset);
    const before = lastChildren[lastChildren.length - 1] ?? -1;
    if (before >= 0) this.nextSiblings.data[before] = element;
    else if (this.open >= 0) this.firstChildren.data[this.open] = element;
    if (lastChildren.length > 0) lastChildren[lastChildren.length - 1] = element;
    return element;
  }

  private isWritten(name: string): boolean {
    return this.written.some((one) => one.name === name);
  }

  /** @param at where the value may be in the text */
  private addAttribute(name: string, value: string, at: number): void {
    this.attributeNames.push(this.nameId(name));
    if (this.isQuoted(value, at)) this.places.push(at);
    else this.places.push(OWN_STRING + this.ownStrings.push(value) - 1);
  }

  private isQuoted(value: string, at: number): boolean {
    const { text } = this;
    const quote = text[at - 1];
    return (
      (quote === '"' || quote === "'") && text.startsWith(value, at) && text[at + value.length] === quote
    );
  }

  private nameId(name: string): number {
    return getOrAdd(this.nameIds, name, () => this.names.push(name) - 1);
  }
}

/** Settings of AxiDraw's, EggBot's, RoboPaint's and Inkscape's software, which some files have without a prefix. */
const OTHER_PROGRAMS = new Set(["wcb", "plotdata", "eggbot", "mergedata", "namedview"]);

/** Whether an element holds only the settings of another program. Such data is not a part of the drawing. */
export const isOtherProgramsData = (tag: string): boolean => OTHER_PROGRAMS.has(tag.toLowerCase());
