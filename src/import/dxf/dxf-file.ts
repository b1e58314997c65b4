/** A DXF file by its sections: variables, layers, linetypes, dimension styles, blocks, entities. */
import { aciColor } from "./aci-color.js";
import type { DimensionStyle } from "./dxf-content.js";
import { readEntity, type DxfEntity } from "./dxf-entities.js";
import {
  damaged,
  hasFlag,
  keyOf,
  nameIn,
  numberIn,
  numbersIn,
  OddValue,
  pointIn,
  readRecords,
  type DxfGroup,
  type DxfPoint,
  type DxfRecord,
} from "./dxf-groups.js";
import type { DashPattern } from "../../drawing/drawing.js";

export interface DxfLayer {
  readonly name: string;
  readonly isFrozen: boolean;
  readonly isOff: boolean;
  /** False for construction lines, which are shown on screen only. */
  readonly isPlotted: boolean;
  readonly colorIndex: number;
  /** 0xrrggbb */
  readonly color: number;
  /** Key of its linetype. */
  readonly linetype: string;
}

/** Lengths in the file's units: positive is drawn, negative is a gap, 0 a dot. Empty: a solid line. */
interface DxfLinetype {
  readonly dashes: readonly number[];
  /** Has letters or symbols between its dashes. */
  readonly hasLetters: boolean;
}

interface DxfBlock {
  readonly base: DxfPoint;
  readonly entities: readonly DxfEntity[];
}

/** All names as keys; see `keyOf`. */
export interface DxfFile {
  readonly layers: ReadonlyMap<string, DxfLayer>;
  readonly linetypes: ReadonlyMap<string, DxfLinetype>;
  readonly blocks: ReadonlyMap<string, DxfBlock>;
  readonly entities: readonly DxfEntity[];
  /** A variable of the header; undefined if it has none that is a number. */
  readonly variable: (name: string) => number | undefined;
  readonly dimensionStyle: (name: string) => DimensionStyle;
  /** Entries of tables that cannot be read, for a report. */
  readonly faults: readonly string[];
}

/** Throws PlotwrightError("bad-file"). */
export const readDxfFile = (text: string): DxfFile => new FileReader().read(text);

class FileReader {
  private readonly layers = new Map<string, DxfLayer>();
  private readonly linetypes = new Map<string, DxfLinetype>();
  private readonly styles = new Map<string, DimensionStyle>();
  private readonly blocks = new Map<string, DxfBlock>();
  private readonly variables = new Map<string, number>();
  private readonly faults: string[] = [];
  private readonly entities: DxfEntity[] = [];
  private hasEntities = false;
  private section = "";
  /** Where the next entity belongs: null between blocks. */
  private into: DxfEntity[] | null = null;
  /** An entity whose vertices or attributes may follow as records of their own. */
  private open: { readonly record: DxfRecord; readonly vertices: (readonly DxfGroup[])[] } | null = null;

  read(text: string): DxfFile {
    for (const record of readRecords(text)) {
      if (record.type !== "VERTEX" || this.open?.record.type !== "POLYLINE") this.endOpen();
      this.take(record);
    }
    this.endOpen();
    if (!this.hasEntities) throw damaged("as a whole", "it has no ENTITIES section");
    const { layers, linetypes, blocks, entities, faults } = this;
    const variable = (name: string): number | undefined => this.variables.get(name);
    const dimensionStyle = (name: string): DimensionStyle =>
      this.styles.get(keyOf(name)) ?? this.usualDimensions();
    return { layers, linetypes, blocks, entities, variable, dimensionStyle, faults };
  }

  private take(record: DxfRecord): void {
    const { type, groups } = record;
    // There is an entity of this name, too. It does not begin with a name.
    if (type === "SECTION" && groups[0]?.code === 2) {
      this.section = nameIn(groups, 2).toUpperCase();
      if (this.section === "HEADER") this.readVariables(groups);
      if (this.section === "ENTITIES") this.hasEntities = true;
      this.into = this.section === "ENTITIES" ? this.entities : null;
    } else if (type === "ENDSEC") this.section = "";
    else if (this.section === "TABLES") this.tryTo(record, () => this.readEntry(record));
    else if (this.section === "BLOCKS" && type === "BLOCK") {
      const entities: DxfEntity[] = [];
      this.into = entities;
      this.tryTo(record, () =>
        this.blocks.set(keyOf(nameIn(groups, 2)), { base: pointIn(groups, 10) ?? { x: 0, y: 0 }, entities }),
      );
    } else if (type === "ENDBLK") this.into = null;
    else if ((this.section === "BLOCKS" || this.section === "ENTITIES") && type !== "SEQEND") {
      if (type === "VERTEX" && this.open !== null) this.open.vertices.push(groups);
      else this.open = { record, vertices: [] };
    }
  }

