/**
 * The canvas of what moves at every frame: the pen, and the ink since the strokes were last drawn. Only the part that
 * changes is cleared, because a whole canvas at every frame is much work without a graphics card.
 */
import { rampColor } from "../../../src/internal.js";
import { LAYER_SHORT, PIECE_FLOATS, PIECE_SHORTS, VALUE_SHORT, type Pieces } from "../../scene/pieces.js";
import { lineWidthPx, type Frame } from "../../scene/renderer.js";
import { piecesBefore } from "../../scene/scene.js";
import { screenMap, screenPoint, type Size, type View } from "../../scene/view.js";
import { RULER_PX } from "../overlay.js";
import type { PenPlace } from "./pen-glide.js";

/** Strokes from a moment of the plan to another one. */
export interface FreshInk {
  readonly pieces: Pieces;
  readonly totalS: number;
  readonly fromS: number;
  readonly toS: number;
  readonly frame: Frame;
}

/** How high a pen that is up is shown above its place, and the time in which it gets there. */
const LIFT_PX = 9;
const LIFT_MS = 90;
const LENGTH_PX = 46;
const NIB_PX = 13;
const HALF_PX = 5.5;
/** The pen leans away from the lower left, so that it does not hide the line that it draws. */
const LEAN = { x: 0.5, y: -0.866 };
/** Around the pen's place, with everything that is painted for it. */
const PEN_REACH_PX = LENGTH_PX + LIFT_PX + 8;
const SHADOW = "rgb(20 22 28 / 26%)";
const METAL = "#c9ccd3";
const EDGE = "rgb(255 255 255 / 92%)";

export class PenLayer {
  /** What is to be cleared, CSS px x0 y0 x1 y1; null: nothing is painted. */
  private painted: [number, number, number, number] | null = null;
  /** 0: down, 1: up. */
  private lift = 0;
  private lastMs = 0;

  constructor(private readonly canvas: HTMLCanvasElement) {}

  /** Paints the moment. Returns whether the pen is still on its way up or down. */
  paint(
    pen: { readonly place: PenPlace; readonly color: string } | null,
    ink: FreshInk | null,
    view: View,
    size: Size,
    ratio: number,
    nowMs: number,
  ): boolean {
    const context = this.begin(size, ratio);
    if (!context || !pen) return false;
    context.save();
    context.beginPath();
    context.rect(RULER_PX, RULER_PX, size.width, size.height);
    context.clip();
    if (ink) this.paintInk(context, ink);
    context.restore();
    const { place, color } = pen;
    const wanted = place.penDown ? 0 : 1;
    const step = Math.max(0, nowMs - this.lastMs) / LIFT_MS;
    this.lift += Math.max(-step, Math.min(step, wanted - this.lift));
    this.lastMs = nowMs;
    const [x, y] = screenPoint(view, place.xMm, place.yMm);
    // It lies over the rulers as a pen would, while its point is beside them.
    if (x >= RULER_PX && y >= RULER_PX) {
      this.reach(x, y, PEN_REACH_PX);
      paintPen(context, x, y, color, this.lift);
    }
    this.canvas.dataset["mm"] = `${place.xMm.toFixed(3)} ${place.yMm.toFixed(3)}`;
    return this.lift !== wanted;
  }

