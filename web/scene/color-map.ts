/**
 * The colour ramp for speed and order.
 *
 * A straight line through OKLCH (Björn Ottosson's OKLab in polar form): lightness and hue increase evenly, chroma is
 * constant. So equal differences of speed look equally different, the order is visible in grey too, and even the
 * lightest colour is dark enough for a thin line on white paper. All of these colours are in sRGB.
 *
 *   share 0  deep indigo (slow, first)  …  magenta  …  orange (fast, last)  share 1
 */
type Rgb = readonly [r: number, g: number, b: number];

export const RAMP_SIZE = 256;

const DARKEST = 0.25;
const LIGHTEST = 0.725;
const CHROMA = 0.16;
const FIRST_HUE_DEG = 268;
const LAST_HUE_DEG = 425;

/** Converts OKLCH to sRGB 0 … 255, clamped. */
const rgbFromOklch = (lightness: number, chroma: number, hueDeg: number): Rgb => {
  const h = (hueDeg * Math.PI) / 180;
  const a = chroma * Math.cos(h);
  const b = chroma * Math.sin(h);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    byteFromLinear(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    byteFromLinear(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    byteFromLinear(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
};

const byteFromLinear = (linear: number): number => {
  const c = Math.min(1, Math.max(0, linear));
  const encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
  return Math.round(encoded * 255);
};

const rampAt = (share: number): Rgb =>
  rgbFromOklch(
    DARKEST + (LIGHTEST - DARKEST) * share,
    CHROMA,
    FIRST_HUE_DEG + (LAST_HUE_DEG - FIRST_HUE_DEG) * share,
  );

/** RAMP_SIZE × 4 bytes, RGBA. */
export const rampBytes = (): Uint8Array => {
  const bytes = new Uint8Array(RAMP_SIZE * 4);
  for (let i = 0; i < RAMP_SIZE; i++) bytes.set([...rampAt(i / (RAMP_SIZE - 1)), 255], i * 4);
  return bytes;
};

export const hexFromRgb = ([r, g, b]: Rgb): string =>
  `#${((r << 16) | (g << 8) | b).toString(16).padStart(6, "0")}`;

/** "#rrggbb" for a share of the scale, 0 … 1: the nearest of the ramp's RAMP_SIZE colours. */
export const rampColor = (share: number): string => {
  const index = Math.round(Math.min(1, Math.max(0, share)) * (RAMP_SIZE - 1));
  return hexFromRgb(rampAt(index / (RAMP_SIZE - 1)));
};

interface LegendStop {
  readonly mmPerS: number;
  readonly color: string;
}

/** `count` stops from rest to `topMmPerS`, evenly spaced. */
export const legendStops = (topMmPerS: number, count = 17): LegendStop[] =>
  Array.from({ length: count }, (_, i) => {
    const share = i / (count - 1);
    return { mmPerS: Number((share * topMmPerS).toFixed(3)), color: rampColor(share) };
  });

/** Distinguishable colours for layers that have none. */
export const layerColor = (index: number): string =>
  hexFromRgb(rgbFromOklch(0.55, 0.15, (255 + index * 137.508) % 360));
