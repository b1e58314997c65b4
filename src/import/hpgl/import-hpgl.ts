/**
 * Reads HPGL and HP-GL/2 as a Drawing with a layer for each pen: PU PD PA PR AA AR CI EA ER RA RR SP PE, scaling by IP
 * and SC, labels by LB. Language reference: HP, "PCL 5 Technical Reference", chapters 18 to 21. A plotter unit is
 * 0.025 mm; y is up.
 */
import type { Drawing } from "../../drawing/drawing.js";
import { PlotwrightError } from "../../errors.js";
import type { Affine } from "../../geometry/affine.js";
import { drawCentreArc } from "../arc.js";
import type { Box } from "../../geometry/box.js";
import { DrawingBuilder } from "../drawing-builder.js";
import { getOrAdd } from "../get-or-add.js";
import { readEncodedPolyline } from "./hpgl-encoded.js";
import { HpglLabels } from "./hpgl-label.js";
import { fontOf, type ImportOptions } from "../import-options.js";
import { ShapeBuffer } from "../shape-buffer.js";
import type { TextFont } from "../text/text-font.js";
import { Warnings } from "../warnings.js";

const MM_PER_PLOTTER_UNIT = 0.025;
const ARC_TOLERANCE_MM = 2e-5;
const MAX_PENS = 256;
/** The colours of a usual pen carousel. Pens with higher numbers repeat them. */
const PEN_COLORS = ["#000000", "#ff0000", "#008000", "#0000ff", "#ffa500", "#800080", "#00a0a0", "#808080"];
const COMMAND = /([A-Za-z]{2})([^A-Za-z\u0003;]*)/y;
const LABEL_END = "\u0003";
const PAGE: Affine = { a: MM_PER_PLOTTER_UNIT, b: 0, c: 0, d: -MM_PER_PLOTTER_UNIT, e: 0, f: 0 };
/** P1 and P2 until IP sets them, in plotter units. */
const USUAL_CORNERS: readonly number[] = [0, 0, 10_000, 10_000];

/** Commands that are ignored: they set what plotwright decides itself, or move nothing. */
const SILENT = new Set(
  "VS FS AS LA PW WU CO OW RO PS NR EC BP AC CV MC SM TR UL AP TD SD SA SS CA CS NP OA OC OE OI OS OF OP OH OD VA".split(
    " ",
  ),
);

/** Throws PlotwrightError("bad-file"). */
export function importHpgl(text: string, options: ImportOptions): Drawing {
  return new HpglImport(text, fontOf(options)).run();
}

class HpglImport {
  private readonly warnings = new Warnings();
  private readonly builder = new DrawingBuilder(this.warnings);
  private readonly shape = new ShapeBuffer();
  private readonly groups = new Map<number, number>();
  private pen = 1;
  private isDown = false;
  private isRelative = false;
  /** Plotter units. */
  private x = 0;
  private y = 0;
  /** User units to plotter units. */
  private scaleX = 1;
  private scaleY = 1;
  private originX = 0;
  private originY = 0;
  private corners = USUAL_CORNERS;
  private labels = new HpglLabels();
  private labelEnd = LABEL_END;
  /** Start of the last label: a new line begins there. */
  private labelStart = { x: 0, y: 0 };
  private at = 0;
  /** "turned" after a PG: what follows is on another page of the file. */
  private page: "empty" | "used" | "turned" = "empty";
  private commandCount = 0;

  constructor(
    private readonly text: string,
    /** The font for labels; null if labels are only reported. */
    private readonly font: TextFont | null,
  ) {}

  run(): Drawing {
    const { text } = this;
    while (this.at < text.length) {
      COMMAND.lastIndex = this.at;
      const match = COMMAND.exec(text);
      if (match === null) {
        this.at++;
        continue;
      }
      this.at = COMMAND.lastIndex;
      this.commandCount++;
      const name = match[1].toUpperCase();
      const start = COMMAND.lastIndex - match[2].length;
      if (name === "PE") this.encoded(start);
      else if (name === "LB") this.label(start);
      else if (name === "DT") this.setLabelEnd(start);
      else this.command(name, numbersIn(match[2]));
    }
    this.flush();
    if (this.commandCount === 0) {
      throw new PlotwrightError("bad-file", "This is not an HPGL file: it has no commands. Export it again.");
    }
    return this.builder.finishAround();
  }

