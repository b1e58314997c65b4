/** Typed arrays that grow by doubling, for loops that append before the final size is known. */

/** Interleaved x, y pairs. `data` is replaced when it grows: read it again after every push. */
export class PointBuffer {
  data: Float64Array;
  /** Numbers used so far (2 × points). */
  length = 0;

  constructor(capacityPoints = 64) {
    this.data = new Float64Array(Math.max(1, capacityPoints) * 2);
  }

  get pointCount(): number {
    return this.length / 2;
  }

  push(x: number, y: number): void {
    if (this.length + 2 > this.data.length) this.reserve(1);
    this.data[this.length++] = x;
    this.data[this.length++] = y;
  }

  /** Makes room for `points` more, so that an inner loop can write to `data` directly. */
  reserve(points: number): void {
    const needed = this.length + 2 * points;
    if (needed <= this.data.length) return;
    this.data = grown(this.data, needed);
  }

  clear(): void {
    this.length = 0;
  }

  /** A copy of exactly what was pushed. */
  toArray(): Float64Array {
    return this.data.slice(0, this.length);
  }
}

/** A copy with twice the length, or with length `needed` if that is more. */
export function grown<T extends Column>(column: T, needed = 0): T {
  const length = Math.max(2 * column.length, needed);
  const longer = new (column.constructor as new (length: number) => T)(length);
  longer.set(column);
  return longer;
}

type Column = Uint8Array | Uint32Array | Int32Array | Float32Array | Float64Array;

/** Appends one number at a time to a typed array of the given kind. */
export class ColumnBuffer<T extends Column> {
  data: T;
  length = 0;

  constructor(kind: new (length: number) => T, capacity = 64) {
    this.data = new kind(Math.max(1, capacity));
  }

  push(value: number): void {
    if (this.length === this.data.length) this.data = grown(this.data);
    this.data[this.length++] = value;
  }

  toArray(): T {
    return this.data.slice(0, this.length) as T;
  }

  /**
   * The pushed values, without a copy. Do not push afterwards. The unwritten part of `data`
   * takes no physical memory.
   */
  view(): T {
    return this.data.subarray(0, this.length) as T;
  }
}
