/**
 * Paints a drawing that is made by hand: as ink what the pen has drawn, and pale what it has not. The ink is kept on a
 * canvas of its own, to which only what is new is added, until the view changes.
 */
import type { StrokePosition } from "../../../src/index.js";
import type { PenPlace } from "../../preview/pen/pen-glide.js";
import { INK_COLOR } from "../../scene/renderer.js";
import { screenMap, type View } from "../../scene/view.js";
import type { HandStrokes } from "./hand-strokes.js";

/** The paper is light in both themes. */
const PALE = "rgb(64 104 196 / 42%)";
const LINE_MM = 0.35;
const LEAST_LINE_PX = 1.1;
/** The reports say where the pen was. It is looked for so far ahead of there, and so near to the line, mm. */
const AHEAD_MM = 20;
const NEAR_MM = 0.4;

export class HandPicture {
  private readonly ink = new OffscreenCanvas(1, 1);
  /** What the ink's canvas shows. */
  private shown: { readonly view: View; readonly until: StrokePosition } | null = null;

  constructor(private readonly strokes: HandStrokes) {}

  paint(context: CanvasRenderingContext2D, view: View, until: StrokePosition): void {
    const { canvas } = context;
    // For programs that read the page.
    canvas.dataset["view"] = [view.scale, view.offsetX, view.offsetY, view.turn].join(" ");
    const map = context.getTransform();
    const isStale =
      this.shown?.view !== view ||
      this.ink.width !== canvas.width ||
      this.ink.height !== canvas.height ||
      isBefore(until, this.shown.until);
    if (isStale) [this.ink.width, this.ink.height] = [canvas.width, canvas.height];
    const ink = this.ink.getContext("2d");
    if (!ink) return;
    ink.setTransform(map);
    this.line(ink, view, isStale || !this.shown ? START : this.shown.until, until, INK_COLOR);
    this.shown = { view, until };
    this.line(context, view, until, { stroke: this.strokes.count, alongMm: 0 }, PALE);
    context.save();
    context.resetTransform();
    context.drawImage(this.ink, 0, 0);
    context.restore();
  }

  /** The strokes from one place to another one. */
  private line(
    context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D,
    view: View,
    from: StrokePosition,
    to: StrokePosition,
    color: string,
  ): void {
    const { strokes } = this;
    const { a, b, c, d, e, f } = screenMap(view);
    context.strokeStyle = color;
    context.lineCap = context.lineJoin = "round";
    context.lineWidth = Math.max(LEAST_LINE_PX, LINE_MM * view.scale);
    context.beginPath();
    const px = ([x, y]: readonly [number, number]): [number, number] => [
      a * x + c * y + e,
      b * x + d * y + f,
    ];
    for (let stroke = from.stroke; stroke <= to.stroke && stroke < strokes.count; stroke++) {
      const fromMm = stroke === from.stroke ? from.alongMm : 0;
      const toMm = stroke === to.stroke ? to.alongMm : Infinity;
      if (toMm <= fromMm) continue;
      const points = strokes.pointsOf(stroke);
      const last = strokes.firstBeyond({ stroke, alongMm: toMm });
      context.moveTo(...px(strokes.pointAt({ stroke, alongMm: fromMm })));
      for (let i = strokes.firstBeyond({ stroke, alongMm: fromMm }); i < last; i++)
        context.lineTo(...px(points[i]));
      context.lineTo(...px(strokes.pointAt({ stroke, alongMm: toMm })));
    }
    context.stroke();
  }
}

const START: StrokePosition = { stroke: 0, alongMm: 0 };

const isBefore = (one: StrokePosition, other: StrokePosition): boolean =>
  one.stroke < other.stroke || (one.stroke === other.stroke && one.alongMm < other.alongMm);

/**
 * Until where there is ink: the place of the last report, or the pen's own place, if it is down on the line not far
 * ahead. So the line grows under the nib, not in the steps of the reports.
 */
export const inkUntil = (
  strokes: HandStrokes,
  reported: StrokePosition,
  pen: PenPlace | null,
): StrokePosition => {
  if (!pen?.penDown || reported.stroke >= strokes.count) return reported;
  return strokes.nearest(reported, [pen.xMm, pen.yMm], AHEAD_MM, NEAR_MM) ?? reported;
};
