/**
 * Decides which elements and attributes of an XML file belong to SVG: by namespaces, if the file declares
 * them.
 */

const SVG = "http://www.w3.org/2000/svg";
/** Prefixes of non-SVG attributes that are used. */
const KEPT_PREFIXES = new Set(["inkscape", "serif", "xml"]);

interface Written {
  readonly name: string;
  readonly value: string;
}

/** Namespace by prefix; "" is the default one. */
type Scope = ReadonlyMap<string, string>;

export class XmlNames {
  /** One per open element. A file that declares no namespace is read as SVG. */
  private readonly scopes: Scope[] = [new Map([["", SVG]])];
  private rootPrefix: string | null = null;

  /**
   * Call at each start tag: returns the element's name without SVG's prefix, or null for another vocabulary.
   */
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

  /**
   * The name under which an attribute is stored; null for other vocabularies. Any prefix of `href` is
   * accepted.
   */
  keptName(name: string): string | null {
    const colon = name.indexOf(":");
    if (colon < 0) return name === "xmlns" ? null : name;
    const local = name.slice(colon + 1);
    if (local === "href") return local;
    return KEPT_PREFIXES.has(name.slice(0, colon)) ? name : null;
  }
}
