/** XML before it is SVG: entities, and the names of elements and attributes. */

/** Max characters that the entities of a file may add. */
const MAX_CHARS = 1_000_000;
const ENTITY = /<!ENTITY\s+([A-Za-z_][\w.-]*)\s+(?:"([^"]*)"|'([^']*)')\s*>/g;
const REFERENCE = /&([A-Za-z_][\w.-]*);/g;
const PREDEFINED = new Set(["lt", "gt", "amp", "quot", "apos"]);

/**
 * Expands entities that a file defines, before the XML is parsed: `<!DOCTYPE svg [<!ENTITY w "10">]>`. If
 * they exceed the limit, they stay unexpanded, and the parser warns about them.
 */
export function expandEntities(text: string): string {
  const from = text.indexOf("<!DOCTYPE");
  if (from < 0 || /<[A-Za-z]/.test(text.slice(0, from))) return text;
  const end = /\]\s*>/g;
  end.lastIndex = from;
  if (!end.test(text)) return text;
  const bodyAt = end.lastIndex;
  const entities = entitiesIn(text.slice(from, bodyAt));
  if (entities.size === 0) return text;
  const body = new Expansion(entities).of(text.slice(bodyAt));
  return body === null ? text : text.slice(0, bodyAt) + body;
}

function entitiesIn(doctype: string): Map<string, string> {
  const entities = new Map<string, string>();
  for (const [, name, double, single] of doctype.matchAll(ENTITY)) {
    // The first declaration of a name applies.
    if (!PREDEFINED.has(name) && !entities.has(name)) entities.set(name, double ?? single);
  }
  return entities;
}

class Expansion {
  /** Expanded entities; "" while one is being expanded, which ends cycles. */
  private readonly known = new Map<string, string>();

  constructor(private readonly entities: ReadonlyMap<string, string>) {}

  /** The text with its references expanded; null if it becomes too long. */
  of(text: string): string | null {
    let added = 0;
    const result = text.replace(REFERENCE, (reference: string, name: string): string => {
      if (added > MAX_CHARS || !this.entities.has(name)) return reference;
      const value = this.valueOf(name);
      added += value?.length ?? Infinity;
      return value ?? reference;
    });
    return added > MAX_CHARS ? null : result;
  }

  private valueOf(name: string): string | null {
    const known = this.known.get(name);
    if (known !== undefined) return known;
    this.known.set(name, "");
    const value = this.of(this.entities.get(name) ?? "");
    if (value !== null) this.known.set(name, value);
    return value;
  }
}

const SVG = "http://www.w3.org/2000/svg";
/** Prefixes of non-SVG attributes that are used. */
const KEPT_PREFIXES = new Set(["inkscape", "serif", "xml"]);

interface Written {
  readonly name: string;
  readonly value: string;
}

/** Namespace by prefix; "" is the default one. */
type Scope = ReadonlyMap<string, string>;

/** Decides which elements and attributes belong to SVG: by namespaces, if the file declares them. */
export class XmlNames {
  /** One per open element. A file that declares no namespace is read as SVG. */
  private readonly scopes: Scope[] = [new Map([["", SVG]])];
  private rootPrefix: string | null = null;

  /** Call at each start tag: returns the element's name without SVG's prefix, or null for another vocabulary. */
  enter(name: string, attributes: readonly Written[]): string | null {
    let scope = this.scopes[this.scopes.length - 1];
    for (const { name: key, value } of attributes) {
      if (key === "xmlns" || key.startsWith("xmlns:")) scope = new Map([...scope, [key.slice(6), value]]);
    }
    this.scopes.push(scope);
    const colon = name.indexOf(":");
    const prefix = colon < 0 ? "" : name.slice(0, colon);
    this.rootPrefix ??= prefix;
    const space = scope.get(prefix);
    // Files with an unusual or missing declaration are read by the prefix of their root element.
    const isSvg = space === SVG || (prefix === this.rootPrefix && space === this.scopes[1].get(prefix));
    return isSvg ? name.slice(colon + 1) : null;
  }

  /** Call at the end tag of each element that was entered. */
  leave(): void {
    this.scopes.pop();
  }

  /** The name under which an attribute is stored; null for other vocabularies. Any prefix of `href` is accepted. */
  keptName(name: string): string | null {
    const colon = name.indexOf(":");
    if (colon < 0) return name === "xmlns" ? null : name;
    const local = name.slice(colon + 1);
    if (local === "href") return local;
    return KEPT_PREFIXES.has(name.slice(0, colon)) ? name : null;
  }
}
