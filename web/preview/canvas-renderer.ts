/** Strokes by Canvas 2D, where there is no WebGL2: pieces gathered into a path for each of a few colours. */
import { rampColor } from "./color-map.js";
import {
  GHOST_COLOR,
  INK_COLOR,
  lineWidthPx,
  TRAVEL_COLOR,
  type Frame,
  type SceneRenderer,
} from "./renderer.js";
import {
  LAYER_SHORT,
  PIECE_FLOATS,
  PIECE_SHORTS,
  piecesBefore,
  SPEED_SHORT,
  type Pieces,
  type Scene,
} from "./scene.js";

const SHADES = 32;

export const createCanvasRenderer = (canvas: HTMLCanvasElement): SceneRenderer | null => {
  const context = canvas.getContext("2d");
  return context ? new CanvasRenderer(canvas, context) : null;
};

class CanvasRenderer implements SceneRenderer {
  readonly kind = "canvas";
  readonly #canvas: HTMLCanvasElement;
  readonly #context: CanvasRenderingContext2D;
  #scene: Scene | null = null;

  constructor(canvas: HTMLCanvasElement, context: CanvasRenderingContext2D) {
    this.#canvas = canvas;
    this.#context = context;
  }

  setScene(scene: Scene | null): void {
    this.#scene = scene;
  }

  draw(frame: Frame): boolean {
    const context = this.#context;
    this.#canvas.width = Math.max(1, Math.round(frame.width * frame.ratio));
    this.#canvas.height = Math.max(1, Math.round(frame.height * frame.ratio));
    if (!this.#scene) return true;
    context.scale(frame.ratio, frame.ratio);
    context.lineCap = "round";
    context.lineWidth = lineWidthPx(frame, frame.lineMm);
    const { draw, travel, totalS } = this.#scene;
    const done = frame.untilS === null ? draw.count : piecesBefore(draw, frame.untilS);
    strokeBuckets(context, frame, draw, done, draw.count, [GHOST_COLOR], () => 0);
    const { colors, bucketOf } = bucketsFor(frame, draw, totalS);
    strokeBuckets(context, frame, draw, 0, done, colors, bucketOf);
    if (frame.showTravel) {
      context.lineWidth = 0.9;
      context.globalAlpha = 0.6;
      const until = frame.untilS === null ? travel.count : piecesBefore(travel, frame.untilS);
      strokeBuckets(context, frame, travel, 0, until, [TRAVEL_COLOR], () => 0);
      context.globalAlpha = 1;
    }
    return true;
  }

  close(): void {
    this.#scene = null;
  }
}

/** The colours in use, and which of them piece i has. */
const bucketsFor = (
  frame: Frame,
  { bytes }: Pieces,
  totalS: number,
): { colors: readonly string[]; bucketOf: (i: number) => number } => {
  const shorts = new Uint16Array(bytes);
  const floats = new Float32Array(bytes);
  const ramp = Array.from({ length: SHADES }, (_, k) => rampColor(k / (SHADES - 1)));
  const shade = (share: number): number => Math.min(SHADES - 1, Math.round(share * (SHADES - 1)));
  switch (frame.colorBy) {
    case "speed":
      return {
        colors: ramp,
        bucketOf: (i) => {
          const at = i * PIECE_SHORTS + SPEED_SHORT;
          return shade((shorts[at]! + shorts[at + 1]!) / 2 / 65_535);
        },
      };
    case "order":
      return { colors: ramp, bucketOf: (i) => shade(floats[i * PIECE_FLOATS + 4]! / Math.max(1e-6, totalS)) };
    case "layer":
    case "pen":
      return { colors: frame.layerColors, bucketOf: (i) => shorts[i * PIECE_SHORTS + LAYER_SHORT]! };
    case "ink":
      return { colors: [INK_COLOR], bucketOf: () => 0 };
  }
};

const strokeBuckets = (
  context: CanvasRenderingContext2D,
  frame: Frame,
  { bytes }: Pieces,
  from: number,
  to: number,
  colors: readonly string[],
  bucketOf: (i: number) => number,
): void => {
  if (to <= from) return;
  const { view } = frame;
  const floats = new Float32Array(bytes);
  const paths = colors.map(() => new Path2D());
  for (let i = from; i < to; i++) {
    const path = paths[bucketOf(i)];
    const f = i * PIECE_FLOATS;
    path?.moveTo(floats[f]! * view.scale + view.offsetX, floats[f + 1]! * view.scale + view.offsetY);
    path?.lineTo(floats[f + 2]! * view.scale + view.offsetX, floats[f + 3]! * view.scale + view.offsetY);
  }
  const widthsMm = colors === frame.layerColors ? frame.layerWidthsMm : null;
  paths.forEach((path, k) => {
    context.strokeStyle = colors[k]!;
    if (widthsMm) context.lineWidth = lineWidthPx(frame, widthsMm[k] ?? frame.lineMm);
    context.stroke(path);
  });
};
