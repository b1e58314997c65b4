/**
 * The bundled build, with only what import-dxf reads: the package's own types would require Node's types in
 * this folder.
 */
declare module "dxf-parser/dist/dxf-parser.js" {
  export interface DxfPoint {
    readonly x: number;
    readonly y: number;
    readonly bulge?: number;
    readonly splineControlPoint?: boolean;
  }
  export interface DxfGroup {
    readonly code: number;
    readonly value: unknown;
  }
  export interface DxfScanner {
    next(): DxfGroup;
    readonly lastReadGroup: DxfGroup;
    isEOF(): boolean;
  }
  export interface DxfHandler {
    readonly ForEntityName: string;
    /** Leaves the scanner at the group that begins the next entity. */
    parseEntity(scanner: DxfScanner): DxfEntity;
  }
  export interface DxfEntity {
    readonly type: string;
    readonly layer?: string;
    readonly visible?: boolean;
    readonly colorIndex?: number;
    readonly color?: number;
    readonly inPaperSpace?: boolean;
    readonly vertices?: readonly DxfPoint[];
    readonly points?: readonly DxfPoint[];
    readonly shape?: boolean;
    readonly center?: DxfPoint;
    readonly radius?: number;
    readonly startAngle?: number;
    readonly endAngle?: number;
    readonly majorAxisEndPoint?: DxfPoint;
    readonly axisRatio?: number;
    readonly controlPoints?: readonly DxfPoint[];
    readonly fitPoints?: readonly DxfPoint[];
    readonly knotValues?: readonly number[];
    readonly degreeOfSplineCurve?: number;
    readonly closed?: boolean;
    readonly position?: DxfPoint;
    readonly name?: string;
    readonly block?: string;
    readonly xScale?: number;
    readonly yScale?: number;
    readonly rotation?: number;
    readonly columnCount?: number;
    readonly rowCount?: number;
    readonly columnSpacing?: number;
    readonly rowSpacing?: number;
    readonly extrusionDirection?: { readonly z: number };
    readonly extrusionDirectionZ?: number;
    /** Added by plotwright's handlers, for TEXT and ATTRIB, for MTEXT, and for HATCH. */
    readonly writing?: import("./dxf-text.js").DxfWriting;
    readonly paragraphs?: import("./dxf-paragraphs.js").DxfParagraphs;
    readonly isSolid?: boolean;
    readonly loops?: readonly import("./dxf-hatch.js").HatchLoop[];
    readonly pattern?: readonly import("./dxf-pattern.js").PatternLine[];
  }
  export interface DxfLayer {
    readonly name: string;
    readonly visible?: boolean;
    readonly frozen?: boolean;
    readonly colorIndex?: number;
    readonly color?: number;
  }
  export interface Dxf {
    readonly header?: Readonly<Record<string, unknown>>;
    readonly entities?: readonly DxfEntity[];
    readonly blocks?: Readonly<
      Record<string, { readonly position?: DxfPoint; readonly entities?: readonly DxfEntity[] }>
    >;
    readonly tables?: { readonly layer?: { readonly layers?: Readonly<Record<string, DxfLayer>> } };
  }
  export default class DxfParser {
    registerEntityHandler(handler: new () => DxfHandler): void;
    parseSync(text: string): Dxf | null;
  }
}
