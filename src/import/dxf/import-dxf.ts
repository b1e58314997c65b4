/**
 * DXF (text form) to a Drawing, by layer. y is flipped, and the page is the drawing's own extent. What each
 * entity draws is in the table of dxf-entities.ts.
 */
import type { DashPattern, Drawing } from "../../drawing/drawing.js";
import { PlotwrightError } from "../../errors.js";
import {
  IDENTITY,
  applyX,
  applyY,
  compose,
  largestScale,
  meanScale,
  rotation,
  scaling,
  translation,
  type Affine,
} from "../../geometry/affine.js";
import { insideRange, type Box } from "../../geometry/box.js";
import { MM_PER_INCH } from "../../units.js";
import { DrawingBuilder, type Look } from "../drawing-builder.js";
import { getOrAdd } from "../../get-or-add.js";
import type { ImportOptions } from "../import-options.js";
import { fontOf } from "../text/single-stroke-font.js";
import { ShapeBuffer } from "../shape-buffer.js";
import type { TextFont } from "../text/text-font.js";
import { WARNING_WORDS } from "../warning-words.js";
import { inWords, Warnings } from "../warnings.js";
import type { BlockCopy, Content } from "./dxf-content.js";
import type { DxfEntity } from "./dxf-entities.js";
import { readDxfFile, type DxfFile, type DxfLayer, dashesOf } from "./dxf-file.js";
import { keyOf } from "./dxf-groups.js";
import { drawHatch } from "./dxf-hatch.js";
import { drawDxfParagraphs } from "./dxf-paragraphs.js";
import { drawPattern } from "./dxf-pattern.js";
import { drawDxfWriting } from "./dxf-text.js";
import { mix } from "../../geometry/polyline.js";

/** mm */
const US_SURVEY_FOOT = 1_200_000 / 3_937;
/** mm per unit for the values of $INSUNITS that drawings use (AutoCAD DXF reference, HEADER). */
const MM_OF_UNIT: Readonly<Record<number, number>> = {
  1: MM_PER_INCH,
  2: 12 * MM_PER_INCH,
  3: 63_360 * MM_PER_INCH,
  4: 1,
  5: 10,
  6: 1000,
  7: 1e6,
  8: MM_PER_INCH / 1e6,
  9: MM_PER_INCH / 1000,
  10: 36 * MM_PER_INCH,
  11: 1e-7,
  12: 1e-6,
  13: 0.001,
  14: 100,
  15: 10_000,
  16: 100_000,
  21: US_SURVEY_FOOT,
  22: US_SURVEY_FOOT / 12,
  23: 3 * US_SURVEY_FOOT,
  24: 5_280 * US_SURVEY_FOOT,
};
const MAX_BLOCK_DEPTH = 16;
const MAX_ENTITIES = 1_000_000;
/** mm: max error of an arc in a drawing of unknown size; far below any pen width. */
const ARC_TOLERANCE_MM = 2e-5;
/** mm: max error of the ends of hatch lines at a curved border. */
const CHORD_TOLERANCE_MM = 1e-3;
const BY_BLOCK = 0;
const BY_LAYER = 256;
const BLACK_OR_WHITE = 7;
/** Holds the points that dimensions were measured from. Never plotted, whatever its entry says. */
const DIMENSION_POINTS = "defpoints";

/** Throws PlotwrightError("bad-file"). */
export function importDxf(text: string, options: ImportOptions): Drawing {
  if (text.startsWith("AutoCAD Binary DXF")) {
    throw new PlotwrightError(
      "bad-file",
      "This DXF is in the binary form. Save it as text (ASCII) DXF and try again.",
    );
  }
  return new DxfImport(readDxfFile(text), fontOf(options)).run();
}

interface Pending {
  readonly entities: readonly DxfEntity[];
  next: number;
  readonly map: Affine;
  readonly depth: number;
  /** The copy's look; null at the top. Layer 0 and "by block" in a block take those of the copy. */
  readonly inherited: Inherited | null;
}

interface Inherited {
  readonly layer: string;
  readonly color: string;
  readonly linetype: string;
}

/** Where and how the contents of one entity are drawn. */
interface Place {
  readonly entity: DxfEntity;
  readonly map: Affine;
  readonly from: Pending;
  readonly own: Inherited;
  readonly group: number;
}

