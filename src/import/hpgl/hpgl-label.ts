/**
 * HPGL labels: position and size of their letters, set by SI SR DI DR DV SL LO ES (HP, "PCL 5 Technical Reference",
 * chapter 23), symbols (SM) and characters drawn by the file (UC). The plotter's letters all have the same width, so each
 * letter is centred where the plotter's would be.
 *
 *    ┌ W ┐ W/2            a cell is 1.5 W wide, a line 2 H high
 *    ┌───┐     ┌───┐  ┐
 *    │   │     │   │  H   all in plotter units, y up
 *    └───┘─────└───┘──┘── baseline
 */
import {
  applyX,
  applyY,
  compose,
  rotation,
  scaling,
  translation,
  type Affine,
} from "../../geometry/affine.js";
import { curveBox, ShapeBuffer } from "../shape-buffer.js";
import { CAPITAL_EM, type TextFont, drawLine, layOutLine } from "../text/text-font.js";
import type { HpglFrame } from "./hpgl-frame.js";
import { clamp } from "../../geometry/polyline.js";

const UNITS_PER_CM = 400;
/** cm: the default on A4 plotters. */
const USUAL_WIDTH = 0.187;
const USUAL_HEIGHT = 0.269;
/** Shares of the distance between P1 and P2, percent. */
const USUAL_RELATIVE_WIDTH = 0.75;
const USUAL_RELATIVE_HEIGHT = 1.5;
/** Width of a plain capital in the built-in letters, em. */
const CAPITAL_WIDTH_EM = 14 / 30;
const CELL = 1.5;
const LINE = 2;
const LONGEST = 10_000;

interface Place {
  readonly x: number;
  readonly y: number;
}

export class HpglLabels {
  private size = [USUAL_WIDTH, USUAL_HEIGHT];
  /** The size is in percent of the distance between P1 and P2, instead of cm. */
  private isSizeRelative = false;
  private direction = [1, 0];
  /** The direction is in shares of the distance between P1 and P2. */
  private isDirectionRelative = false;
  private slant = 0;
  private origin = 1;
  /** Direction from one letter to the next: 0 right, 1 down, 2 left, 3 up. */
  private path = 0;
  /** New lines go to the other side. */
  private isReversed = false;
  /** Extra space, as shares of a cell and of a line. */
  private extraWidth = 0;
  private extraHeight = 0;

  constructor(private readonly frame: HpglFrame) {}

  /** Applies a setting. */
  set(name: string, [first, second]: readonly number[]): void {
    switch (name) {
      case "SI":
      case "SR":
        this.isSizeRelative = name === "SR";
        this.size = this.isSizeRelative
          ? [first ?? USUAL_RELATIVE_WIDTH, second ?? USUAL_RELATIVE_HEIGHT]
          : [first ?? USUAL_WIDTH, second ?? USUAL_HEIGHT];
        return;
      case "DI":
      case "DR":
        this.isDirectionRelative = name === "DR";
        this.direction = first === undefined || second === undefined ? [1, 0] : [first, second];
        return;
      case "SL":
        this.slant = first ?? 0;
        return;
      case "LO":
        this.origin = first ?? 1;
        return;
      case "ES":
        this.extraWidth = first ?? 0;
        this.extraHeight = second ?? 0;
        return;
      case "DV":
        this.path = Math.round(first ?? 0) & 3;
        this.isReversed = second === 1;
    }
  }

  /** The position `cells` further along the path and `lines` up across it. */
  moved({ x, y }: Place, cells: number, lines: number): Place {
    const map = this.mapAt({ x, y });
    const along = cells * this.step;
    const across = (this.isReversed ? -lines : lines) * (this.isUpright ? this.cell : this.line);
    // To the left of the direction: up, for letters that run to the right.
    const [dx, dy] = [
      [along, across],
      [across, -along],
      [-along, -across],
      [-across, along],
    ][this.path];
    return { x: applyX(map, dx, dy), y: applyY(map, dx, dy) };
  }

  /** Draws a label at the pen's position. Returns the new pen position and the missing characters. */
  draw(
    text: string,
    font: TextFont,
    shape: ShapeBuffer,
    at: Place,
  ): { readonly pen: Place; readonly missing: readonly string[] } {
    const missing: string[] = [];
    let column = 0;
    let row = 0;
    for (const part of text.slice(0, LONGEST).split(/([\r\n\b])/)) {
      if (part === "\r") column = 0;
      else if (part === "\n") row--;
      else if (part === "\b") column--;
      else {
        // Other control characters change the plotter's character set.
        const letters = [...part].filter((char) => char >= " ");
        this.drawRun(letters, font, shape, this.moved(at, column, row), missing);
        column += letters.length;
      }
    }
    return { pen: this.beginsAtPen ? this.moved(at, column, row) : at, missing };
  }

  /** Draws a symbol with its middle at the point. Returns whether the font lacks it. */
  drawSymbol(char: string, font: TextFont, shape: ShapeBuffer, at: Place): boolean {
    const missing: string[] = [];
    const symbol = new ShapeBuffer();
    this.drawRun([char], font, symbol, { x: 0, y: 0 }, missing);
    symbol.finish();
    const { x0, y0, x1, y1 } = curveBox(symbol);
    shape.append(symbol, translation(at.x - (x0 + x1) / 2, at.y - (y0 + y1) / 2));
    return missing.length > 0;
  }

