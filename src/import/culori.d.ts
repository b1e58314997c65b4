/** Only what color.ts uses: the package includes no types. */
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
  export function parse(text: string): CssColor | undefined;
  export function converter(mode: "rgb"): (color: CssColor) => CssColor;
  export function converter(mode: "oklab"): (color: string) => OklabColor | undefined;
  export function clampRgb(color: CssColor): CssColor;
  export function formatHex(color: CssColor): string;
}
