/** What the entities of a DXF draw, in the file's units, y up. */
import type { DxfPoint } from "./dxf-groups.js";
import type { HatchLoop } from "./dxf-hatch.js";
import type { DxfParagraphs } from "./dxf-paragraphs.js";
import type { PatternLine } from "./dxf-pattern.js";
import type { Outline } from "./dxf-shapes.js";
import type { DxfWriting } from "./dxf-text.js";

/** Sizes of what a dimension or leader draws, in the file's units. */
export interface DimensionStyle {
  readonly arrow: number;
  readonly textHeight: number;
  readonly decimals: number;
}

type Styled = (style: DimensionStyle) => readonly Content[];

/** A copy of a block, or several in rows and columns. */
export interface BlockCopy {
  /** As the file writes it. */
  readonly name: string;
  readonly at: DxfPoint;
  readonly xScale: number;
  readonly yScale: number;
  readonly angleRad: number;
  readonly columns: number;
  readonly rows: number;
  readonly columnSpacing: number;
  readonly rowSpacing: number;
  /** Drawn if the file lacks the block; null if that is only reported. */
  readonly instead: Content | null;
}

/** What an entity draws, in the file's units, y up. */
export type Content =
  /** Dots and the edges of filled shapes have no dashes. */
  | {
      readonly kind: "lines";
      readonly outline: Outline;
      readonly isFilled?: boolean;
      readonly isNeverDashed?: boolean;
    }
  /** What depends on a dimension style. */
  | { readonly kind: "styled"; readonly style: string; readonly contents: Styled }
  /** A definition of an attribute shows its name, but in a copy of its block only a text that never changes. */
  | { readonly kind: "text"; readonly writing: DxfWriting; readonly only?: "in blocks" | "outside blocks" }
  | { readonly kind: "paragraphs"; readonly paragraphs: DxfParagraphs }
  | {
      readonly kind: "hatch";
      readonly isSolid: boolean;
      readonly loops: readonly HatchLoop[];
      readonly pattern: readonly PatternLine[];
    }
  | { readonly kind: "insert"; readonly copy: BlockCopy }
  | {
      readonly kind: "endless";
      readonly at: DxfPoint;
      readonly along: DxfPoint;
      readonly isBothWays: boolean;
    }
  /** Reported by this name. */
  | { readonly kind: "not drawn"; readonly name: string };
