/** The winning values of one element by property, including custom properties (`--x`). */
export type Declared = ReadonlyMap<string, string>;

export function isSameDeclared(a: Declared, b: Declared): boolean {
  if (a.size !== b.size) return false;
  for (const [property, value] of a) if (b.get(property) !== value) return false;
  return true;
}