  private begin({ width, height }: Size, ratio: number): CanvasRenderingContext2D | null {
    const { canvas } = this;
    const [w, h] = [Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio))];
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    const context = canvas.getContext("2d");
    context?.setTransform(ratio, 0, 0, ratio, 0, 0);
    if (this.painted) {
      const [x0, y0, x1, y1] = this.painted;
      context?.clearRect(x0, y0, x1 - x0, y1 - y0);
    }
    this.painted = null;
    delete canvas.dataset["mm"];
    return context;
  }

  private reach(x: number, y: number, px: number): void {
    const [x0, y0, x1, y1] = this.painted ?? [x, y, x, y];
    this.painted = [
      Math.min(x0, Math.floor(x - px)),
      Math.min(y0, Math.floor(y - px)),
      Math.max(x1, Math.ceil(x + px)),
      Math.max(y1, Math.ceil(y + px)),
    ];
  }

  private paintInk(context: CanvasRenderingContext2D, { pieces, totalS, fromS, toS, frame }: FreshInk): void {
    const floats = new Float32Array(pieces.bytes);
    const shorts = new Uint16Array(pieces.bytes);
    const { a, b, c, d, e, f } = screenMap(frame.view);
    context.lineCap = "round";
    const last = piecesBefore(pieces, toS);
    for (let i = Math.max(0, piecesBefore(pieces, fromS) - 1); i < last; i++) {
      const [ax, ay, bx, by, beginS, endS] = floats.subarray(i * PIECE_FLOATS, i * PIECE_FLOATS + 6);
      const layer = shorts[i * PIECE_SHORTS + LAYER_SHORT];
      const shareAt = (s: number): number =>
        endS > beginS ? Math.min(1, (s - beginS) / (endS - beginS)) : 1;
      const [from, to] = [Math.max(0, shareAt(fromS)), shareAt(toS)];
      if (endS > beginS && to <= from) continue;
      const x = (share: number): number => a * (ax + share * (bx - ax)) + c * (ay + share * (by - ay)) + e;
      const y = (share: number): number => b * (ax + share * (bx - ax)) + d * (ay + share * (by - ay)) + f;
      const widthPx = lineWidthPx(frame, frame.layerWidthsMm[layer] ?? 0);
      context.beginPath();
      context.moveTo(x(from), y(from));
      context.lineTo(x(to), y(to));
      context.lineWidth = widthPx;
      context.strokeStyle =
        frame.colorBy === "layer"
          ? (frame.layerColors[layer] ?? "")
          : rampColor(
              frame.colorBy === "time" ? beginS / totalS : shorts[i * PIECE_SHORTS + VALUE_SHORT] / 65_535,
            );
      context.stroke();
      this.reach(x(from), y(from), widthPx + 1);
      this.reach(x(to), y(to), widthPx + 1);
    }
  }
}

/** A pen with its nib at (x, y), or above it, and the shadow that it throws on the paper. */
const paintPen = (
  context: CanvasRenderingContext2D,
  x: number,
  y: number,
  color: string,
  lift: number,
): void => {
  context.save();
  context.fillStyle = SHADOW;
  context.beginPath();
  // The higher the pen, the farther and the softer its shadow.
  context.ellipse(x + 3 + 4 * lift, y + 1 + 2 * lift, 4 + 5 * lift, 2 + 2 * lift, 0.3, 0, 2 * Math.PI);
  context.fill();
  context.translate(x, y - LIFT_PX * lift);
  context.rotate(Math.atan2(LEAN.y, LEAN.x));
  context.lineJoin = "round";
  context.strokeStyle = EDGE;
  context.lineWidth = 3;
  // The pen lies along the x axis, with its nib at the origin.
  const body = new Path2D();
  body.moveTo(NIB_PX, -HALF_PX);
  body.lineTo(LENGTH_PX - 3, -HALF_PX);
  body.quadraticCurveTo(LENGTH_PX, -HALF_PX, LENGTH_PX, 0);
  body.quadraticCurveTo(LENGTH_PX, HALF_PX, LENGTH_PX - 3, HALF_PX);
  body.lineTo(NIB_PX, HALF_PX);
  body.closePath();
  const nib = new Path2D();
  nib.moveTo(0, 0);
  nib.lineTo(NIB_PX, -HALF_PX);
  nib.lineTo(NIB_PX, HALF_PX);
  nib.closePath();
  context.stroke(body);
  context.stroke(nib);
  context.fillStyle = METAL;
  context.fill(nib);
  context.fillStyle = color;
  context.fill(body);
  const point = new Path2D();
  point.moveTo(0, 0);
  point.lineTo(NIB_PX * 0.5, -HALF_PX * 0.5);
  point.lineTo(NIB_PX * 0.5, HALF_PX * 0.5);
  point.closePath();
  context.fill(point);
  // Light from above left, so that the pen looks round.
  context.fillStyle = "rgb(255 255 255 / 30%)";
  context.fillRect(NIB_PX, -HALF_PX + 1.5, LENGTH_PX - NIB_PX - 3, 2);
  context.restore();
};