  private command(name: string, args: readonly number[]): void {
    switch (name) {
      case "PU":
      case "PD":
        this.isDown = name === "PD";
        if (!this.isDown) this.flush();
        this.coordinates(args);
        // A pen lowered without moving makes a dot, unless it continues from here.
        if (this.isDown && args.length === 0) this.lineTo(this.x, this.y);
        return;
      case "PA":
      case "PR":
        this.isRelative = name === "PR";
        this.coordinates(args);
        return;
      case "SP":
        this.flush();
        this.pen = Math.min(MAX_PENS, Math.max(0, Math.round(args[0] ?? 0)));
        this.isDown = false;
        return;
      case "IP":
        this.corners =
          args.length === 4
            ? args
            : args.length === 2
              ? [...args, args[0] + 1000, args[1] + 1000]
              : this.corners;
        return;
      case "SC":
        this.scale(args);
        return;
      case "AA":
      case "AR":
        if (args.length >= 3) this.arc(args, name === "AR");
        return;
      case "CI":
        if (args.length >= 1) this.circle(args[0] * this.scaleX);
        return;
      case "EA":
      case "RA":
      case "ER":
      case "RR":
        if (args.length >= 2) this.rectangle(args, name === "ER" || name === "RR");
        return;
      case "IN":
        this.flush();
        this.isDown = false;
        this.corners = USUAL_CORNERS;
        this.setDefaults();
        return;
      case "DF":
        this.setDefaults();
        return;
      case "LT":
        // Without numbers lines are solid; every type that has a number is a pattern.
        if (args.length > 0) this.warnings.add("effect-ignored", undefined, `LT${args[0]}: drawn solid`);
        return;
      case "IW":
        // Without numbers the window is the whole page again.
        if (args.length > 0) this.warnings.add("clip-ignored", undefined, name);
        return;
      case "PG":
        this.flush();
        if (this.page === "used") this.page = "turned";
        return;
      case "CP":
        this.moveByCells(args);
        return;
      default:
        if (this.labels.set(name, args, this.corners)) return;
        if (!SILENT.has(name)) this.warnings.add("not-supported", undefined, name);
    }
  }

  /** DF keeps P1, P2 and the pen's state: only IN resets these. */
  private setDefaults(): void {
    this.isRelative = false;
    this.scale([]);
    this.labels = new HpglLabels();
    this.labelEnd = LABEL_END;
  }

  private coordinates(args: readonly number[]): void {
    for (let i = 0; i + 1 < args.length; i += 2) this.goTo(args[i], args[i + 1]);
  }

  /** Goes to a point in user units. */
  private goTo(ux: number, uy: number, isRelative = this.isRelative): void {
    const [x, y] = this.plotterUnits(ux, uy, isRelative);
    if (this.isDown) this.lineTo(x, y);
    else this.flush();
    this.x = x;
    this.y = y;
  }

  /** A point in user units, from the origin or from the pen. */
  private plotterUnits(ux: number, uy: number, isRelative: boolean): [x: number, y: number] {
    return [
      ux * this.scaleX + (isRelative ? this.x : this.originX),
      uy * this.scaleY + (isRelative ? this.y : this.originY),
    ];
  }

  private lineTo(x: number, y: number): void {
    const { shape } = this;
    if (shape.isEmpty) shape.moveTo(this.x, this.y);
    shape.lineTo(x, y);
  }

  private scale(args: readonly number[]): void {
    const [p1x, p1y, p2x, p2y] = this.corners;
    if (args.length < 4) {
      this.scaleX = this.scaleY = 1;
      this.originX = this.originY = 0;
      return;
    }
    const [x0, x1, y0, y1] = args;
    // Type 2 gives a factor instead of the far corner.
    this.scaleX = args[4] === 2 ? x1 : (p2x - p1x) / (x1 - x0);
    this.scaleY = args[4] === 2 ? y1 : (p2y - p1y) / (y1 - y0);
    if (!Number.isFinite(this.scaleX + this.scaleY)) this.scaleX = this.scaleY = 1;
    this.originX = p1x - x0 * this.scaleX;
    this.originY = p1y - y0 * this.scaleY;
  }

