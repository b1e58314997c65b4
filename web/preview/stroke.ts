/** The selected stroke of a plan: its numbers and its picture. */
import type { Trajectory } from "../../src/index.js";
import { PIECE_FLOATS } from "../scene/pieces.js";
import { screenMap } from "../scene/view.js";
import { piecesBefore, type Scene } from "../scene/scene.js";
import { selectedStroke, type PageState } from "../state/store.js";
import { penLooks } from "./view-modes.js";
import type { OverlayPainter } from "./stage.js";

interface StrokeFigures {
  readonly lengthMm: number;
  /** When it begins, and how long it takes. */
  readonly startS: number;
  readonly durationS: number;
  /** mm x, y, x, y … of its line. */
  readonly points: Float32Array;
}

interface Drawn {
  readonly scene: Scene;
  readonly trajectory: Trajectory;
}

/** Tolerance, because the times of the pieces are 32-bit floats. */
const ROUNDING_S = 1e-4;

/** Null if the plan has no such stroke. */
export const strokeFigures = ({ scene, trajectory }: Drawn, strokeIndex: number): StrokeFigures | null => {
  const { runs, totalS } = trajectory;
  const first = runs.stroke.indexOf(strokeIndex);
  if (first < 0) return null;
  let next = first + 1;
  while (next < runs.count && runs.stroke[next] === strokeIndex) next++;
  const startS = runs.startS[first];
  const endS = next < runs.count ? runs.startS[next] : totalS;
  const points = pointsBetween(scene, startS, endS);
  let lengthMm = 0;
  for (let k = 2; k < points.length; k += 2) {
    lengthMm += Math.hypot(points[k] - points[k - 2], points[k + 1] - points[k - 1]);
  }
  return { lengthMm, startS, durationS: endS - startS, points };
};

const pointsBetween = ({ draw }: Scene, startS: number, endS: number): Float32Array => {
  const floats = new Float32Array(draw.bytes);
  const near = ROUNDING_S + 1e-7 * endS;
  const from = piecesBefore(draw, startS - near);
  let to = from;
  while (to < draw.count && floats[to * PIECE_FLOATS + 5] <= endS + near) to++;
  const points = new Float32Array(to > from ? 2 * (to - from) + 2 : 0);
  for (let k = from; k < to; k++)
    points.set(floats.subarray(k * PIECE_FLOATS, k * PIECE_FLOATS + 2), 2 * (k - from));
  if (to > from)
    points.set(floats.subarray((to - 1) * PIECE_FLOATS + 2, (to - 1) * PIECE_FLOATS + 4), 2 * (to - from));
  return points;
};

const SELECTED_COLOR = "#1450ff";
const CASING_COLOR = "#ffffff";
/** A border on each side, so that the line stands out. */
const CASING_PX = 2.5;
const MIN_PX = 2;

/** Paints the selected stroke over the others, as wide as its pen's line. */
export const selectionPainter = (state: PageState): OverlayPainter | null => {
  const selected = selectedStroke(state);
  if (!selected) return null;
  const { of: planned, hover } = selected;
  const stroke = strokeFigures(planned, hover.strokeNumber - 1);
  if (!stroke) return null;
  const widthMm = penLooks({ planned, settings: state.settings })[hover.layer]?.widthMm ?? 0;
  return (context, view) => {
    const { points } = stroke;
    const { a, b, c, d, e, f } = screenMap(view);
    const linePx = Math.max(MIN_PX, widthMm * view.scale);
    context.save();
    context.lineCap = "round";
    context.lineJoin = "round";
    context.beginPath();
    for (let k = 0; k < points.length; k += 2) {
      const x = a * points[k] + c * points[k + 1] + e;
      const y = b * points[k] + d * points[k + 1] + f;
      if (k === 0) context.moveTo(x, y);
      else context.lineTo(x, y);
    }
    context.strokeStyle = CASING_COLOR;
    context.lineWidth = linePx + 2 * CASING_PX;
    context.stroke();
    context.strokeStyle = SELECTED_COLOR;
    context.lineWidth = linePx;
    context.stroke();
    context.restore();
  };
};