/** How the drawn shape is painted, and what to report once its place is known. */
interface Paint {
  readonly isLine: boolean;
  readonly isFilled: boolean;
  readonly isDashed?: boolean;
  readonly evenOdd?: boolean;
  readonly report?: (box?: Box) => void;
  /** Parts in their own colours, 0xrrggbb, besides those in the entity's colour. */
  readonly colored?: readonly (readonly [number, ShapeBuffer])[];
}

class DxfImport {
  private readonly warnings = new Warnings();
  private readonly builder = new DrawingBuilder(this.warnings, { isAnywhere: true });
  private readonly shape = new ShapeBuffer();
  private readonly groups = new Map<string, number>();
  private readonly mmPerUnit: number;
  private entityCount = 0;
  /** Lines without an end are drawn last: as far as the drawing reaches. */
  private readonly endless: (Place & { readonly content: Content & { readonly kind: "endless" } })[] = [];

  constructor(
    private readonly dxf: DxfFile,
    /** The font for text; null if text is only reported. */
    private readonly font: TextFont | null,
  ) {
    this.mmPerUnit = this.findUnit();
  }

  run(): Drawing {
    const { entities, faults } = this.dxf;
    for (const fault of faults) this.warnings.add("attribute-fault", undefined, fault);
    const model = entities.filter((entity) => !entity.inPaperSpace);
    if (model.length > 0) this.reportSheets();
    const map = scaling(this.mmPerUnit, -this.mmPerUnit);
    const stack: Pending[] = [
      { entities: model.length > 0 ? model : entities, next: 0, map, depth: 0, inherited: null },
    ];
    while (stack.length > 0) {
      const top = stack[stack.length - 1];
      if (top.next === top.entities.length) stack.pop();
      else this.visit(top.entities[top.next++], top, stack);
    }
    this.drawEndless();
    return inWords(this.builder.finishAround(), WARNING_WORDS);
  }

  /** The sheets that the file lays out in paper space: their frames and titles. */
  private reportSheets(): void {
    const { entities, blocks } = this.dxf;
    const others = [...blocks].filter(([name]) => name.startsWith("*paper_space"));
    const onSheets = [
      ...entities.filter((entity) => entity.inPaperSpace),
      ...others.flatMap(([, block]) => block.entities),
    ];
    // A viewport only shows a part of model space.
    const lost = onSheets.filter(
      ({ type, isVisible, contents }) => isVisible && type !== "VIEWPORT" && contents.length > 0,
    );
    if (lost.length > 0) this.warnings.add("paper-space", undefined, undefined, lost.length);
  }

  private findUnit(): number {
    const known = MM_OF_UNIT[this.dxf.variable("$INSUNITS") ?? 0];
    if (known !== undefined) return known;
    const mm = this.dxf.variable("$MEASUREMENT") === 0 ? MM_PER_INCH : 1;
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
    if (!entity.isVisible) return;
    const isInherited = entity.layer === "0" && from.inherited !== null;
    const layerName = isInherited ? from.inherited.layer : entity.layer;
    const layer = this.dxf.layers.get(keyOf(layerName));
    const isShown =
      layer === undefined
        ? keyOf(layerName) !== DIMENSION_POINTS
        : isPlotted(layer) && !layer.isOff && !layer.isFrozen;
    const own = {
      layer: layerName,
      color: this.colorOf(entity, layer, from),
      linetype: linetypeOf(entity, layer, from),
    };
    const copies = entity.contents.filter((content) => content.kind === "insert");
    const group = isShown || copies.length === 0 ? this.groupOf(layer?.name ?? layerName, !isShown) : -1;
    const map = entity.plane === IDENTITY ? from.map : compose(from.map, entity.plane);
    const place = { entity, map, from, own, group };
    // Only a frozen layer also hides what a block draws on other layers.
    if (layer?.isFrozen !== true) for (const { copy } of copies) this.pushCopy(copy, place, isShown, stack);
    if (!isShown) return;
    for (const fault of entity.odd) {
      const code = entity.isUnreadable ? "object-unreadable" : "attribute-fault";
      this.warnings.add(code, undefined, `${entity.type} on layer ${layerName}: ${fault}`);
    }
    for (const content of entity.contents) this.drawContent(content, place);
  }

