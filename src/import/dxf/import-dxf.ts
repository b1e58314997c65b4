// Ambient declarations apply only where a program includes them, and this project has several programs.
// eslint-disable-next-line @typescript-eslint/triple-slash-reference
/// <reference path="./dxf-parser.d.ts" />
/**
 * DXF (text form) to a Drawing: lines, arcs, circles, ellipses, polylines with bulges, splines, points,
 * solids, hatches as filled shapes or as pattern lines, texts and blocks, by layer. y is flipped, and the
 * page is the drawing's own extent.
 */
import DxfParser, { type Dxf, type DxfEntity, type DxfLayer } from "dxf-parser/dist/dxf-parser.js";
import type { Drawing } from "../../drawing/drawing.js";
import { PlotwrightError } from "../../errors.js";
import {
  IDENTITY,
  compose,
  largestScale,
  rotation,
  scaling,
  translation,
  type Affine,
} from "../../geometry/affine.js";
import type { Box } from "../../geometry/box.js";
import { MM_PER_INCH } from "../../units.js";
import { DrawingBuilder } from "../drawing-builder.js";
import { DXF_HANDLERS } from "./dxf-handlers.js";
import { drawHatch } from "./dxf-hatch.js";
import { drawPattern } from "./dxf-pattern.js";
import { drawDxfEntity } from "./dxf-shapes.js";
import { drawDxfParagraphs } from "./dxf-paragraphs.js";
import { drawDxfWriting } from "./dxf-text.js";
import { getOrAdd } from "../get-or-add.js";
import { fontOf, type ImportOptions } from "../import-options.js";
import { ShapeBuffer } from "../shape-buffer.js";
import type { TextFont } from "../text/text-font.js";
import { Warnings } from "../warnings.js";

/** mm per unit for the values of $INSUNITS that drawings use (AutoCAD DXF reference, HEADER). */
const MM_OF_UNIT: Readonly<Record<number, number>> = {
  1: MM_PER_INCH,
  2: 12 * MM_PER_INCH,
  4: 1,
  5: 10,
  6: 1000,
  7: 1e6,
  8: MM_PER_INCH / 1e6,
  9: MM_PER_INCH / 1000,
  10: 36 * MM_PER_INCH,
  13: 0.001,
  14: 100,
};
/** Tables in which the parser loops forever if they have no end. */
const ENDLESS_TABLES: readonly string[] = ["LAYER", "VPORT"];
const MAX_BLOCK_DEPTH = 16;
const MAX_ENTITIES = 1_000_000;
/** mm: max error of an arc in a drawing of unknown size; far below any pen width. */
const ARC_TOLERANCE_MM = 2e-5;
/** mm: max error of the ends of hatch lines at a curved border. */
const CHORD_TOLERANCE_MM = 1e-3;
/** Types in world coordinates, for any extrusion (AutoCAD DXF reference, Object Coordinate Systems). */
const WORLD_TYPES: readonly string[] = ["LINE", "POINT", "3DFACE", "ELLIPSE", "SPLINE"];
const BY_BLOCK = 0;
const BLACK_OR_WHITE = 7;

/** Throws PlotwrightError("bad-file"). */
export function importDxf(text: string, options: ImportOptions): Drawing {
  if (text.startsWith("AutoCAD Binary DXF")) {
    throw new PlotwrightError(
      "bad-file",
      "This DXF is in the binary form. Save it as text (ASCII) DXF and try again.",
    );
  }
  checkGroups(text);
  return new DxfImport(parse(text), fontOf(options)).run(text);
}

/**
 * A DXF consists of groups of two lines, the first of them a number. After a lost or added line the parser
 * would confuse codes and values to the end of the file. In the tables of layers and views it loops forever
 * at anything but the next record.
 */