  private endOpen(): void {
    if (this.open !== null) this.into?.push(readEntity(this.open.record, this.open.vertices));
    this.open = null;
  }

  private readVariables(groups: readonly DxfGroup[]): void {
    let name = "";
    for (const { code, value } of groups) {
      if (code === 9) name = value.toUpperCase();
      else if (!this.variables.has(name) && value !== "" && Number.isFinite(Number(value)))
        this.variables.set(name, Number(value));
    }
  }

  /** An entry that cannot be read is left out. */
  private tryTo({ type, groups }: DxfRecord, read: () => void): void {
    try {
      read();
    } catch (error) {
      if (!(error instanceof OddValue)) throw error;
      this.faults.push(`${type} ${nameIn(groups, 2)}: ${error.message}`);
    }
  }

  private readEntry({ type, groups }: DxfRecord): void {
    const name = nameIn(groups, 2);
    if (type === "LAYER") {
      const colorIndex = numberIn(groups, 62) ?? 7;
      this.layers.set(keyOf(name), {
        name,
        isFrozen: hasFlag(groups, 70, 1),
        isOff: colorIndex < 0,
        // AutoCAD itself writes 290 only for layers that are not plotted. It is 0 or 1, but not in all files.
        isPlotted: !groups.some(({ code, value }) => code === 290 && Number(value) === 0),
        colorIndex: Math.abs(colorIndex),
        color: numberIn(groups, 420) ?? aciColor(Math.abs(colorIndex)),
        linetype: keyOf(nameIn(groups, 6)),
      });
    } else if (type === "LTYPE") {
      const hasLetters = groups.some(({ code, value }) => code === 74 && Number(value) !== 0);
      this.linetypes.set(keyOf(name), { dashes: numbersIn(groups, 49), hasLetters });
    } else if (type === "DIMSTYLE") {
      const usual = this.usualDimensions();
      const scale = numberIn(groups, 40) || 1;
      this.styles.set(keyOf(name), {
        arrow: (numberIn(groups, 41) ?? usual.arrow) * scale,
        textHeight: (numberIn(groups, 140) ?? usual.textHeight) * scale,
        decimals: numberIn(groups, 271) ?? usual.decimals,
      });
    }
  }

  private usualDimensions(): DimensionStyle {
    const of = (name: string, usual: number): number => this.variables.get(name) ?? usual;
    const scale = of("$DIMSCALE", 1) || 1;
    return {
      arrow: of("$DIMASZ", 0.18) * scale,
      textHeight: of("$DIMTXT", 0.18) * scale,
      decimals: of("$DIMDEC", 4),
    };
  }
}

/**
 * The dashes of a linetype: positive lengths are drawn, negative ones are gaps, 0 is a dot. Null for a solid
 * line. The result begins with a dash, wherever the linetype begins.
 */
export function dashesOf(elements: readonly number[], scale: number): DashPattern | null {
  const isDash = (i: number): boolean => elements[(i + elements.length) % elements.length] >= 0;
  const first = elements.findIndex((_, i) => isDash(i) && !isDash(i - 1));
  if (first < 0 || !(scale > 0)) return null;
  const lengths: number[] = [];
  let offset = 0;
  for (let k = 0; k < elements.length; k++) {
    const i = (first + k) % elements.length;
    const length = Math.abs(elements[i]) * scale;
    if (i >= first) offset += length;
    if (k > 0 && isDash(i) === isDash(i - 1)) lengths[lengths.length - 1] += length;
    else lengths.push(length);
  }
  const total = lengths.reduce((sum, length) => sum + length, 0);
  if (!(total > 0 && Number.isFinite(total))) return null;
  return { lengths, offset: first === 0 ? 0 : offset };
}
