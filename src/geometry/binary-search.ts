/**
 * The first integer in [from, end) for which `isTrue` returns true; `end` if there is none. It must return true for all
 * integers after the first one.
 */
export function firstWhere(from: number, end: number, isTrue: (i: number) => boolean): number {
  let low = from;
  let high = end;
  while (low < high) {
    const middle = Math.floor((low + high) / 2);
    if (isTrue(middle)) high = middle;
    else low = middle + 1;
  }
  return low;
}
