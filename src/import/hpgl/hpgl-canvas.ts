/**
 * The pen of an HPGL plotter and what it draws, in plotter units on the paper. A line is added to the drawing when it
 * ends, in the layer of its pen.
 */
import { scaling } from "../../geometry/affine.js";
import { boxesTouch, intersectBoxes, type Box } from "../../geometry/box.js";
import { ClipNode, rectangleClip } from "../clip-node.js";
import { MAX_COORDINATE_MM, type DrawingBuilder, type Look } from "../drawing-builder.js";
import { drawPattern, type PatternLine } from "../dxf/dxf-pattern.js";
import { getOrAdd } from "../../get-or-add.js";
import { curveBox, ShapeBuffer } from "../shape-buffer.js";
import type { Warnings } from "../warnings.js";
import { HpglLineTypes } from "./hpgl-line-types.js";
import { HpglPolygon } from "./hpgl-polygon.js";
import { clamp } from "../../geometry/polyline.js";

const MM_PER_UNIT = 0.025;
const PAGE = scaling(MM_PER_UNIT, -MM_PER_UNIT);
/** One kilometre, as for all shapes. */
const FARTHEST = MAX_COORDINATE_MM / MM_PER_UNIT;
const ANYWHERE: Box = { x0: -FARTHEST, y0: -FARTHEST, x1: FARTHEST, y1: FARTHEST };
const MAX_PENS = 256;
/** The colours of a usual pen carousel. Pens with higher numbers repeat them. */
const PEN_COLORS = ["#000000", "#ff0000", "#008000", "#0000ff", "#ffa500", "#800080", "#00a0a0", "#808080"];
const USUAL_COLOR_RANGE: readonly number[] = [0, 255, 0, 255, 0, 255];
/** Max distance of a curve from its chords where hatch lines end: 1 µm, in plotter units. */
const HATCH_TOLERANCE = 0.04;

export class HpglCanvas {
  x = 0;
  y = 0;
  isDown = false;
  readonly lineTypes = new HpglLineTypes();
  /** Distance between P1 and P2: some lengths are shares of it. */
  diagonal = 0;
  /** Letters and symbols, drawn when the line ends, and never dashed. */
  readonly letters = new ShapeBuffer();
  readonly polygon = new HpglPolygon();
  /** Between PM0 and PM2 nothing is drawn: the sides go to the polygon. */
  isInPolygon = false;
  private readonly shape = new ShapeBuffer();
  private readonly scratch = new ShapeBuffer();
  private readonly groups = new Map<number, number>();
  /** CR: the numbers for black and white, of red, green and blue. */
  private colorRange = USUAL_COLOR_RANGE;
  private readonly penColors = new Map<number, string>();
  private pen = 1;
  /** The pen was lowered here and has not moved: a dot, unless a line begins. */
  private isDot = false;
  private inputWindow: { readonly box: Box; readonly clip: ClipNode } | null = null;
  /** "turned": what follows is on another page of the file. */
  private page: "empty" | "used" | "turned" = "empty";
  private turnedBy = "";

  constructor(
    private readonly builder: DrawingBuilder,
    private readonly warnings: Warnings,
    /** Letters are outlines to be filled. */
    private readonly areLettersFilled: boolean,
  ) {}

  selectPen(pen: number): void {
    this.lift();
    this.pen = clamp(Math.round(pen), 0, MAX_PENS);
  }

  /** PC: a pen, and its red, green and blue. Without these its usual colour; without a pen all usual colours. */
  setPenColor([pen, ...parts]: readonly number[]): void {
    const { penColors } = this;
    this.flush();
    if (pen === undefined) penColors.clear();
    else if (parts.length < 3) penColors.delete(pen);
    else {
      const digits = parts.slice(0, 3).map((part, i) => {
        const [black, white] = this.colorRange.slice(2 * i, 2 * i + 2);
        const share = clamp((part - black) / (white - black) || 0, 0, 1);
        const byte = Math.round(share * 255);
        return byte.toString(16).padStart(2, "0");
      });
      penColors.set(pen, `#${digits.join("")}`);
    }
  }

  setColorRange(range: readonly number[]): void {
    this.colorRange = range.length < 6 ? USUAL_COLOR_RANGE : range;
  }

  lift(): void {
    this.flush();
    this.isDown = false;
  }

  lower(): void {
    if (!this.isInPolygon && this.shape.isEmpty) this.isDot = true;
    this.isDown = true;
  }

  /** For something that is not drawn: then the lowered pen makes no dot. */
  forgetDot(): void {
    this.isDot = false;
  }

  /** Moves the pen; draws a line if it is down. */
  goTo(x: number, y: number): void {
    if (this.isInPolygon && this.polygon.begin(x, y)) this.place(x, y);
    else if (this.isInPolygon || this.isDown) this.draw((shape) => shape.lineTo(x, y));
    else this.place(x, y);
  }

  /** Puts the pen elsewhere without drawing. */
  place(x: number, y: number): void {
    if (!this.isInPolygon) this.flush();
    this.x = x;
    this.y = y;
  }

