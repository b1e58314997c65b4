/**
 * AutoCAD's colour index: ten plain colours; 24 hues at 15° steps, each in five shades, pure (even) and half
 * pale (odd); six greys. As 0xrrggbb.
 */
const PLAIN = [0, 0xff0000, 0xffff00, 0x00ff00, 0x00ffff, 0x0000ff, 0xff00ff, 0xffffff, 0x808080, 0xc0c0c0];
const GREYS = [0x333333, 0x5b5b5b, 0x848484, 0xadadad, 0xd6d6d6, 0xffffff];
const SHADES = [255, 204, 152, 127, 76];
const FIRST_HUE = 10;
const FIRST_GREY = 250;
/** The third shade of the first hues is slightly lighter. */
const LIGHTER_BELOW = 50;

/** Black for an invalid index. */
export function aciColor(index: number): number {
  if (!Number.isInteger(index) || index < 0 || index > 255) return 0;
  if (index < FIRST_HUE) return PLAIN[index];
  if (index >= FIRST_GREY) return GREYS[index - FIRST_GREY];
  const sixth = Math.floor((index - FIRST_HUE) / 10) / 4;
  const shade = Math.floor((index % 10) / 2);
  const value = SHADES[shade] + (shade === 2 && index < LIGHTER_BELOW ? 1 : 0);
  const paleness = index % 2 === 0 ? 1 : 0.5;
  // HSV to RGB: each channel falls off between its sectors of the colour circle.
  const channel = (offset: number): number => {
    const k = (offset + sixth) % 6;
    return Math.floor(value * (1 - paleness * Math.max(0, Math.min(1, k, 4 - k))));
  };
  return (channel(5) << 16) | (channel(3) << 8) | channel(1);
}
