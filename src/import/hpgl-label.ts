/**
 * Labels of HPGL: where their letters stand and how large they are, set by SI SR DI DR SL LO (HP, "PCL 5 Technical
 * Reference", chapter 23). The plotter's letters all have the same width, so each of ours stands in the middle of
 * where the plotter's would.
 *
 *    ┌ W ┐ W/2            a cell is 1.5 W wide, a line 2 H
 *    ┌───┐     ┌───┐  ┐
 *    │   │     │   │  H   all in plotter units, y up
 *    └───┘─────└───┘──┘── baseline
 */
import { applyX, applyY, compose, rotation, scaling, translation, type Affine } from "../geometry/affine.js";
import type { ShapeBuffer } from "./shape-buffer.js";
import { CAPITAL_EM, type TextFont } from "./text-font.js";
import { drawLine, layOutLine } from "./text-line.js";

const UNITS_PER_CM = 400;
/** cm: a plotter's size on A4. */
const USUAL_WIDTH = 0.187;
const USUAL_HEIGHT = 0.269;
/** Shares of the distance between P1 and P2, percent. */
const USUAL_RELATIVE_WIDTH = 0.75;
const USUAL_RELATIVE_HEIGHT = 1.5;
/** Width of a plain capital in the letters that we have, em. */
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

  /** Takes a setting; `corners` are those of P1 and P2. False where the command is none of labels. */
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
      default:
        return false;
    }
  }

  /** The place so many cells on and lines up from there. */
  moved({ x, y }: Place, cells: number, lines: number): Place {
    const map = this.mapAt({ x, y });
    const dx = cells * CELL * this.width;
    const dy = lines * LINE * this.height;
    return { x: applyX(map, dx, dy), y: applyY(map, dx, dy) };
  }

  /** Draws a label at the pen's place. Answers where the pen is then, and what the font has not. */
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
    return { pen: this.anchor === 0 ? this.moved(at, column, row) : at, missing };
  }

  private drawRun(
    letters: readonly string[],
    font: TextFont,
    shape: ShapeBuffer,
    at: Place,
    missing: string[],
  ): void {
    const { width, height } = this;
    const map = compose(this.mapAt(at), translation(this.shiftX(letters.length), this.shiftY()));
    const size = scaling(width / CAPITAL_WIDTH_EM, -height / CAPITAL_EM);
    const slanted = compose({ ...scaling(1), c: this.slant }, size);
    letters.forEach((letter, i) => {
      const line = layOutLine(font, letter, "");
      missing.push(...line.missing);
      const middle = translation(i * CELL * width + width / 2, 0);
      drawLine(line, compose(map, compose(middle, compose(slanted, translation(-line.width / 2, 0)))), shape);
    });
  }

  /** Along the label and up from it to plotter units. */
  private mapAt({ x, y }: Place): Affine {
    return compose(translation(x, y), rotation(this.angle));
  }

  /** 0 where labels begin at the pen, 0.5 where that is their middle, 1 where they end there. */
  private get anchor(): number {
    return Math.min(2, Math.max(0, Math.ceil((this.origin % 10) / 3) - 1)) / 2;
  }

  /** Under 11 to 19 labels stand half a letter off the pen's place. */
  private get clearance(): number {
    return this.origin > 10 && this.origin < 20 ? 0.5 : 0;
  }

  private shiftX(count: number): number {
    const { anchor, width } = this;
    return -anchor * (count * CELL - (CELL - 1)) * width + this.clearance * (1 - 2 * anchor) * width;
  }

  /** 1, 4 and 7 stand on the pen's place, 2, 5 and 8 have it at half their height, the others hang from it. */
  private shiftY(): number {
    const down = (((this.origin % 10) + 2) % 3) / 2;
    return -down * this.height + this.clearance * (1 - 2 * down) * this.height;
  }
}
