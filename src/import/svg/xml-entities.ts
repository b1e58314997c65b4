/**
 * Expands entities that a file defines, before the XML is parsed: `<!DOCTYPE svg [<!ENTITY w "10">]>`. If
 * they exceed the limit, they stay unexpanded, and the parser warns about them.
 */

/** Max characters that the entities of a file may add. */
const MAX_CHARS = 1_000_000;
const ENTITY = /<!ENTITY\s+([A-Za-z_][\w.-]*)\s+(?:"([^"]*)"|'([^']*)')\s*>/g;
const REFERENCE = /&([A-Za-z_][\w.-]*);/g;
const PREDEFINED = new Set(["lt", "gt", "amp", "quot", "apos"]);

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