  private arc(args: readonly number[], isRelative: boolean): void {
    const [cx, cy] = this.plotterUnits(args[0], args[1], isRelative);
    const radius = Math.hypot(this.x - cx, this.y - cy);
    const start = Math.atan2(this.y - cy, this.x - cx);
    const sweep = Math.max(-2 * Math.PI, Math.min(2 * Math.PI, (args[2] * Math.PI) / 180));
    const endX = cx + radius * Math.cos(start + sweep);
    const endY = cy + radius * Math.sin(start + sweep);
    if (this.isDown && radius > 0) {
      const { shape } = this;
      if (shape.isEmpty) shape.moveTo(this.x, this.y);
      drawCentreArc(shape, cx, cy, radius, radius, 0, start, sweep, endX, endY, TOLERANCE);
    }
    this.x = endX;
    this.y = endY;
  }

  /** Drawn regardless of the pen's state; the pen's position does not change. */
  private circle(radius: number): void {
    this.flush();
    const r = Math.abs(radius);
    if (!(r > 0)) return;
    const { shape, x, y } = this;
    shape.moveTo(x + r, y);
    drawCentreArc(shape, x, y, r, r, 0, 0, 2 * Math.PI, x + r, y, TOLERANCE);
    shape.close();
    this.flush();
  }

  private rectangle(args: readonly number[], isRelative: boolean): void {
    this.flush();
    this.shape.rectangle(this.x, this.y, ...this.plotterUnits(args[0], args[1], isRelative));
    this.flush();
  }

  private encoded(from: number): void {
    const end = this.text.indexOf(";", from);
    this.at = end < 0 ? this.text.length : end + 1;
    readEncodedPolyline(this.text.slice(from, end < 0 ? undefined : end), {
      pen: (pen) => this.command("SP", [pen]),
      move: (x, y, isUp, isAbsolute) => {
        this.isDown = !isUp;
        if (isUp) this.flush();
        this.goTo(x, y, !isAbsolute);
      },
    });
  }

  private setLabelEnd(at: number): void {
    const char = this.text.charAt(at);
    const isNamed = char !== "" && char !== ";";
    this.labelEnd = isNamed ? char : LABEL_END;
    this.at = at + (isNamed ? 1 : 0);
  }

  /** Drawn regardless of the pen's state. */
  private label(from: number): void {
    const { font, text, warnings } = this;
    const end = text.indexOf(this.labelEnd, from);
    this.at = end < 0 ? text.length : end + 1;
    this.flush();
    if (font === null) {
      warnings.add("text-not-drawn");
      return;
    }
    this.labelStart = { x: this.x, y: this.y };
    const label = text.slice(from, end < 0 ? undefined : end);
    const { pen, missing } = this.labels.draw(label, font, this.shape, this.labelStart);
    const box = this.flush(font.kind === "outline");
    for (const char of missing) warnings.add("glyphs-missing", box ?? undefined, `"${char}"`);
    this.x = pen.x;
    this.y = pen.y;
  }

  /** Moves by letters and lines; without numbers, to the next line. */
  private moveByCells(args: readonly number[]): void {
    this.flush();
    const [cells = 0, lines = 0] = args;
    const from = { x: this.x, y: this.y };
    const to =
      args.length > 0 ? this.labels.moved(from, cells, lines) : this.labels.moved(this.labelStart, 0, -1);
    this.x = to.x;
    this.y = to.y;
  }

  private flush(isFilled = false): Box | null {
    const { shape } = this;
    shape.finish();
    let box: Box | null = null;
    if (!shape.isEmpty && this.pen > 0) {
      const color = PEN_COLORS[(this.pen - 1) % PEN_COLORS.length];
      const look = isFilled ? { stroke: null, fill: color } : { stroke: color, fill: null };
      const where = (): string => `pen ${this.pen}`;
      const isDrawn = this.builder.addShape(shape, PAGE, look, this.groupOf(this.pen), null, where);
      if (isDrawn) {
        box = this.builder.boxOfLast();
        // Most files end with PG, which loses nothing. Only a page with something on it is reported.
        if (this.page === "turned")
          this.warnings.add("effect-ignored", undefined, "PG: drawn on top of the page before");
        this.page = "used";
      }
    }
    shape.clear();
    return box;
  }

  private groupOf(pen: number): number {
    return getOrAdd(this.groups, pen, () => this.builder.addGroup(`pen-${pen}`, `Pen ${pen}`, false));
  }
}

const TOLERANCE = ARC_TOLERANCE_MM / MM_PER_PLOTTER_UNIT;

function numbersIn(text: string): number[] {
  return (text.match(/[+-]?(?:\d+\.?\d*|\.\d+)/g) ?? []).map(Number);
}