  /** Before the dashes change. A solid line continues. */
  endDashes(): void {
    if (!this.lineTypes.isSolid) this.flush();
  }

  /** Draws from the pen's position, which moves along. Nothing is drawn with the pen up. */
  draw(add: (shape: ShapeBuffer) => void): void {
    const { shape, scratch, lineTypes } = this;
    let drawn = shape;
    if (this.isInPolygon) {
      drawn = this.polygon.rings;
      this.polygon.add(this.x, this.y, this.isDown, add);
    } else if (this.isDown && !lineTypes.isDotted) {
      this.isDot = false;
      if (shape.isEmpty) shape.moveTo(this.x, this.y);
      add(shape);
    } else {
      drawn = scratch;
      scratch.clear();
      scratch.moveTo(this.x, this.y);
      add(scratch);
      this.isDot = false;
      if (this.isDown) addDot(shape, scratch.x, scratch.y);
    }
    this.x = drawn.x;
    this.y = drawn.y;
  }

  /** Draws a closed shape, whether the pen is up or down, which stays where it is. */
  drawClosed(add: (shape: ShapeBuffer) => void): void {
    if (this.isInPolygon) {
      this.polygon.end();
      add(this.polygon.rings);
      return;
    }
    this.flush();
    add(this.shape);
    this.flush();
  }

  /** Makes `add` the polygon, as rectangles and wedges do. */
  setPolygon(add: (rings: ShapeBuffer) => void): void {
    this.flush();
    this.isInPolygon = false;
    this.polygon.clear();
    add(this.polygon.rings);
  }

  drawEdges(): void {
    this.flush();
    this.add(this.polygon.edges(), this.stroke);
  }

  fillArea(evenOdd: boolean): void {
    this.flush();
    this.add(this.polygon.rings, { stroke: null, fill: this.color, evenOdd });
  }

  /** Fills with parallel lines; returns false if there are too many. */
  hatch(families: readonly PatternLine[]): boolean {
    this.flush();
    const { scratch } = this;
    scratch.clear();
    const isDrawn = drawPattern(this.polygon.rings, families, scratch, HATCH_TOLERANCE);
    if (isDrawn) this.add(scratch, this.stroke);
    return isDrawn;
  }

  /** Draws solid lines, whether the pen is up or down, which stays where it is. */
  drawSolid(add: (shape: ShapeBuffer) => void): void {
    this.flush();
    this.scratch.clear();
    add(this.scratch);
    this.scratch.finish();
    this.add(this.scratch, { stroke: this.color, fill: null });
  }

  /** What is outside the box, in plotter units, is cut off; null for nothing. */
  setWindow(given: Box | null): void {
    if (given !== null || this.inputWindow !== null) this.flush();
    if (given === null) this.inputWindow = null;
    else {
      const box = intersectBoxes(given, ANYWHERE);
      this.inputWindow = { box, clip: rectangleClip(null, PAGE, box) };
    }
  }

  /** What follows is on another page of the file. */
  turnPage(name: string): void {
    this.flush();
    if (this.page === "used") this.page = "turned";
    this.turnedBy = name;
  }

  /** Ends the line. Returns where its letters are, in page mm. */
  flush(): Box | null {
    const { shape, letters } = this;
    if (this.isDot) addDot(shape, this.x, this.y);
    this.isDot = false;
    shape.finish();
    this.add(shape, this.stroke);
    shape.clear();
    letters.finish();
    const look = this.areLettersFilled
      ? { stroke: null, fill: this.color }
      : { stroke: this.color, fill: null };
    const isDrawn = this.add(letters, look);
    letters.clear();
    return isDrawn ? this.builder.boxOfLast() : null;
  }

  private add(shape: ShapeBuffer, look: Look): boolean {
    const { inputWindow, warnings } = this;
    if (shape.isEmpty || this.pen === 0) return false;
    if (inputWindow !== null && !boxesTouch(inputWindow.box, curveBox(shape))) return false;
    const where = (): string => `pen ${this.pen}`;
    const isDrawn = this.builder.addShape(shape, PAGE, look, this.group, inputWindow?.clip ?? null, where);
    if (isDrawn) {
      // Most files end with PG, which loses nothing. Only a page with something on it is reported.
      if (this.page === "turned")
        warnings.add("effect-ignored", undefined, `${this.turnedBy}: drawn on top of the page before`);
      this.page = "used";
    }
    return isDrawn;
  }

  private get stroke(): Look {
    return { stroke: this.color, fill: null, dash: this.lineTypes.dash(this.diagonal * MM_PER_UNIT) };
  }

  private get color(): string {
    return this.penColors.get(this.pen) ?? PEN_COLORS[(this.pen - 1) % PEN_COLORS.length];
  }

  private get group(): number {
    const { pen } = this;
    return getOrAdd(this.groups, pen, () => this.builder.addGroup(`pen-${pen}`, `Pen ${pen}`, false));
  }
}

function addDot(shape: ShapeBuffer, x: number, y: number): void {
  shape.moveTo(x, y);
  shape.lineTo(x, y);
}
