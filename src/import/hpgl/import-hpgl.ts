/**
 * Reads HPGL and HP-GL/2 as a Drawing with a layer for each pen. hpgl-commands.ts lists all commands and what becomes
 * of them; this file carries out those that matter on paper.
 */
import type { Drawing } from "../../drawing/drawing.js";
import { PlotwrightError } from "../../errors.js";
import { boxOfPoints } from "../../geometry/box.js";
import { DrawingBuilder } from "../drawing-builder.js";
import type { ImportOptions } from "../import-options.js";
import { fontOf } from "../text/single-stroke-font.js";
import type { TextFont } from "../text/text-font.js";
import { WARNING_WORDS } from "../warning-words.js";
import { inWords, Warnings } from "../warnings.js";
import { HpglArcs } from "./hpgl-arcs.js";
import { HpglCanvas } from "./hpgl-canvas.js";
import { GROUP_OF } from "./hpgl-commands.js";
import { readEncodedPolyline, HpglReader, type HpglCommand } from "./hpgl-reader.js";
import { HpglFrame } from "./hpgl-frame.js";
import { HpglLabels } from "./hpgl-label.js";
import { linesOfFill } from "./hpgl-polygon.js";
import { drawRectangle, drawTick } from "./hpgl-shapes.js";

/** Percent of the distance between P1 and P2. */
const USUAL_TICK = 0.5;
const SOLID_FILLS = [1, 2];

/** Throws PlotwrightError("bad-file"). */
export function importHpgl(text: string, options: ImportOptions): Drawing {
  return new HpglImport(text, fontOf(options)).run();
}

/** What DF and IN reset. */
class Defaults {
  isRelative = false;
  /** The character of SM; "" for none. */
  symbol = "";
  fill: readonly number[] = [];
  /** Where fills with lines begin, plotter units. */
  anchor: readonly [x: number, y: number] = [0, 0];
  ticks: readonly [up: number, down: number] = [USUAL_TICK, USUAL_TICK];
  readonly labels: HpglLabels;
  readonly arcs: HpglArcs;

  constructor(frame: HpglFrame, canvas: HpglCanvas) {
    this.arcs = new HpglArcs(frame, canvas);
    this.labels = new HpglLabels(frame);
  }
}

class HpglImport {
  private readonly warnings = new Warnings();
  private readonly builder = new DrawingBuilder(this.warnings);
  private readonly frame = new HpglFrame();
  private readonly canvas: HpglCanvas;
  private state: Defaults;
  /** Start of the last label: a new line begins there. */
  private labelStart = { x: 0, y: 0 };
  /** The label of BL. */
  private buffered = "";
  private isGuessReported = false;
  /** Commands for styles of text that are not drawn, since the last label. */
  private textStyles: string[] = [];
  /** Where PM0 was. */
  private polygonStart = { x: 0, y: 0 };

  constructor(
    private readonly text: string,
    /** The font for labels; null if labels are only reported. */
    private readonly font: TextFont | null,
  ) {
    this.canvas = new HpglCanvas(this.builder, this.warnings, font?.kind === "outline");
    this.canvas.diagonal = this.frame.diagonal;
    this.state = new Defaults(this.frame, this.canvas);
  }

  run(): Drawing {
    const reader = new HpglReader(this.text);
    let count = 0;
    for (let command = reader.next(); command !== null; command = reader.next()) {
      count++;
      this.carryOut(command);
    }
    this.endPolygon("PM without PM2");
    this.canvas.flush();
    if (count === 0) {
      throw new PlotwrightError("bad-file", "This is not an HPGL file: it has no commands. Export it again.");
    }
    return inWords(this.builder.finishAround(), WARNING_WORDS);
  }

  private carryOut(command: HpglCommand): void {
    const { name, numbers, isOpen = false } = command;
    const group = GROUP_OF.get(name);
    if (isOpen) this.fault(name, "its text has no end");
    if (group === undefined) this.report(name);
    else if (numbers.length < group.least)
      this.warnings.add("attribute-fault", undefined, `${name}: too few numbers`);
    else if (group.outcome === "reported") {
      if (numbers.every((number) => number === 0)) return;
      // In a file without labels they change nothing.
      if (group.warning === "text-style-ignored") this.textStyles.push(name);
      else this.warnings.add(group.warning, undefined, name);
    } else if (group.outcome !== "setting") this.draw(command);
  }

  /** For a command that is not drawn. */
  private report(name: string): void {
    this.canvas.forgetDot();
    this.warnings.add("not-supported", undefined, name);
  }

  private fault(name: string, why: string): void {
    this.warnings.add("attribute-fault", undefined, `${name}: ${why}`);
  }

