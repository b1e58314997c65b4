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
import { PlotwrightError } from "../../errors.js";
import { notAnSvg, rejectOtherFormats } from "./not-an-svg.js";
import { PlainLeaves, type LeafForm } from "./plain-leaves.js";
import { AttributeColumns, ElementColumns } from "./tree-columns.js";

export const TEXT_NODE = "#text";
/** Attributes written `xlink:href` or `href` are both kept under this name. */
export const HREF = "href";
/** The inkscape and sodipodi attributes that mean something, by their local name. */
const KEPT_PREFIXES = new Set(["inkscape", "xml"]);

const SVG_NAMESPACE = "http://www.w3.org/2000/svg";
/** Characters between two yields: under 10 ms of parsing. */
const SLICE_BITS = 18;
const SLICE_CHARS = 1 << SLICE_BITS;
/** Tags that the parser is given one by one, looking for plain leaves after each. */
const PATIENCE = 8;
const TEXT_PARENTS = new Set(["style", "text", "tspan", "textPath", "tref", "a"]);
const SKIPPED = new Set(["metadata", "foreignObject", "script", "desc"]);

/** Added to a value's place: it is not in the text but a string of its own, with that number. */
export const OWN_STRING = 0x80000000;

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
  return place >= OWN_STRING ? own[place - OWN_STRING] : attributeAt(text, place);
}

