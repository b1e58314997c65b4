/**
 * The winning values of one element by property, including custom properties (`--x`).
 *
 * A list, since there are few entries. One object is reused for every element, perhaps a million times. A Map
 * would leave a chain of cleared tables, which the garbage collector promotes to the old generation and keeps.
 */
export class Declared {
  private count = 0;
  private readonly names: string[] = [];
  private readonly values: string[] = [];

  get size(): number {
    return this.count;
  }

  clear(): void {
    this.count = 0;
  }

  get(property: string): string | undefined {
    for (let i = 0; i < this.count; i++) if (this.names[i] === property) return this.values[i];
    return undefined;
  }

  set(property: string, value: string): void {
    let i = 0;
    while (i < this.count && this.names[i] !== property) i++;
    if (i === this.count) this.names[this.count++] = property;
    this.values[i] = value;
  }

  /** The properties, 0 … size − 1. */
  nameAt(index: number): string {
    return this.names[index];
  }

  valueAt(index: number): string {
    return this.values[index];
  }

  equals(other: Declared): boolean {
    if (this.count !== other.count) return false;
    for (let i = 0; i < this.count; i++) {
      if (this.names[i] !== other.names[i] || this.values[i] !== other.values[i]) return false;
    }
    return true;
  }

  copyFrom(other: Declared): void {
    this.clear();
    for (let i = 0; i < other.count; i++) this.set(other.names[i], other.values[i]);
  }
}