  private draw({ name, numbers, text }: HpglCommand): void {
    const { canvas, frame, state } = this;
    const [first, second] = numbers;
    switch (name) {
      case "PU":
        canvas.lift();
        return this.coordinates(name, numbers);
      case "PD":
        if (numbers.length === 0) canvas.lower();
        canvas.isDown = true;
        return this.coordinates(name, numbers);
      case "PA":
      case "PR":
        state.isRelative = name === "PR";
        return this.coordinates(name, numbers);
      case "PE":
        return this.encoded(text);
      case "AA":
      case "AR":
        return state.arcs.drawAboutCentre(numbers, name === "AR");
      case "AT":
      case "RT":
        return state.arcs.drawThroughPoint(numbers, name === "RT");
      case "BZ":
      case "BR":
        return this.curves(numbers, name === "BR");
      case "CI":
        return state.arcs.drawCircle(first, second);
      case "CT":
        state.arcs.areChordsDeviations = first === 1;
        return;
      case "EA":
      case "ER":
        this.rectangle(first, second, name === "ER");
        return canvas.drawEdges();
      case "RA":
      case "RR":
        this.rectangle(first, second, name === "RR");
        return this.fill(true);
      case "EW":
        state.arcs.setWedge(numbers);
        return canvas.drawEdges();
      case "WG":
        state.arcs.setWedge(numbers);
        return this.fill(true);
      case "PM":
        return this.polygonMode(first ?? 0);
      case "EP":
        this.polygonMode(2);
        return canvas.drawEdges();
      case "FP":
        this.polygonMode(2);
        return this.fill(first !== 1);
      case "FT":
        state.fill = numbers;
        return;
      case "AC":
        state.anchor = second === undefined ? [0, 0] : frame.onPaper(first, second);
        return;
      case "LT":
        return this.lineType(numbers);
      case "UL":
        canvas.endDashes();
        if (!canvas.lineTypes.define(numbers)) this.fault(name, "not a line type");
        return;
      case "SP":
        return canvas.selectPen(first ?? 0);
      case "PC":
        return canvas.setPenColor(numbers);
      case "CR":
        return canvas.setColorRange(numbers);
      case "IN":
      case "DF":
        return this.reset(name);
      case "IP":
      case "IR":
        return this.corners(name, numbers);
      case "SC":
        if (!frame.setScaling(numbers)) this.fault(name, "not a scale");
        return;
      case "RO":
        if (!frame.setRotation(first ?? 0)) this.fault(name, "not a multiple of 90");
        return;
      case "IW":
        return this.inputWindow(numbers);
      case "SM":
        state.symbol = text;
        return;
      case "BL":
        this.buffered = text;
        return;
      case "LB":
      case "PB":
        return this.label(name === "LB" ? text : this.buffered);
      case "CP":
        return this.moveByCells(numbers);
      case "UC":
        canvas.drawSolid((shape) => state.labels.drawUserCharacter(numbers, shape, canvas));
        return this.moveByCells([1, 0]);
      case "TL":
        state.ticks = first === undefined ? [USUAL_TICK, USUAL_TICK] : [first, second ?? 0];
        return;
      case "XT":
      case "YT":
        return canvas.drawSolid((shape) => drawTick(shape, canvas, name === "XT", state.ticks, frame));
      case "PG":
      case "AF":
      case "AH":
      case "FR":
        return canvas.turnPage(name);
      case "DT":
        // The reader needs it, and only the reader.
        return;
      default:
        // SI SR DI DR DV SL LO ES
        state.labels.set(name, numbers);
    }
  }

  /** DF keeps P1, P2, the rotation and the pen's state: only IN resets these. */
  private reset(name: string): void {
    const { canvas, frame } = this;
    this.endPolygon(`PM without PM2 before ${name}`);
    canvas.endDashes();
    canvas.polygon.clear();
    canvas.lineTypes.reset();
    canvas.setWindow(null);
    this.state = new Defaults(frame, canvas);
    frame.setScaling([]);
    this.textStyles = [];
    if (name === "DF") return;
    canvas.lift();
    frame.reset();
    canvas.diagonal = frame.diagonal;
    canvas.setPenColor([]);
    canvas.setColorRange([]);
  }

  private corners(name: string, numbers: readonly number[]): void {
    const { canvas, frame } = this;
    if (name === "IR") frame.setRelativeCorners(numbers);
    else frame.setCorners(numbers);
    canvas.endDashes();
    canvas.diagonal = frame.diagonal;
  }

  /** Points in user units, from the origin or from the pen. */
  private coordinates(name: string, numbers: readonly number[]): void {
    for (let i = 0; i + 1 < numbers.length; i += 2)
      this.goTo(numbers[i], numbers[i + 1], this.state.isRelative);
    if (numbers.length % 2 === 1) this.fault(name, "a number too many");
  }

  private goTo(x: number, y: number, isRelative: boolean): void {
    const { canvas, state, font, warnings } = this;
    canvas.goTo(...this.pointOnPaper(x, y, isRelative));
    if (state.symbol === "" || canvas.isInPolygon) return;
    if (font === null) warnings.add("text-not-drawn");
    else if (state.labels.drawSymbol(state.symbol, font, canvas.letters, canvas))
      warnings.add("glyphs-missing", undefined, `"${state.symbol}"`);
  }

  private pointOnPaper(x: number, y: number, isRelative: boolean): [x: number, y: number] {
    const { canvas, frame } = this;
    if (frame.isGuessed && !this.isGuessReported) {
      this.isGuessReported = true;
      this.warnings.add("page-size", undefined, "SC without IP");
    }
    if (!isRelative) return frame.onPaper(x, y);
    const [dx, dy] = frame.vectorOnPaper(x, y);
    return [canvas.x + dx, canvas.y + dy];
  }