  private drawContent(content: Content, place: Place): void {
    const { from, own, map } = place;
    switch (content.kind) {
      case "insert":
        return;
      case "styled":
        for (const one of content.contents(this.dxf.dimensionStyle(content.style)))
          this.drawContent(one, place);
        return;
      case "endless":
        this.endless.push({ ...place, content });
        return;
      case "not drawn":
        if (content.name === "IMAGE") this.warnings.add("image-not-drawn");
        else this.warnings.add("not-supported", undefined, content.name);
        return;
    }
    if (
      content.kind === "text" &&
      content.only !== undefined &&
      (content.only === "in blocks") !== from.depth > 0
    )
      return;
    const { shape } = this;
    shape.clear();
    const paint = this.draw(content, largestScale(map));
    shape.finish();
    if (paint === null) return;
    const before = this.builder.shapeCount;
    this.addShape(shape, own.color, paint, place);
    for (const [color, colored] of paint.colored ?? []) this.addShape(colored, hexColor(color), paint, place);
    const count = this.builder.shapeCount;
    paint.report?.(count > before ? this.builder.boxOfShapes(before, count) : undefined);
  }

  private addShape(drawn: ShapeBuffer, color: string, paint: Paint, place: Place): void {
    if (drawn.isEmpty) return;
    const look: Look = {
      stroke: paint.isLine ? color : null,
      fill: paint.isFilled ? color : null,
      evenOdd: paint.evenOdd === true,
      dash: paint.isDashed === true ? this.dashOf(place) : null,
    };
    const where = (): string => `${place.entity.type} on layer ${place.own.layer}`;
    this.builder.addShape(drawn, place.map, look, place.group, null, where);
  }

  private dashOf({ entity, map, own: { linetype } }: Place): DashPattern | null {
    if (SOLID_LINETYPES.includes(linetype)) return null;
    const known = this.dxf.linetypes.get(linetype);
    if (known === undefined) {
      this.warnings.add("reference-missing", undefined, `linetype ${linetype}`);
      return null;
    }
    if (known.hasLetters) this.warnings.add("effect-ignored", undefined, `letters of linetype ${linetype}`);
    const scale = entity.linetypeScale * (this.dxf.variable("$LTSCALE") ?? 1);
    return dashesOf(known.dashes, scale * meanScale(map));
  }

  /** Draws into `shape`; returns null if the content is not drawn. */
  private draw(content: Drawable, scale: number): Paint | null {
    const tolerance = ARC_TOLERANCE_MM / scale;
    switch (content.kind) {
      case "lines":
        content.outline(this.shape, tolerance);
        return {
          isLine: true,
          isFilled: content.isFilled === true,
          isDashed: content.isNeverDashed !== true,
        };
      case "hatch":
        return this.drawHatch(content, tolerance, CHORD_TOLERANCE_MM / scale);
      default:
        return this.drawText(content);
    }
  }

  /** A pattern is drawn as its lines; a hatch without one is a filled shape. */
  private drawHatch(
    { loops, pattern, isSolid }: Drawable & { readonly kind: "hatch" },
    arcTolerance: number,
    tolerance: number,
  ): Paint {
    const { shape, warnings } = this;
    const rings = new ShapeBuffer();
    drawHatch(loops, rings, arcTolerance);
    if (!isSolid && drawPattern(rings, pattern, shape, tolerance)) return { isLine: true, isFilled: false };
    shape.append(rings, IDENTITY);
    const report = (box?: Box): void => warnings.add("gradient-fill", box);
    return { isLine: false, isFilled: true, evenOdd: true, ...(isSolid ? {} : { report }) };
  }

