/** The desk under the strokes: paper with its shadow, a faint grid, the margins, the machine's reach. */
import type { Box, FourMargins } from "../../src/internal.js";
import { previewText } from "./text.js";
import { rulerStep, screenBox, screenPoint, turnOf, type Size, type View } from "../scene/view.js";

/** The smallest size of the page's text, in its font. */
export const DESK_FONT = "11px Inter Variable, Helvetica, Arial, sans-serif";

/** The style sheet has each as `--desk-NAME`. */
const COLOR_NAMES = [
  "paper",
  "ghost",
  "shadow",
  "grid",
  "grid-strong",
  "margin",
  "ruler",
  "ruler-text",
  "ruler-line",
  "accent",
] as const;
export type DeskColors = Readonly<Record<(typeof COLOR_NAMES)[number], string>>;

export interface Desk {
  readonly paperMm: Size;
  readonly margins: FourMargins;
  /** The machine's reach from the paper's corner, and its label; null: unknown. */
  readonly reach: (Size & { readonly label: string }) | null;
  /** The unit of the grid and the rulers. */
  readonly unitMm: number;
  /** How far it is turned clockwise, in quarters. */
  readonly turn: number;
}

const boxOfSize = ({ width, height }: Size): Box => ({ x0: 0, y0: 0, x1: width, y1: height });
const sidesOf = ({ x0, y0, x1, y1 }: Box): [number, number, number, number] => [x0, y0, x1 - x0, y1 - y0];

/** The colours of the theme in use. */
export const deskColors = (element: Element): DeskColors => {
  const style = getComputedStyle(element);
  const colors = COLOR_NAMES.map((name) => [name, style.getPropertyValue(`--desk-${name}`).trim()]);
  return Object.fromEntries(colors) as DeskColors;
};

/** Resizes a canvas to its box and returns its cleared context, in CSS px. */
export const beginCanvas = (
  canvas: HTMLCanvasElement,
  size: Size,
  ratio: number,
): CanvasRenderingContext2D | null => {
  const width = Math.max(1, Math.round(size.width * ratio));
  const height = Math.max(1, Math.round(size.height * ratio));
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const context = canvas.getContext("2d");
  context?.setTransform(ratio, 0, 0, ratio, 0, 0);
  context?.clearRect(0, 0, size.width, size.height);
  return context;
};

export const drawBackdrop = (
  context: CanvasRenderingContext2D,
  view: View,
  desk: Desk,
  colors: DeskColors,
  heightPx: number,
): void => {
  const sheet = sidesOf(screenBox(view, boxOfSize(desk.paperMm)));
  context.save();
  context.fillStyle = colors.paper;
  // Two shadows: a narrow one at the edge of the sheet, and a wide one from the light of the room.
  for (const [blur, down] of [
    [3, 1],
    [34, 14],
  ] as const) {
    context.shadowColor = colors.shadow;
    context.shadowBlur = blur;
    context.shadowOffsetY = down;
    context.fillRect(...sheet);
  }
  context.restore();
  drawGrid(context, view, desk, colors);
  drawMargin(context, view, desk, colors);
  drawReach(context, view, desk, colors, heightPx);
  drawHome(context, view, colors);
};

const drawGrid = (
  context: CanvasRenderingContext2D,
  view: View,
  { paperMm: paper, unitMm }: Desk,
  colors: DeskColors,
): void => {
  const step = unitMm * rulerStep(view.scale * unitMm, 9);
  const strong = unitMm * rulerStep(view.scale * unitMm, 45);
  for (const [spacing, color] of [
    [step, colors.grid],
    [strong, colors["grid-strong"]],
  ] as const) {
    context.strokeStyle = color;
    context.lineWidth = 1;
    context.beginPath();
    for (let mm = spacing; mm < paper.width; mm += spacing)
      addCrispLine(context, screenPoint(view, mm, 0), screenPoint(view, mm, paper.height));
    for (let mm = spacing; mm < paper.height; mm += spacing)
      addCrispLine(context, screenPoint(view, 0, mm), screenPoint(view, paper.width, mm));
    context.stroke();
  }
};

type Px = readonly [x: number, y: number];

/** Adds a level or upright line that fills whole pixels. */
export const addCrispLine = (context: CanvasRenderingContext2D, [ax, ay]: Px, [bx, by]: Px): void => {
  const isUpright = Math.abs(bx - ax) < Math.abs(by - ay);
  const px = Math.round(isUpright ? ax : ay) + 0.5;
  context.moveTo(isUpright ? px : ax, isUpright ? ay : px);
  context.lineTo(isUpright ? px : bx, isUpright ? by : px);
};

