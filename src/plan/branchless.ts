/**
 * Which of two numbers is the greater changes from point to point of a drawing, so that a processor guesses wrong half of the time:
 * without a branch it takes half as long. Where it is the first, it comes out as it is; the second is rounded in the last place of
 * the first.
 */
export function lesser(a: number, b: number): number {
  const over = a - b;
  return a - (over + Math.abs(over)) / 2;
}

export function greater(a: number, b: number): number {
  const over = b - a;
  return a + (over + Math.abs(over)) / 2;
}
