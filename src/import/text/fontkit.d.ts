/** Only what outline-font.ts uses: the package's own types would require Node's types in this folder. */
declare module "fontkit" {
  interface Path {
    readonly commands: readonly { readonly command: string; readonly args: readonly number[] }[];
  }
  export interface Font {
    readonly unitsPerEm: number;
    layout(text: string): {
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
