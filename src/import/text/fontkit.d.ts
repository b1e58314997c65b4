/** Only what outline-font.ts uses: the package's own types would require Node's types in this folder. */
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