  /**
   * Draws a character from the file's own steps: each is a distance in x and y, or 99 to lower the pen, or -99 to lift
   * it. A plain capital is 4 steps wide and 8 high.
   */
  drawUserCharacter(steps: readonly number[], shape: ShapeBuffer, at: Place): void {
    const size = scaling(this.width / 4, this.height / 8);
    const map = compose(this.mapAt(at), compose({ ...scaling(1), c: this.slant }, size));
    let [x, y, isDown] = [0, 0, false];
    for (let i = 0; i < steps.length;) {
      if (Math.abs(steps[i]) >= 99) {
        isDown = steps[i++] > 0;
        continue;
      }
      if (i + 1 >= steps.length) return;
      const from = [applyX(map, x, y), applyY(map, x, y)] as const;
      x += steps[i++];
      y += steps[i++];
      const to = [applyX(map, x, y), applyY(map, x, y)] as const;
      if (!isDown) continue;
      if (shape.isEmpty || shape.x !== from[0] || shape.y !== from[1]) shape.moveTo(...from);
      shape.lineTo(...to);
    }
  }

  private drawRun(
    letters: readonly string[],
    font: TextFont,
    shape: ShapeBuffer,
    at: Place,
    missing: string[],
  ): void {
    const { width, height } = this;
    const lengthOfRun = (letters.length - 1) * this.step;
    const corner = this.cornerOf(this.isUpright ? 0 : lengthOfRun, this.isUpright ? lengthOfRun : 0);
    const map = compose(this.mapAt(at), translation(corner.x, corner.y));
    // In a label that runs to the left or down, the first letter is at the far end.
    const first = this.path === 1 || this.path === 2 ? lengthOfRun : 0;
    const sign = first > 0 ? -1 : 1;
    const size = scaling(width / CAPITAL_WIDTH_EM, -height / CAPITAL_EM);
    const slanted = compose({ ...scaling(1), c: this.slant }, size);
    letters.forEach((letter, i) => {
      const line = layOutLine(font, letter, { family: "" });
      missing.push(...line.missing);
      const there = first + sign * i * this.step;
      const middle = translation((this.isUpright ? 0 : there) + width / 2, this.isUpright ? there : 0);
      drawLine(line, compose(map, compose(middle, compose(slanted, translation(-line.width / 2, 0)))), shape);
    });
  }

  /** Maps label coordinates (along the label, and up) to plotter units. */
  private mapAt({ x, y }: Place): Affine {
    return compose(translation(x, y), rotation(this.angle));
  }

  /** rad on the paper */
  private get angle(): number {
    const [shareX, shareY] = this.isDirectionRelative ? this.frame.spans : [1, 1];
    const [x, y] = this.direction;
    return this.frame.angle + Math.atan2(y * shareY, x * shareX);
  }

  private get width(): number {
    const [spanX] = this.frame.spans;
    return this.size[0] * (this.isSizeRelative ? Math.abs(spanX) / 100 : UNITS_PER_CM);
  }

  private get height(): number {
    const [, spanY] = this.frame.spans;
    return this.size[1] * (this.isSizeRelative ? Math.abs(spanY) / 100 : UNITS_PER_CM);
  }

  /** Letters are stacked vertically. */
  private get isUpright(): boolean {
    return this.path % 2 === 1;
  }

  private get cell(): number {
    return CELL * this.width * (1 + this.extraWidth);
  }

  private get line(): number {
    return LINE * this.height * (1 + this.extraHeight);
  }

  /** Distance from one letter to the next. */
  private get step(): number {
    return this.isUpright ? this.line : this.cell;
  }

  /** 0 if the pen is at the label's left, 0.5 at its middle, 1 at its right. */
  private get anchor(): number {
    return clamp(Math.ceil((this.origin % 10) / 3) - 1, 0, 2) / 2;
  }

  /**
   * With 1, 4 and 7 the pen's position is the label's bottom, with 2, 5 and 8 its vertical middle, with the
   * others its top.
   */
  private get rise(): number {
    return (((this.origin % 10) + 2) % 3) / 2;
  }

  /** If true the next label continues where this one ends; otherwise the pen stays. */
  private get beginsAtPen(): boolean {
    return [this.anchor === 0, this.rise === 1, this.anchor === 1, this.rise === 0][this.path];
  }

  /** With 11 to 19, labels are half a letter away from the pen's position. */
  private get clearance(): number {
    return this.origin > 10 && this.origin < 20 ? 0.5 : 0;
  }

  /** The lower left corner, relative to the pen, of a label that is this much longer and higher than one letter. */
  private cornerOf(longer: number, higher: number): Place {
    const { anchor, rise, clearance, width, height } = this;
    return {
      x: -anchor * (longer + width) + clearance * (1 - 2 * anchor) * width,
      y: -rise * (higher + height) + clearance * (1 - 2 * rise) * height,
    };
  }
}
