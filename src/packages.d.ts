/** Types for packages that include none, or whose own would require Node's types in this folder. Only what is used. */

declare module "culori/css" {}
declare module "culori/fn" {
  interface CssColor {
    readonly mode: string;
    readonly alpha?: number;
  }
  interface OklabColor {
    readonly l: number;
    readonly a: number;
    readonly b: number;
  }
  interface LchColor {
    readonly l: number;
    readonly c: number;
    /** Degrees. */
    readonly h: number;
  }
  /** Channels from 0 to 1. */
  interface RgbColor {
    readonly r: number;
    readonly g: number;
    readonly b: number;
  }
  interface HsvColor {
    /** Degrees; greys have none. */
    readonly h?: number;
    readonly s: number;
    readonly v: number;
  }
  export function parse(text: string): CssColor | undefined;
  export function parseHex(text: string): RgbColor | undefined;
  export function converter(mode: "rgb"): (color: CssColor) => CssColor;
  export function convertLchToLab(color: LchColor, mode: "oklab"): OklabColor;
  export function convertRgbToOklab(color: RgbColor): OklabColor;
  export function convertOklabToRgb(color: OklabColor): RgbColor;
  export function convertRgbToHsv(color: RgbColor): HsvColor;
  export function clampRgb(color: CssColor): CssColor;
  export function formatHex(color: CssColor): string;
  /** Clamps the channels. */
  export function serializeHex(color: RgbColor): string;
}

/** The parser entry of css-tree alone: the whole package adds a lexer and data that an import does not use. */
declare module "css-tree/parser" {
  import type { CssNode, ParseOptions } from "css-tree";
  export default function parse(text: string, options?: ParseOptions): CssNode;
}

declare module "fontkit" {
  interface Path {
    readonly commands: readonly { readonly command: string; readonly args: readonly number[] }[];
  }
  export interface Font {
    readonly unitsPerEm: number;
    readonly familyName: string | null;
    readonly italicAngle: number;
    readonly ascent: number;
    readonly descent: number;
    readonly xHeight: number;
    readonly underlinePosition: number;
    readonly underlineThickness: number;
    readonly availableFeatures: readonly string[];
    readonly "OS/2"?: {
      readonly usWeightClass?: number;
      readonly yStrikeoutPosition?: number;
      readonly ySubscriptYOffset?: number;
      readonly ySuperscriptYOffset?: number;
    };
    layout(
      text: string,
      features?: Readonly<Record<string, boolean>>,
    ): {
      readonly glyphs: readonly {
        readonly id: number;
        readonly path: Path;
        readonly codePoints: readonly number[];
      }[];
      readonly positions: readonly {
        readonly xAdvance: number;
        readonly xOffset: number;
        readonly yOffset: number;
      }[];
    };
  }
  export function create(data: Uint8Array): Font | { readonly fonts: readonly Font[] };
}