function checkGroups(text: string): void {
  // Split as the parser does, so that it sees exactly the groups checked here.
  const lines = text.split(/\r\n|\r|\n/);
  let previous = "";
  /** Type of the records in the current table. */
  let records: string | null = null;
  for (let at = 0; at < lines.length; at += 2) {
    const code = lines[at].trim();
    const value = (lines[at + 1] ?? "").trim();
    if (!/^-?\d{1,4}$/.test(code)) {
      if (code === "" && isBlankFrom(lines, at)) return;
      throw damagedAt(at, `"${code.slice(0, 20)}" is not a group code`);
    }
    const isStart = Number(code) === 0;
    if (records !== null && isStart) {
      if (value === "ENDTAB") records = null;
      else if (value !== records) throw damagedAt(at, `the table of ${records}s has no end`);
    } else if (previous === "TABLE" && ENDLESS_TABLES.includes(value)) records = value;
    if (isStart && value === "EOF") return;
    previous = isStart ? value : "";
  }
}

function isBlankFrom(lines: readonly string[], from: number): boolean {
  for (let at = from; at < lines.length; at++) if (lines[at].trim() !== "") return false;
  return true;
}

const damagedAt = (line: number, what: string): PlotwrightError =>
  new PlotwrightError(
    "bad-file",
    `The DXF is damaged at line ${line + 1}: ${what}. Save it again, preferably as DXF R12 or 2000.`,
  );

function parse(text: string): Dxf {
  let dxf: Dxf | null = null;
  let cause: unknown;
  try {
    const parser = new DxfParser();
    for (const handler of DXF_HANDLERS) parser.registerEntityHandler(handler);
    dxf = parser.parseSync(text);
  } catch (error) {
    cause = error;
  }
  if (dxf?.entities !== undefined) return dxf;
  const why = cause instanceof Error ? cause.message : "it has no ENTITIES section";
  throw new PlotwrightError(
    "bad-file",
    `The DXF is damaged: ${why.slice(0, 200)}. Save it again, preferably as DXF R12 or 2000.`,
    { cause },
  );
}

interface Pending {
  readonly entities: readonly DxfEntity[];
  next: number;
  readonly map: Affine;
  readonly depth: number;
  /** Entities on layer 0 of a block, and colours "by block", take those of the insert. */
  readonly insert: DxfEntity | null;
}

/** How the drawn shape is painted, and what to report once its place is known. */
interface Paint {
  readonly isLine: boolean;
  readonly isFilled: boolean;
  readonly report?: (box?: Box) => void;
  /** Parts in their own colours, 0xrrggbb, besides those in the entity's colour. */
  readonly colored?: readonly (readonly [number, ShapeBuffer])[];
}

class DxfImport {
  private readonly warnings = new Warnings();
  private readonly builder = new DrawingBuilder(this.warnings);
  private readonly shape = new ShapeBuffer();
  private readonly groups = new Map<string, number>();
  private readonly layers: Readonly<Record<string, DxfLayer>>;
  private readonly mmPerUnit: number;
  private entityCount = 0;

  constructor(
    private readonly dxf: Dxf,
    /** The font for text; null if text is only reported. */
    private readonly font: TextFont | null,
  ) {
    this.layers = dxf.tables?.layer?.layers ?? {};
    this.mmPerUnit = this.findUnit();
  }

  run(text: string): Drawing {
    const entities = this.dxf.entities ?? [];
    const model = entities.filter((entity) => entity.inPaperSpace !== true);
    const map = scaling(this.mmPerUnit, -this.mmPerUnit);
    const stack: Pending[] = [
      { entities: model.length > 0 ? model : entities, next: 0, map, depth: 0, insert: null },
    ];
    while (stack.length > 0) {
      const top = stack[stack.length - 1];
      if (top.next === top.entities.length) stack.pop();
      else this.visit(top.entities[top.next++], top, stack);
    }
    this.reportUnread(text);
    return this.builder.finishAround();
  }

  private findUnit(): number {
    const header = this.dxf.header ?? {};
    const known = MM_OF_UNIT[Number(header["$INSUNITS"] ?? 0)];
    if (known !== undefined) return known;
    const mm = header["$MEASUREMENT"] === 0 ? MM_PER_INCH : 1;
    this.warnings.add("page-size", undefined, `units taken as ${mm === 1 ? "mm" : "inches"}`);
    return mm;
  }