  private drawText(content: Drawable & { readonly kind: "text" | "paragraphs" }): Paint | null {
    const { font, shape, warnings } = this;
    if (font === null) {
      warnings.add("text-not-drawn");
      return null;
    }
    const missing: string[] = [];
    const colored: (readonly [number, ShapeBuffer])[] = [];
    if (content.kind === "text") missing.push(...drawDxfWriting(content.writing, font, shape));
    else {
      const drawn = drawDxfParagraphs(content.paragraphs, font);
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

  private drawEndless(): void {
    const { builder, endless, shape, warnings } = this;
    if (endless.length === 0) return;
    const box = builder.extent();
    for (const { content, ...place } of endless) {
      const { at, along, isBothWays } = content;
      const { map } = place;
      const [x0, y0] = [applyX(map, at.x, at.y), applyY(map, at.x, at.y)];
      const [x1, y1] = [
        applyX(map, at.x + along.x, at.y + along.y),
        applyY(map, at.x + along.x, at.y + along.y),
      ];
      const range = insideRange(x0, y0, x1, y1, box, isBothWays ? -Infinity : 0, Infinity);
      if (range === null || !(range[0] < range[1] && range.every(Number.isFinite))) {
        warnings.add("not-supported", undefined, `${place.entity.type} outside the drawing`);
        continue;
      }
      shape.clear();
      const [from, to] = range;
      shape.moveTo(mix(x0, x1, from), mix(y0, y1, from));
      shape.lineTo(mix(x0, x1, to), mix(y0, y1, to));
      const paint = { isLine: true, isFilled: false, isDashed: true };
      this.addShape(shape, place.own.color, paint, { ...place, map: IDENTITY });
    }
  }

  private pushCopy(copy: BlockCopy, place: Place, isShown: boolean, stack: Pending[]): void {
    const { name, at, columns, rows } = copy;
    const { map, from, own } = place;
    const block = this.dxf.blocks.get(keyOf(name));
    if (block === undefined) {
      if (!isShown) return;
      if (copy.instead === null) this.warnings.add("reference-missing", undefined, `block ${name}`);
      else this.drawContent(copy.instead, place);
      return;
    }
    if (from.depth >= MAX_BLOCK_DEPTH) {
      this.warnings.add("circular-use", undefined, `block ${name}`);
      return;
    }
    const turn = rotation(copy.angleRad);
    this.count(columns * rows - 1);
    for (let i = 0; i < columns * rows; i++) {
      const dx = (i % columns) * copy.columnSpacing;
      const dy = Math.floor(i / columns) * copy.rowSpacing;
      const placed = compose(compose(map, translation(at.x, at.y)), compose(turn, translation(dx, dy)));
      const scaled = compose(placed, scaling(copy.xScale, copy.yScale));
      stack.push({
        entities: block.entities,
        next: 0,
        map: compose(scaled, translation(-block.base.x, -block.base.y)),
        depth: from.depth + 1,
        inherited: own,
      });
    }
  }

  private groupOf(name: string, hidden: boolean): number {
    return getOrAdd(this.groups, keyOf(name), () => {
      if (hidden) this.warnings.add("hidden-layer", undefined, name);
      return this.builder.addGroup(name, name === "0" ? "Layer 0" : name, hidden);
    });
  }

  private colorOf(entity: DxfEntity, layer: DxfLayer | undefined, from: Pending): string {
    if (entity.colorIndex === BY_BLOCK && from.inherited !== null) return from.inherited.color;
    const hasOwn = entity.color !== undefined && entity.colorIndex !== BY_LAYER;
    const index = hasOwn ? entity.colorIndex : layer?.colorIndex;
    // Index 7 is black or white, whichever contrasts with the background.
    if (index === BLACK_OR_WHITE || index === -BLACK_OR_WHITE) return "#000000";
    return hexColor((hasOwn ? entity.color : layer?.color) ?? 0);
  }
}

type Drawable = Content & { readonly kind: "lines" | "hatch" | "text" | "paragraphs" };

const SOLID_LINETYPES = ["continuous", "bylayer", "byblock", ""];

const isPlotted = (layer: DxfLayer): boolean => layer.isPlotted && keyOf(layer.name) !== DIMENSION_POINTS;

function linetypeOf(entity: DxfEntity, layer: DxfLayer | undefined, from: Pending): string {
  if (entity.linetype === "byblock" && from.inherited !== null) return from.inherited.linetype;
  return entity.linetype === "" || entity.linetype === "bylayer" ? (layer?.linetype ?? "") : entity.linetype;
}

const hexColor = (color: number): string => `#${(color & 0xffffff).toString(16).padStart(6, "0")}`;
