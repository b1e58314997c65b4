// Ambient declarations apply only where a program includes them, and this project has several programs.
// eslint-disable-next-line @typescript-eslint/triple-slash-reference
/// <reference path="./color-name.d.ts" />
/** CSS colours to "#rrggbb" and an opacity. */
import colorNames from "color-name";

export interface Color {
  /** "#rrggbb", lower case. */
  readonly hex: string;
  /** 0 … 1 */
  readonly alpha: number;
}

const cache = new Map<string, Color | null>();
const CACHE_LIMIT = 4096;

/** The colour, or null if the text is not one (the caller handles `currentColor` and `none`). */
export function parseColor(text: string): Color | null {
  const known = cache.get(text);
  if (known !== undefined) return known;
  const color = parse(text.trim().toLowerCase());
  if (cache.size >= CACHE_LIMIT) cache.clear();
  cache.set(text, color);
  return color;
}

function parse(text: string): Color | null {
  if (text.startsWith("#")) return parseHex(text.slice(1));
  if (text === "transparent") return { hex: "#000000", alpha: 0 };
  if (Object.hasOwn(colorNames, text)) {
    const [r, g, b] = colorNames[text];
    return fromRgb(r, g, b, 1);
  }
  const call = /^(rgba?|hsla?|hwb)\(([^()]*)\)$/.exec(text);
  return call === null ? null : parseCall(call[1], call[2]);
}

function parseHex(digits: string): Color | null {
  if (!/^[0-9a-f]+$/.test(digits)) return null;
  const long =
    digits.length === 3 || digits.length === 4 ? [...digits].map((digit) => digit + digit).join("") : digits;
  if (long.length !== 6 && long.length !== 8) return null;
  const alpha = long.length === 8 ? parseInt(long.slice(6), 16) / 255 : 1;
  return { hex: `#${long.slice(0, 6)}`, alpha };
}

function parseCall(kind: string, body: string): Color | null {
  const parts = body
    .replace("/", " ")
    .split(/[\s,]+/)
    .filter((part) => part !== "");
  if (parts.length !== 3 && parts.length !== 4) return null;
  const alpha = parts.length === 4 ? clamp01(scaled(parts[3], 1)) : 1;
  if (Number.isNaN(alpha)) return null;
  if (kind.startsWith("rgb")) {
    const [r, g, b] = parts.map((part) => scaled(part, 255));
    return fromRgb(r, g, b, alpha);
  }
  const hue = hueDeg(parts[0]);
  const second = clamp01(percent(parts[1]));
  const third = clamp01(percent(parts[2]));
  const [r, g, b] = kind === "hwb" ? hwb(hue, second, third) : hsl(hue, second, third);
  return fromRgb(r * 255, g * 255, b * 255, alpha);
}

/** A number, or a percentage of `whole`. */
function scaled(text: string, whole: number): number {
  if (text === "none") return 0;
  return text.endsWith("%") ? (Number(text.slice(0, -1)) / 100) * whole : Number(text);
}

const percent = (text: string): number =>
  text === "none" ? 0 : Number(text.endsWith("%") ? text.slice(0, -1) : text) / 100;

function hueDeg(text: string): number {
  const match = /^([+-]?[\d.]+(?:e[+-]?\d+)?)(deg|rad|grad|turn)?$/.exec(text);
  if (match === null) return text === "none" ? 0 : NaN;
  const factor = { deg: 1, rad: 180 / Math.PI, grad: 0.9, turn: 360 }[match[2] ?? "deg"] ?? 1;
  return Number(match[1]) * factor;
}

/** CSS Color 4, §7: each channel is a ramp of the hue. */
function hsl(hue: number, saturation: number, lightness: number): [number, number, number] {
  const channel = (n: number): number => {
    const k = (((n + hue / 30) % 12) + 12) % 12;
    const a = saturation * Math.min(lightness, 1 - lightness);
    return lightness - a * Math.max(-1, Math.min(k - 3, 9 - k, 1));
  };
  return [channel(0), channel(8), channel(4)];
}

function hwb(hue: number, white: number, black: number): [number, number, number] {
  if (white + black >= 1) {
    const gray = white / (white + black);
    return [gray, gray, gray];
  }
  const [r, g, b] = hsl(hue, 1, 0.5);
  const mix = (v: number): number => v * (1 - white - black) + white;
  return [mix(r), mix(g), mix(b)];
}

const clamp01 = (v: number): number => Math.min(1, Math.max(0, v));

function fromRgb(r: number, g: number, b: number, alpha: number): Color | null {
  if (Number.isNaN(r + g + b)) return null;
  const byte = (v: number): string =>
    Math.round(Math.min(255, Math.max(0, v)))
      .toString(16)
      .padStart(2, "0");
  return { hex: `#${byte(r)}${byte(g)}${byte(b)}`, alpha };
}