  /** Copies of blocks count too: even many copies of an empty block take memory. */
  private count(added: number): void {
    this.entityCount += added;
    if (this.entityCount <= MAX_ENTITIES) return;
    throw new PlotwrightError(
      "bad-file",
      `The blocks in this DXF expand to more than ${MAX_ENTITIES} objects. Explode and thin them out first.`,
    );
  }

  private visit(entity: DxfEntity, from: Pending, stack: Pending[]): void {
    this.count(1);
    if (entity.visible === false) return;
    const layerName = this.layerOf(entity, from);
    const layer = this.layers[layerName];
    const isHidden = layer?.frozen === true || layer?.visible === false;
    const group = this.groupOf(layerName, isHidden);
    if (isHidden) return;
    const extrusionZ = entity.extrusionDirection?.z ?? entity.extrusionDirectionZ ?? 1;
    const isMirrored = extrusionZ < 0 && !WORLD_TYPES.includes(entity.type);
    const map = isMirrored ? compose(from.map, scaling(-1, 1)) : from.map;
    if (entity.type === "INSERT" || entity.type === "DIMENSION") {
      this.pushInsert(entity, map, from, stack);
      return;
    }
    if (entity.type === "ATTDEF") {
      // In a block it only defines a prompt; the value is an ATTRIB.
      if (from.depth === 0) this.warnings.add("text-not-drawn");
      return;
    }
    const { shape } = this;
    shape.clear();
    const paint = this.draw(entity, largestScale(map));
    shape.finish();
    if (paint === null) return;
    const inks: readonly (readonly [string, ShapeBuffer])[] = [
      [this.colorOf(entity, layer, from), shape],
      ...(paint.colored ?? []).map(([color, colored]) => [hexColor(color), colored] as const),
    ];
    const before = this.builder.shapeCount;
    for (const [color, drawn] of inks) {
      const look = {
        stroke: paint.isLine ? color : null,
        fill: paint.isFilled ? color : null,
        evenOdd: entity.loops !== undefined,
      };
      const where = (): string => `${entity.type} on layer ${layerName}`;
      if (!drawn.isEmpty) this.builder.addShape(drawn, map, look, group, null, where);
    }
    const count = this.builder.shapeCount;
    paint.report?.(count > before ? this.builder.boxOfShapes(before, count) : undefined);
  }

  /** Draws into `shape`; returns null if the entity is not drawn. */
  private draw(entity: DxfEntity, scale: number): Paint | null {
    const { shape, warnings } = this;
    const arcTolerance = ARC_TOLERANCE_MM / scale;
    if (entity.writing !== undefined || entity.paragraphs !== undefined) return this.drawText(entity);
    if (entity.loops !== undefined) return this.drawHatch(entity, arcTolerance, CHORD_TOLERANCE_MM / scale);
    if (drawDxfEntity(entity, shape, arcTolerance))
      return { isLine: true, isFilled: entity.type === "SOLID" };
    warnings.add("not-supported", undefined, entity.type);
    return null;
  }

  /** A pattern is drawn as its lines; a hatch without one is a filled shape. */
  private drawHatch(
    { loops = [], pattern = [], isSolid }: DxfEntity,
    arcTolerance: number,
    tolerance: number,
  ): Paint {
    const { shape, warnings } = this;
    const rings = new ShapeBuffer();
    drawHatch(loops, rings, arcTolerance);
    if (isSolid !== true && drawPattern(rings, pattern, shape, tolerance))
      return { isLine: true, isFilled: false };
    shape.append(rings, IDENTITY);
    const report = (box?: Box): void => warnings.add("gradient-fill", box);
    return { isLine: false, isFilled: true, ...(isSolid === true ? {} : { report }) };
  }

  private drawText({ writing, paragraphs }: DxfEntity): Paint | null {
    const { font, shape, warnings } = this;
    if (font === null) {
      warnings.add("text-not-drawn");
      return null;
    }
    const missing = writing === undefined ? [] : [...drawDxfWriting(writing, font, shape)];
    const colored: (readonly [number, ShapeBuffer])[] = [];
    if (paragraphs !== undefined) {
      const drawn = drawDxfParagraphs(paragraphs, font);
      missing.push(...drawn.missing);
      for (const [color, letters] of drawn.shapes) {
        if (color === null) shape.append(letters, IDENTITY);
        else colored.push([color, letters]);
      }
    }
    const isFilled = font.kind === "outline";
    const report = (box?: Box): void => {
      if (!isFilled && box !== undefined) warnings.add("text-substituted", box);
      for (const char of missing) warnings.add("glyphs-missing", box, `"${char}"`);
    };
    return { isLine: !isFilled, isFilled, report, colored };
  }

