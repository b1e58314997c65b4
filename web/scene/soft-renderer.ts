/**
 * Draws strokes on the processor if there is no graphics card. Computes for each pixel near a piece what the shader
 * computes for a fragment. Much faster than WebGL2 in software.
 *
 *   d      distance of the pixel's centre from the piece, device px
 *   reach  half the line's width, device px
 *   alpha  reach + 1/2 − d, clamped to 0 … 1: how much of the pixel the line covers
 *
 * Where a stroke goes on almost straight, a piece ends without a round end (`beyondJoint`).
 *
 * Pixels are premultiplied RGBA. Pieces are in order of time, so the result does not depend on the number of parts.
 */
import { bytesFromHex, RAMP_SIZE, rampBytes } from "./color-map.js";
import {
  ASKED_COLOR,
  INK_COLOR,
  lineWidthPx,
  pictureSize,
  TRAVEL_ALPHA,
  TRAVEL_COLOR,
  TRAVEL_PX,
  type Detail,
  type Frame,
  type Picture,
  type SceneRenderer,
} from "./renderer.js";
import { beyondJoint, JOINT_SHORT, LAYER_SHORT, PIECE_FLOATS, PIECE_SHORTS, VALUE_SHORT } from "./pieces.js";
import { screenMap } from "./view.js";
import {
  cutOffS,
  drawSome,
  piecesOf,
  sheetsOf,
  tasksOf,
  type Boxed,
  type Sheet,
  type PieceStyle,
  type Task,
} from "./tasks.js";

/** Colours and widths of the pieces of one style. */
interface Look {
  /** What a piece's place on the colour ramp depends on; null: each layer has one colour. */
  readonly by: "value" | "time" | null;
  /** RGB by layer; a single entry applies to all layers. */
  readonly colors: readonly (readonly [number, number, number])[];
  readonly alpha: number;
  /** Device px by layer; a single entry applies to all layers. */
  readonly reaches: readonly number[];
}

export const createSoftRenderer = (canvas: OffscreenCanvas): SceneRenderer => {
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) throw new Error("This browser can't draw in a worker.");
  return new SoftRenderer(context);
};

class SoftRenderer implements SceneRenderer {
  private readonly ramp = rampBytes();
  private image = new ImageData(1, 1);
  private sheets: Record<Detail, Sheet<Boxed>> | null = null;
  private totalS = 1;
  private frame: Frame | null = null;
  private tasks: Task<Boxed>[] = [];

  constructor(private readonly context: OffscreenCanvasRenderingContext2D) {}

  get isFinished(): boolean {
    return this.tasks.length === 0;
  }

  setScene(scene: Picture | null): void {
    this.tasks = [];
    this.totalS = Math.max(1e-6, scene?.totalS ?? 1);
    this.sheets = scene && sheetsOf(scene, (boxed) => boxed);
  }

  begin(frame: Frame, detail: Detail): number {
    const [width, height] = pictureSize(frame);
    if (this.image.width === width && this.image.height === height) this.image.data.fill(0);
    else this.image = new ImageData(width, height);
    this.frame = frame;
    this.tasks = this.sheets ? tasksOf(frame, this.sheets[detail]) : [];
    return piecesOf(this.tasks);
  }

  advance(pieceCount: number): number {
    const frame = this.frame;
    if (!frame) return 0;
    return drawSome(this.tasks, pieceCount, (task, to) => {
      this.drawRange(frame, task, to);
      return true;
    });
  }

  isIdle(): boolean {
    return true;
  }

  present(): void {
    const { canvas } = this.context;
    const { width, height, data } = this.image;
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    unmultiply(data);
    this.context.putImageData(this.image, 0, 0);
  }

  close(): void {
    this.setScene(null);
  }

