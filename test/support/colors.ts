/**
 * Checks whether the colours on the screen belong to a legend. The pixels at a line's edge are mixed with the
 * paper.
 */
export type Rgb = readonly [r: number, g: number, b: number];

/** From 0xrrggbb. */
export const rgbFromNumber = (value: number): Rgb => [(value >> 16) & 255, (value >> 8) & 255, value & 255];
export const rgbFromHex = (hex: string): Rgb => rgbFromNumber(Number.parseInt(hex.slice(1), 16));

export const saturation = ([r, g, b]: Rgb): number => Math.max(r, g, b) - Math.min(r, g, b);

/** Distance (0 … 441) from a colour to the nearest mix of `paper` with one of `inks`. */
export function distanceToMix(color: Rgb, paper: Rgb, inks: readonly Rgb[]): number {
  let nearest = Infinity;
  for (const ink of inks) {
    const along = [ink[0] - paper[0], ink[1] - paper[1], ink[2] - paper[2]] as const;
    const from = [color[0] - paper[0], color[1] - paper[1], color[2] - paper[2]] as const;
    const lengthSquared = along[0] ** 2 + along[1] ** 2 + along[2] ** 2;
    const dot = from[0] * along[0] + from[1] * along[1] + from[2] * along[2];
    const share = lengthSquared === 0 ? 0 : Math.min(1, Math.max(0, dot / lengthSquared));
    nearest = Math.min(
      nearest,
      Math.hypot(from[0] - share * along[0], from[1] - share * along[1], from[2] - share * along[2]),
    );
  }
  return nearest;
}