  private pushInsert(entity: DxfEntity, map: Affine, from: Pending, stack: Pending[]): void {
    const name = entity.type === "DIMENSION" ? entity.block : entity.name;
    const block = name === undefined ? undefined : this.dxf.blocks?.[name];
    if (block?.entities === undefined) {
      this.warnings.add("reference-missing", undefined, `block ${name ?? ""}`);
      return;
    }
    if (from.depth >= MAX_BLOCK_DEPTH) {
      this.warnings.add("circular-use", undefined, `block ${name ?? ""}`);
      return;
    }
    const isInsert = entity.type === "INSERT";
    const at = (isInsert ? entity.position : undefined) ?? { x: 0, y: 0 };
    const base = block.position ?? { x: 0, y: 0 };
    const turn = rotation(((isInsert ? (entity.rotation ?? 0) : 0) * Math.PI) / 180);
    const columns = isInsert ? copiesOf(entity.columnCount) : 1;
    const rows = isInsert ? copiesOf(entity.rowCount) : 1;
    this.count(columns * rows - 1);
    for (let i = 0; i < columns * rows; i++) {
      const dx = (i % columns) * (entity.columnSpacing ?? 0);
      const dy = Math.floor(i / columns) * (entity.rowSpacing ?? 0);
      const placed = compose(compose(map, translation(at.x, at.y)), compose(turn, translation(dx, dy)));
      const scaled = compose(placed, scaling(entity.xScale ?? 1, entity.yScale ?? 1));
      stack.push({
        entities: block.entities,
        next: 0,
        map: compose(scaled, translation(-base.x, -base.y)),
        depth: from.depth + 1,
        insert: entity,
      });
    }
  }

  private layerOf(entity: DxfEntity, from: Pending): string {
    const own = entity.layer ?? "0";
    return own === "0" && from.insert !== null ? (from.insert.layer ?? "0") : own;
  }

  private groupOf(name: string, hidden: boolean): number {
    return getOrAdd(this.groups, name, () => {
      if (hidden) this.warnings.add("hidden-layer", undefined, name);
      return this.builder.addGroup(name, name === "0" ? "Layer 0" : name, hidden);
    });
  }

  private colorOf(entity: DxfEntity, layer: DxfLayer | undefined, from: Pending): string {
    const byBlock = entity.colorIndex === BY_BLOCK && from.insert !== null;
    const own = byBlock ? from.insert : entity;
    const hasOwn = own?.color !== undefined && own.colorIndex !== 256;
    const index = hasOwn ? own.colorIndex : layer?.colorIndex;
    const color = (hasOwn ? own.color : layer?.color) ?? 0;
    // Index 7 is black or white, whichever contrasts with the background.
    if (index === BLACK_OR_WHITE || index === -BLACK_OR_WHITE || !Number.isFinite(color)) return "#000000";
    return hexColor(color);
  }

  /** Reports entity types that the parser skips silently. */
  private reportUnread(text: string): void {
    const start = text.search(/^\s*ENTITIES\s*$/m);
    if (start < 0) return;
    for (const [, kind] of text
      .slice(start)
      .matchAll(
        /^[ \t]*0\r?\n[ \t]*(IMAGE|LEADER|MULTILEADER|MLINE|REGION|WIPEOUT|RAY|XLINE|TRACE|BODY|3DSOLID|OLE2FRAME)[ \t]*$/gm,
      )) {
      this.warnings.add("not-supported", undefined, kind);
    }
  }
}

/** NaN counts as 1. */
const copiesOf = (count = 1): number => (count >= 1 ? Math.min(1000, count) : 1);
const hexColor = (color: number): string => `#${(color & 0xffffff).toString(16).padStart(6, "0")}`;
