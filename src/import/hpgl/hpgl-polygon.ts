/**
 * The polygon buffer of HPGL (PM): rings, drawn by EP and filled by FP. All sides count for filling, but EP draws only
 * those during which the pen was down.
 */
import { PAIRS_OF_VERB, VERB_CLOSE, VERB_CUBIC, VERB_LINE, VERB_MOVE } from "../../drawing/drawing.js";
import type { PatternLine } from "../dxf/dxf-pattern.js";
import { ShapeBuffer } from "../shape-buffer.js";
import { RAD_PER_DEG } from "../../units.js";
import type { HpglFrame } from "./hpgl-frame.js";

const PARALLEL_LINES = 3;
const CROSSED_LINES = 4;
/** Percent of the distance between P1 and P2. */
const USUAL_SPACING = 1;
/** 0.05 mm in plotter units: no pen draws closer lines apart. */
const SMALLEST_SPACING = 2;

export class HpglPolygon {
  readonly rings = new ShapeBuffer();
  /** Indices of the verbs during which the pen was up. */
  private readonly hidden = new Set<number>();
  private isRingBegun = false;

  clear(): void {
    this.rings.clear();
    this.hidden.clear();
    this.isRingBegun = false;
  }

  /** Adds sides from (x, y). */
  add(x: number, y: number, isDown: boolean, draw: (rings: ShapeBuffer) => void): void {
    const { rings } = this;
    if (!this.isRingBegun) this.begin(x, y);
    const from = rings.verbs.length;
    draw(rings);
    if (!isDown) for (let verb = from; verb < rings.verbs.length; verb++) this.hidden.add(verb);
  }

  /** Begins a ring; does nothing within one. Returns whether it began. */
  begin(x: number, y: number): boolean {
    if (this.isRingBegun) return false;
    this.rings.moveTo(x, y);
    this.isRingBegun = true;
    return true;
  }

  /** Closes the ring. The closing side is drawn if the last one is. */
  end(): void {
    const { rings, hidden } = this;
    rings.finish();
    this.isRingBegun = false;
    const last = rings.verbs.length - 1;
    if (last < 0 || rings.verbs.data[last] === VERB_CLOSE) return;
    rings.close();
    if (hidden.has(last)) hidden.add(last + 1);
  }

  /** The sides that are drawn. */
  edges(): ShapeBuffer {
    const { rings, hidden } = this;
    if (hidden.size === 0) return rings;
    const edges = new ShapeBuffer();
    const { data } = rings.coords;
    let [x, y, startX, startY] = [0, 0, 0, 0];
    let isOpen = false;
    for (let verb = 0, at = 0; verb < rings.verbs.length; verb++) {
      const kind = rings.verbs.data[verb];
      const end = at + 2 * PAIRS_OF_VERB[kind];
      const isDrawn = kind !== VERB_MOVE && !hidden.has(verb);
      if (isDrawn && !isOpen) edges.moveTo(x, y);
      isOpen = isDrawn;
      [x, y] = kind === VERB_CLOSE ? [startX, startY] : [data[end - 2], data[end - 1]];
      if (kind === VERB_MOVE) [startX, startY] = [x, y];
      else if (isDrawn && kind === VERB_CUBIC)
        edges.cubicTo(data[at], data[at + 1], data[at + 2], data[at + 3], x, y);
      else if (isDrawn && (kind === VERB_LINE || x !== edges.x || y !== edges.y)) edges.lineTo(x, y);
      at = end;
    }
    edges.finish();
    return edges;
  }
}

/** The parallel lines of a fill by FT3 and FT4, which begin at AC's anchor; none for other types and if they are too close. */
export function linesOfFill(
  [type, distance = 0, angleDeg = 0]: readonly number[],
  [x, y]: readonly [number, number],
  frame: HpglFrame,
): PatternLine[] {
  if (type !== PARALLEL_LINES && type !== CROSSED_LINES) return [];
  const spacing =
    distance > 0 ? distance * Math.abs(frame.scales[0]) : (USUAL_SPACING / 100) * frame.diagonal;
  if (!(spacing >= SMALLEST_SPACING)) return [];
  return (type === PARALLEL_LINES ? [0] : [0, 90]).map((turnDeg) => {
    const angle = (angleDeg + turnDeg) * RAD_PER_DEG + frame.angle;
    const offset = { x: -spacing * Math.sin(angle), y: spacing * Math.cos(angle) };
    return { angleDeg: angle / RAD_PER_DEG, base: { x, y }, offset, dashes: [] };
  });
}