  private drawRange(frame: Frame, { of: { pieces }, style, from }: Task<Boxed>, to: number): void {
    const floats = new Float32Array(pieces.bytes);
    const shorts = new Uint16Array(pieces.bytes);
    const look = lookOf(frame, style);
    const brush = new Brush(this.image);
    const { view, ratio } = frame;
    const {
      a,
      b,
      c,
      d,
      e: left,
      f: top,
    } = screenMap({
      ...view,
      scale: view.scale * ratio,
      offsetX: view.offsetX * ratio,
      offsetY: view.offsetY * ratio,
    });
    const untilS = cutOffS(frame, style);
    for (let i = from; i < to; i++) {
      const f = i * PIECE_FLOATS;
      const s = i * PIECE_SHORTS;
      const layer = shorts[s + LAYER_SHORT];
      const durationS = floats[f + 5] - floats[f + 4];
      const part = durationS > 0 ? Math.min(1, (untilS - floats[f + 4]) / durationS) : 1;
      brush.reach = look.reaches[layer] ?? look.reaches[0];
      brush.alpha = look.alpha;
      const joints = shorts[s + JOINT_SHORT];
      brush.isFlush = beyondJoint(joints & 255, brush.reach) !== null;
      // Under the pen the line ends, whatever follows.
      brush.beyondPx = (part < 1 ? null : beyondJoint(joints >> 8, brush.reach)) ?? Infinity;
      if (look.by === "value") {
        const value0 = shorts[s + VALUE_SHORT] / 65_535;
        const value1 = shorts[s + VALUE_SHORT + 1] / 65_535;
        brush.setRamp(this.ramp, value0, value0 + part * (value1 - value0));
      } else if (look.by === "time") {
        const beganS = floats[f + 4];
        brush.setRamp(this.ramp, beganS / this.totalS, (beganS + part * durationS) / this.totalS);
      } else {
        brush.setPlain(look.colors[layer] ?? look.colors[0]);
      }
      const x0 = floats[f];
      const y0 = floats[f + 1];
      const x1 = x0 + part * (floats[f + 2] - x0);
      const y1 = y0 + part * (floats[f + 3] - y0);
      brush.draw(
        a * x0 + c * y0 + left,
        b * x0 + d * y0 + top,
        a * x1 + c * y1 + left,
        b * x1 + d * y1 + top,
      );
    }
  }
}

const lookOf = (frame: Frame, style: PieceStyle): Look => {
  const reachOf = (widthPx: number): number => (widthPx * frame.ratio) / 2;
  if (style === "travel") {
    const colors = [bytesFromHex(TRAVEL_COLOR)];
    return { by: null, colors, alpha: TRAVEL_ALPHA, reaches: [reachOf(TRAVEL_PX)] };
  }
  if (style === "asked") {
    return { by: null, colors: [bytesFromHex(ASKED_COLOR)], alpha: 1, reaches: [reachOf(TRAVEL_PX)] };
  }
  const widthsMm = frame.layerWidthsMm.length > 0 ? frame.layerWidthsMm : [0];
  const reaches = widthsMm.map((mm) => reachOf(lineWidthPx(frame, mm)));
  if (style === "ghost") return { by: null, colors: [bytesFromHex(frame.ghostColor)], alpha: 1, reaches };
  if (frame.colorBy !== "layer") return { by: frame.colorBy, colors: [], alpha: 1, reaches };
  const colors = frame.layerColors.length > 0 ? frame.layerColors : [INK_COLOR];
  return { by: null, colors: colors.map(bytesFromHex), alpha: 1, reaches };
};

/**
 * Draws single pieces. Its fields are parameters that would otherwise be passed in an object per piece, a million
 * times.
 */
class Brush {
  reach = 1;
  alpha = 1;
  /** Begins without a round end. */
  isFlush = false;
  /** How much of its end is drawn, device px. */
  beyondPx = Infinity;
  private readonly data: Uint8ClampedArray;
  private readonly width: number;
  private readonly height: number;
  private ramp: Uint8Array | null = null;
  private share0 = 0;
  private share1 = 0;
  private r = 0;
  private g = 0;
  private b = 0;

  constructor({ data, width, height }: ImageData) {
    this.data = data;
    this.width = width;
    this.height = height;
  }