const drawMargin = (context: CanvasRenderingContext2D, view: View, desk: Desk, colors: DeskColors): void => {
  const { topMm, rightMm, bottomMm, leftMm } = desk.margins;
  const inside = {
    x0: leftMm,
    y0: topMm,
    x1: desk.paperMm.width - rightMm,
    y1: desk.paperMm.height - bottomMm,
  };
  if (topMm + rightMm + bottomMm + leftMm <= 0 || inside.x1 <= inside.x0 || inside.y1 <= inside.y0) return;
  context.strokeStyle = colors.margin;
  context.lineWidth = 1;
  context.setLineDash([4, 4]);
  context.strokeRect(...sidesOf(screenBox(view, inside)));
  context.setLineDash([]);
};

/** A smaller sheet than this has no room for words that only confirm. */
const MIN_LABEL_PX = 340;
/** From the line to the words below it, or above it if there is no room below. */
const REACH_GAP_PX = 5;
/** Of the words, above and below their base line. */
const ASCENT_PX = 9;
const DESCENT_PX = 4;

/** Faint if the machine reaches all of the paper. Otherwise the part that it can't reach is shaded. */
const drawReach = (
  context: CanvasRenderingContext2D,
  view: View,
  desk: Desk,
  colors: DeskColors,
  heightPx: number,
): void => {
  const { reach, paperMm } = desk;
  if (!reach) return;
  const box = screenBox(view, boxOfSize(reach));
  const isShort = reach.width < paperMm.width || reach.height < paperMm.height;
  context.save();
  context.strokeStyle = context.fillStyle = isShort ? colors.accent : colors["ruler-text"];
  if (isShort) shadeBeyond(context, view, desk.paperMm, reach);
  context.globalAlpha = isShort ? 1 : 0.5;
  context.lineWidth = isShort ? 1.5 : 1;
  context.setLineDash([2, 5]);
  context.strokeRect(...sidesOf(box));
  context.setLineDash([]);
  context.globalAlpha = isShort ? 1 : 0.8;
  const paper = screenBox(view, boxOfSize(paperMm));
  // On a small picture of the sheet the words would hide more than they say.
  if (Math.min(box.x1, paper.x1) - Math.max(box.x0, paper.x0) < MIN_LABEL_PX) return context.restore();
  context.font = DESK_FONT;
  // Not beyond the paper's sides, so that it is visible; the lower right corner may be home.
  const isLeft = view.turn === 2;
  context.textAlign = isLeft ? "left" : "right";
  const x = isLeft ? Math.max(box.x0, paper.x0) : Math.min(box.x1, paper.x1);
  const below = box.y1 + REACH_GAP_PX + ASCENT_PX;
  const hasRoom = below + DESCENT_PX <= heightPx;
  context.fillText(reach.label, x, hasRoom ? below : box.y1 - REACH_GAP_PX);
  context.restore();
};

const shadeBeyond = (context: CanvasRenderingContext2D, view: View, paper: Size, reach: Size): void => {
  context.globalAlpha = 0.08;
  const whole = boxOfSize(paper);
  const shade = (box: Box): void => context.fillRect(...sidesOf(screenBox(view, box)));
  if (paper.width > reach.width) shade({ ...whole, x0: reach.width });
  if (paper.height > reach.height)
    shade({ ...whole, y0: reach.height, x1: Math.min(paper.width, reach.width) });
};

const HOME_PX = 9;
/** On a small picture of the sheet. */
const HOME_MM = 10;
/** From the corner to the word. */
const HOME_GAP_PX = 5;
/** The word is above the sheet on a desk that is turned once. */
export const roomForHomePx = (turn: number): number => (turn === 1 ? 16 : 0);

/** Marks the paper's corner at home, with the word where the desk is turned. */
const drawHome = (context: CanvasRenderingContext2D, view: View, colors: DeskColors): void => {
  const [cos, sin] = turnOf(view);
  const legPx = Math.min(HOME_PX, HOME_MM * view.scale);
  // Along the paper's edges from its corner.
  const at = (along: number, down: number): Px => [
    view.offsetX + cos * along - sin * down,
    view.offsetY + sin * along + cos * down,
  ];
  context.fillStyle = colors["ruler-text"];
  context.beginPath();
  context.moveTo(...at(0, 0));
  context.lineTo(...at(legPx, 0));
  context.lineTo(...at(0, legPx));
  context.fill();
  const { turn = 0, offsetX, offsetY } = view;
  if (turn === 0) return;
  context.font = DESK_FONT;
  // Beside the sheet, which lies to the left of a corner on the right, and above a lower one.
  context.textAlign = turn === 3 ? "left" : "right";
  context.fillText(previewText.home, offsetX, turn === 1 ? offsetY - HOME_GAP_PX : offsetY + HOME_GAP_PX + 9);
};
