/** Only what this project uses: the package includes no types. */
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
  export function converter(mode: "oklab"): (color: string) => OklabColor | undefined;
  export function convertLchToLab(color: LchColor, mode: "oklab"): OklabColor;
  export function convertOklabToRgb(color: OklabColor): RgbColor;
  export function convertRgbToHsv(color: RgbColor): HsvColor;
  export function clampRgb(color: CssColor): CssColor;
  export function formatHex(color: CssColor): string;
  /** Clamps the channels. */
  export function serializeHex(color: RgbColor): string;
}
