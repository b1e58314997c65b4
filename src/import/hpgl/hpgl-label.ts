/**
 * HPGL labels: position and size of their letters, set by SI SR DI DR DV SL LO ES (HP, "PCL 5 Technical
 * Reference", chapter 23). The plotter's letters all have the same width, so each letter is centred where the
 * plotter's would be.
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
import type { ShapeBuffer } from "../shape-buffer.js";
import { CAPITAL_EM, type TextFont } from "../text/text-font.js";
import { drawLine, layOutLine } from "../text/text-line.js";

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
  private width = USUAL_WIDTH * UNITS_PER_CM;
  private height = USUAL_HEIGHT * UNITS_PER_CM;
  /** rad */
  private angle = 0;
  private slant = 0;
  private origin = 1;
  /** Direction from one letter to the next: 0 right, 1 down, 2 left, 3 up. */
  private path = 0;
  /** New lines go to the other side. */
  private isReversed = false;
  /** Extra space, as shares of a cell and of a line. */
  private extraWidth = 0;
  private extraHeight = 0;

  /** Applies a setting; `corners` are P1 and P2. Returns false if the command does not concern labels. */
  set(name: string, args: readonly number[], corners: readonly number[]): boolean {
    const [first, second] = args;
    const spanX = corners[2] - corners[0];
    const spanY = corners[3] - corners[1];
    switch (name) {
      case "SI":
        this.width = (first ?? USUAL_WIDTH) * UNITS_PER_CM;
        this.height = (second ?? USUAL_HEIGHT) * UNITS_PER_CM;
        return true;
      case "SR":
        this.width = ((first ?? USUAL_RELATIVE_WIDTH) / 100) * Math.abs(spanX);
        this.height = ((second ?? USUAL_RELATIVE_HEIGHT) / 100) * Math.abs(spanY);
        return true;
      case "DI":
        this.angle = Math.atan2(second ?? 0, first ?? 1);
        return true;
      case "DR":
        this.angle = Math.atan2((second ?? 0) * spanY, (first ?? 1) * spanX);
        return true;
      case "SL":
        this.slant = first ?? 0;
        return true;
      case "LO":
        this.origin = first ?? 1;
        return true;
      case "ES":
        this.extraWidth = first ?? 0;
        this.extraHeight = second ?? 0;
        return true;
      case "DV":
        this.path = Math.round(first ?? 0) & 3;
        this.isReversed = second === 1;
        return true;
      default:
        return false;
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
    return Math.min(2, Math.max(0, Math.ceil((this.origin % 10) / 3) - 1)) / 2;
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

  /**
   * The lower left corner, relative to the pen, of a label that is this much longer and higher than one
   * letter.
   */
  private cornerOf(longer: number, higher: number): Place {
    const { anchor, rise, clearance, width, height } = this;
    return {
      x: -anchor * (longer + width) + clearance * (1 - 2 * anchor) * width,
      y: -rise * (higher + height) + clearance * (1 - 2 * rise) * height,
    };
  }
}