  /** Bézier curves; relative ones are from their own start. */
  private curves(numbers: readonly number[], isRelative: boolean): void {
    for (let i = 0; i + 5 < numbers.length; i += 6) {
      const [x1, y1, x2, y2, x, y] = numbers.slice(i, i + 6);
      const ends = [
        ...this.pointOnPaper(x1, y1, isRelative),
        ...this.pointOnPaper(x2, y2, isRelative),
        ...this.pointOnPaper(x, y, isRelative),
      ] as const;
      this.canvas.draw((shape) => shape.cubicTo(...ends));
    }
    if (numbers.length % 6 !== 0) this.fault(isRelative ? "BR" : "BZ", "an incomplete curve");
  }

  /** From the pen's position to the opposite corner. */
  private rectangle(x: number, y: number, isRelative: boolean): void {
    const { canvas, frame } = this;
    const here = frame.inUserUnits(canvas.x, canvas.y);
    const corner = isRelative ? ([here[0] + x, here[1] + y] as const) : ([x, y] as const);
    canvas.setPolygon((rings) => drawRectangle(rings, here, corner, frame));
  }

  /** 0 begins a polygon, 1 ends a ring of it, 2 ends it. The pen returns to where the polygon began. */
  private polygonMode(mode: number): void {
    const { canvas } = this;
    if (mode === 0) {
      canvas.flush();
      this.polygonStart = { x: canvas.x, y: canvas.y };
      canvas.isInPolygon = true;
      canvas.polygon.clear();
      canvas.polygon.begin(canvas.x, canvas.y);
    } else if (canvas.isInPolygon) {
      canvas.polygon.end();
      if (mode === 1) return;
      canvas.isInPolygon = false;
      canvas.place(this.polygonStart.x, this.polygonStart.y);
    }
  }

  /** A polygon that is never ended is not drawn. */
  private endPolygon(why: string): void {
    const { canvas } = this;
    if (!canvas.isInPolygon) return;
    this.polygonMode(2);
    if (!canvas.polygon.rings.isEmpty) this.warnings.add("not-supported", undefined, why);
  }

  /** Fills the polygon. */
  private fill(evenOdd: boolean): void {
    const { canvas, frame, state } = this;
    const lines = linesOfFill(state.fill, state.anchor, frame);
    if (lines.length > 0 && canvas.hatch(lines)) return;
    const [type = SOLID_FILLS[0]] = state.fill;
    if (!SOLID_FILLS.includes(type))
      this.warnings.add("effect-ignored", undefined, `FT${type}: filled as a solid area`);
    canvas.fillArea(evenOdd);
  }

  private lineType(numbers: readonly number[]): void {
    const { canvas } = this;
    canvas.endDashes();
    if (numbers.length > 0) canvas.flush();
    if (!canvas.lineTypes.select(numbers)) this.fault("LT", `no line type ${numbers[0]}`);
    if (canvas.lineTypes.isAdaptive)
      this.warnings.add("effect-ignored", undefined, `LT${numbers[0]}: dashes not fitted to each line`);
  }

  private inputWindow(numbers: readonly number[]): void {
    const { canvas, frame } = this;
    const [x0, y0, x1, y1] = numbers;
    if (numbers.length < 4) canvas.setWindow(null);
    else canvas.setWindow(boxOfPoints([...frame.onPaper(x0, y0), ...frame.onPaper(x1, y1)]));
  }

  private encoded(text: string): void {
    const { canvas } = this;
    if (text.includes("\ufffd"))
      return this.fault("PE", "bytes were lost when the file was read as text in UTF-8");
    readEncodedPolyline(text, {
      pen: (pen) => canvas.selectPen(pen),
      move: (x, y, isUp, isAbsolute) => {
        if (isUp) canvas.lift();
        else canvas.isDown = true;
        this.goTo(x, y, !isAbsolute);
      },
    });
  }

  /** Drawn regardless of the pen's state. */
  private label(text: string): void {
    const { canvas, font, state, warnings } = this;
    canvas.flush();
    for (const name of this.textStyles.splice(0)) warnings.add("text-style-ignored", undefined, name);
    if (font === null) {
      warnings.add("text-not-drawn");
      return;
    }
    this.labelStart = { x: canvas.x, y: canvas.y };
    const { pen, missing } = state.labels.draw(text, font, canvas.letters, this.labelStart);
    const box = canvas.flush();
    for (const char of missing) warnings.add("glyphs-missing", box ?? undefined, `"${char}"`);
    canvas.place(pen.x, pen.y);
  }

  /** Moves by letters and lines; without numbers, to the next line. */
  private moveByCells(numbers: readonly number[]): void {
    const { canvas, state, labelStart } = this;
    canvas.flush();
    const [cells = 0, lines = 0] = numbers;
    const to =
      numbers.length > 0 ? state.labels.moved(canvas, cells, lines) : state.labels.moved(labelStart, 0, -1);
    canvas.place(to.x, to.y);
  }
}