  setPlain([r, g, b]: readonly [number, number, number]): void {
    this.ramp = null;
    this.r = r;
    this.g = g;
    this.b = b;
  }

  /** Colours the piece by the ramp from `share0` to `share1`, or by one colour if they are close. */
  setRamp(ramp: Uint8Array, share0: number, share1: number): void {
    if (Math.abs(share1 - share0) * RAMP_SIZE > 1) {
      this.ramp = ramp;
      this.share0 = share0;
      this.share1 = share1;
    } else {
      this.ramp = null;
      this.pick(ramp, (share0 + share1) / 2);
    }
  }

  /** From (ax, ay) to (bx, by), device px. */
  draw(ax: number, ay: number, bx: number, by: number): void {
    const reach = this.reach;
    const far = reach + 0.5;
    const top = Math.max(0, Math.ceil(Math.min(ay, by) - far - 0.5));
    const bottom = Math.min(this.height - 1, Math.floor(Math.max(ay, by) + far - 0.5));
    const left = Math.max(0, Math.ceil(Math.min(ax, bx) - far - 0.5));
    const right = Math.min(this.width - 1, Math.floor(Math.max(ax, bx) + far - 0.5));
    if (top > bottom || left > right) return;
    const length = Math.sqrt((bx - ax) * (bx - ax) + (by - ay) * (by - ay));
    const ux = length > 1e-4 ? (bx - ax) / length : 1;
    const uy = length > 1e-4 ? (by - ay) / length : 0;
    const far2 = far * far;
    const near = reach - 0.5;
    const near2 = near > 0 ? near * near : -1;
    // Max. half width of the line within a row of pixels.
    const half = Math.abs(uy) > 0.05 ? far / Math.abs(uy) : Infinity;
    const first = this.isFlush ? 0 : -Infinity;
    const last = length + this.beyondPx;
    for (let y = top; y <= bottom; y++) {
      const dy = y + 0.5 - ay;
      let from = left;
      let to = right;
      if (half < to - from) {
        const middle = ax + (dy * ux) / uy - 0.5;
        from = Math.max(from, Math.ceil(middle - half));
        to = Math.min(to, Math.floor(middle + half));
      }
      for (let x = from; x <= to; x++) {
        const dx = x + 0.5 - ax;
        const along = dx * ux + dy * uy;
        if (along < first || along > last) continue;
        const beyond = along < 0 ? along : along > length ? along - length : 0;
        const side = dy * ux - dx * uy;
        const d2 = beyond * beyond + side * side;
        if (d2 >= far2) continue;
        if (this.ramp) this.pickAlong(this.ramp, length > 1e-4 ? along / length : 0.5);
        this.blend((y * this.width + x) * 4, d2 <= near2 ? 1 : Math.min(1, far - Math.sqrt(d2)));
      }
    }
  }

  private pickAlong(ramp: Uint8Array, share: number): void {
    this.pick(ramp, this.share0 + (this.share1 - this.share0) * share);
  }

  private pick(ramp: Uint8Array, share: number): void {
    const at = 4 * Math.round(Math.min(1, Math.max(0, share)) * (RAMP_SIZE - 1));
    this.r = ramp[at];
    this.g = ramp[at + 1];
    this.b = ramp[at + 2];
  }

  private blend(at: number, cover: number): void {
    const data = this.data;
    const a = cover * this.alpha;
    const rest = 1 - a;
    data[at] = this.r * a + data[at] * rest;
    data[at + 1] = this.g * a + data[at + 1] * rest;
    data[at + 2] = this.b * a + data[at + 2] * rest;
    data[at + 3] = 255 * a + data[at + 3] * rest;
  }
}

/** Converts premultiplied pixels to plain ones, which a canvas needs. */
const unmultiply = (data: Uint8ClampedArray): void => {
  for (let at = 0; at < data.length; at += 4) {
    const a = data[at + 3];
    if (a === 0 || a === 255) continue;
    const f = 255 / a;
    data[at] = data[at] * f;
    data[at + 1] = data[at + 1] * f;
    data[at + 2] = data[at + 2] * f;
  }
};
