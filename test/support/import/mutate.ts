/** Damages files, the same way in every run. */

/** mulberry32: small, seeded, the same everywhere. */
export function generator(seed: number): (below: number) => number {
  return (below) => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return Math.floor((((t ^ (t >>> 14)) >>> 0) / 2 ** 32) * below);
  };
}

/** One to six edits; the first eight of `pieces` replace numbers. */
export function mutate(text: string, pieces: readonly string[], below: (n: number) => number): string {
  for (let edits = 1 + below(6); edits > 0; edits--) {
    const at = below(text.length + 1);
    const length = below(3) === 0 ? below(40) : below(4);
    const kind = below(5);
    if (kind === 0) text = text.slice(0, at) + text.slice(at + length);
    else if (kind === 1) text = text.slice(0, at) + pieces[below(pieces.length)] + text.slice(at + below(3));
    else if (kind === 2) text = text.slice(0, at) + text.slice(at, at + length * 5) + text.slice(at);
    else if (kind === 3) text = text.slice(0, at) + String.fromCharCode(below(128)) + text.slice(at + 1);
    else {
      // A number in place of another keeps the file valid, so that the mutation reaches later stages.
      const rest = text.slice(at);
      const piece = pieces[below(8)];
      text = text.slice(0, at) + rest.replace(/-?\d+(\.\d+)?/, piece);
    }
  }
  return text;
}