/** What stands from `place` on, up to a quote like the one before it. */
const attributeAt = (text: string, place: number): string =>
  text.slice(place, text.indexOf(text[place - 1], place));

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
  for (let at = start; at < text.length;) {
    at = builder.readFrom(at);
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

class TreeBuilder {
  private readonly parser = new SaxesParser({ xmlns: false, position: true });
  private readonly nameIds = new Map<string, number>();
  private readonly names: string[] = [];
  private readonly elements = new ElementColumns();
  private readonly attributes = new AttributeColumns();
  private readonly ownStrings: string[] = [];
  /** The attributes of the tag that is being read: its names, values, and where in the text these end. */
  private tagCount = 0;
  private readonly tagNames: string[] = [];
  private readonly tagValues: string[] = [];
  private readonly tagValueEnds: number[] = [];
  /** By name as written: the number of the name it is kept under, −1 for none. */
  private readonly keptNames = new Map<string, number>();
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
  private readonly leaves: PlainLeaves;
  /** How often no plain leaf stood where one was looked for, since the last one. */
  private misses = 0;
  /** Characters given to the parser, and how many of these it had read at the end of the last tag. */
  private parsed = 0;
  private parsedAtTag = -1;
  /** Characters that stood before and between these, and were not given to it. */
  private passed: number;
  /** The form of the last leaf, and the numbers of its names: −1 for what is not kept. */
  private leafForm: LeafForm | null = null;
  private leafTag = -1;
  private leafNames: readonly number[] = [];

  constructor(
    private readonly text: string,
    start: number,
  ) {
    this.lineOffset = countLines(text, start);
    this.passed = start;
    this.leaves = new PlainLeaves(text);
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
    parser.on("opentag", (tag) => {
      this.parsedAtTag = parser.position;
      this.onOpen(tag.name);
    });
    parser.on("closetag", () => {
      this.parsedAtTag = parser.position;
      this.onClose();
    });
    parser.on("text", (text) => this.onText(text));
    parser.on("cdata", (text) => this.onText(text));
  }

  /** Reads some 10 ms' worth from `at` on; answers where it stopped. */
  readFrom(at: number): number {
    const limit = Math.min(at + SLICE_CHARS, this.text.length);
    while (at < limit) {
      if (this.isBetweenTags()) at = this.readLeaves(at, limit);
      if (at < limit) at = this.readByParser(at);
    }
    return at;
  }

  /** Inside an element whose text means nothing, and right after a tag. */
  private isBetweenTags(): boolean {
    return this.parsedAtTag === this.parsed && this.depth > 0 && this.skipDepth === 0 && !this.keepsText;
  }

  /** As many plain leaves as stand at `at`, without the parser: it goes on after them as if it had read them. */
  private readLeaves(at: number, limit: number): number {
    const { parser, leaves, text } = this;
    let end = leaves.skipBlanks(at);
    let line = parser.line + leaves.lines;
    let count = 0;
    while (end < limit) {
      const next = leaves.read(end);
      if (next < 0) break;
      this.addLeaf(line);
      line += leaves.lines;
      const alike = this.leafTag < 0 ? 0 : leaves.readRun(end, next, limit);
      if (alike > 0) this.addLeavesLike(alike);
      line += alike * leaves.lines;
      end = alike > 0 ? leaves.runEnd : next;
      count++;
    }
    if (count === 0) {
      this.misses++;
      return at;
    }
    this.misses = 0;
    this.passed += end - at;
    parser.column = line > parser.line ? end - 1 - text.lastIndexOf("\n", end - 1) : parser.column + end - at;
    parser.line = line;
    return end;
  }

  /** Tag by tag where leaves may follow; more at a time where there have been none for long. */
  private readByParser(at: number): number {
    const least = this.misses < PATIENCE ? 1 : 1 << Math.min(this.misses, SLICE_BITS);
    const slice = this.text.slice(at, at + SLICE_CHARS);
    const close = slice.indexOf(">", least - 1);
    const part = close < 0 ? slice : slice.slice(0, close + 1);
    this.parser.write(part);
    this.parsed += part.length;
    return at + part.length;
  }

  finish(): SvgTree {
    this.parser.close();
    const { elements, attributes } = this;
    if (elements.count === 0) throw notAnSvg("it has no <svg> element");
    elements.attributeOffsets[elements.count] = attributes.count;
    return {
      count: elements.count,
      names: this.names,
      tags: elements.tags,
      parents: elements.parents,
      firstChildren: elements.firstChildren,
      nextSiblings: elements.nextSiblings,
      attributeOffsets: elements.attributeOffsets,
      attributeNames: attributes.names,
      values: { text: this.text, places: attributes.places, own: this.ownStrings },
      lines: elements.lines,
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
    if (this.elements.count === 0) throw notAnSvg(`${what} at ${where}`);
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
    if (this.elements.count === 0) this.acceptRoot(name);
    const local = this.localTag(name);
    if (local === null || SKIPPED.has(local)) {
      if (local === "foreignObject") this.foreignObjects++;
      this.skipDepth = this.depth;
      return;
    }
    const element = this.addElement(this.nameId(local));
    for (let i = 0; i < this.tagCount; i++) {
      const kept = this.keptName(this.tagNames[i]);
      if (kept < 0) continue;
      const value = this.tagValues[i];
      this.attributes.add(kept, this.placeOf(value, this.passed + this.tagValueEnds[i] - 1 - value.length));
      if (this.names[kept] === "id") this.addId(value, element);
    }
    this.open = element;
    this.lastChildren.push(-1);
    this.keepsText = TEXT_PARENTS.has(local);
  }

  /** The leaf that `leaves` has read, whose tag begins in `line`. */
  private addLeaf(line: number): void {
    const { attributes } = this;
    const { places } = this.leaves;
    const form = this.leaves.form as LeafForm;
    if (form !== this.leafForm) this.setLeafForm(form);
    if (this.leafTag < 0) {
      if (form.tag === "foreignObject") this.foreignObjects++;
      return;
    }
    this.startLine = line + form.linesAfterName;
    const element = this.addElement(this.leafTag);
    const names = this.leafNames;
    for (let i = 0; i < names.length; i++) {
      if (names[i] < 0) continue;
      attributes.add(names[i], places[i]);
      if (form.names[i] === "id") this.addId(attributeAt(this.text, places[i]), element);
    }
  }

  /** As many leaves as that, like the last one but for the places of some values: `leaves` has read them. */
  private addLeavesLike(count: number): void {
    const { elements, attributes, leaves, lastChildren, leafNames } = this;
    const last = elements.count - 1;
    const each = attributes.count - elements.attributeOffsets[last];
    // By value: which of the kept ones it is.
    let kept = 0;
    const numbers = leafNames.map((name) => (name < 0 ? -1 : kept++));
    const changed = leaves.changed.map((value) => numbers[value]);
    elements.addLike(last, count, each, attributes.count, leaves.lines);
    attributes.addLike(count, each, changed, leaves.runPlaces);
    lastChildren[lastChildren.length - 1] = elements.count - 1;
    const id = (leaves.form as LeafForm).names.indexOf("id");
    if (id < 0 || !leaves.changed.includes(id)) return;
    for (let element = last + 1; element < elements.count; element++) {
      const at = attributes.places[attributes.count - (elements.count - element) * each + numbers[id]];
      this.addId(attributeAt(this.text, at), element);
    }
  }

  private setLeafForm(form: LeafForm): void {
    this.leafForm = form;
    this.leafTag = SKIPPED.has(form.tag) ? -1 : this.nameId(form.tag);
    this.leafNames = form.names.map((name) => (this.leafTag < 0 ? -1 : this.keptName(name)));
  }

  private addId(id: string, element: number): void {
    if (!this.elementById.has(id)) this.elementById.set(id, element);
  }

  private acceptRoot(name: string): void {
    const prolog = this.text.slice(this.passed, this.passed + this.parser.position);
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

  private addElement(tag: number): number {
    const { lastChildren } = this;
    const last = lastChildren.length - 1;
    const before = last < 0 ? -1 : lastChildren[last];
    const line = this.startLine + this.lineOffset;
    const element = this.elements.add(tag, this.open, before, this.attributes.count, line);
    if (last >= 0) lastChildren[last] = element;
    return element;
  }

  private onClose(): void {
    this.depth--;
    if (this.skipDepth > 0) {
      if (this.depth < this.skipDepth) this.skipDepth = 0;
      return;
    }
    const { elements } = this;
    this.open = elements.parents[this.open];
    this.lastChildren.pop();
    this.keepsText = this.open >= 0 && TEXT_PARENTS.has(this.names[elements.tags[this.open]]);
  }

  private onText(text: string): void {
    if (!this.keepsText || this.skipDepth > 0 || text === "") return;
    const id = this.nameId(TEXT_NODE);
    this.addElement(id);
    this.attributes.add(id, this.placeOf(text, -1));
  }

  /** `at`, if it reads the same there, else the place of a string of its own. `at` −1: place unknown. */
  private placeOf(value: string, at: number): number {
    if (at > 0 && this.isQuoted(value, at)) return at;
    this.ownStrings.push(value);
    return OWN_STRING + this.ownStrings.length - 1;
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
