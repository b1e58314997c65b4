/** The desk under the strokes: paper with its shadow, a faint grid, the margins, the machine's reach. */
import type { FourMargins } from "../../src/internal.js";
import { rulerStep, type Size, type View } from "../scene/view.js";

/** The style sheet has each as `--desk-NAME`. */
const COLOR_NAMES = [
  "paper",
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
}

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
): void => {
  const x = view.offsetX;
  const y = view.offsetY;
  const width = desk.paperMm.width * view.scale;
  const height = desk.paperMm.height * view.scale;
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
    context.fillRect(x, y, width, height);
  }
  context.restore();
  drawGrid(context, view, desk, colors);
  drawMargin(context, view, desk, colors);
  drawReach(context, view, desk, colors);
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
    for (let mm = spacing; mm < paper.width; mm += spacing) {
      const px = Math.round(view.offsetX + mm * view.scale) + 0.5;
      context.moveTo(px, view.offsetY);
      context.lineTo(px, view.offsetY + paper.height * view.scale);
    }
    for (let mm = spacing; mm < paper.height; mm += spacing) {
      const px = Math.round(view.offsetY + mm * view.scale) + 0.5;
      context.moveTo(view.offsetX, px);
      context.lineTo(view.offsetX + paper.width * view.scale, px);
    }
    context.stroke();
  }
};

const drawMargin = (context: CanvasRenderingContext2D, view: View, desk: Desk, colors: DeskColors): void => {
  const { topMm, rightMm, bottomMm, leftMm } = desk.margins;
  const width = (desk.paperMm.width - leftMm - rightMm) * view.scale;
  const height = (desk.paperMm.height - topMm - bottomMm) * view.scale;
  if (topMm + rightMm + bottomMm + leftMm <= 0 || width <= 0 || height <= 0) return;
  context.strokeStyle = colors.margin;
  context.lineWidth = 1;
  context.setLineDash([4, 4]);
  context.strokeRect(view.offsetX + leftMm * view.scale, view.offsetY + topMm * view.scale, width, height);
  context.setLineDash([]);
};

const REACH_FONT = "11px Helvetica, Arial, sans-serif";
/** A smaller sheet than this has no room for words that only confirm. */
const MIN_LABEL_PX = 340;
/** From the line to the words above it. */
const REACH_GAP_PX = 5;

/** Faint if the machine reaches all of the paper. Otherwise the part that it can't reach is shaded. */
const drawReach = (context: CanvasRenderingContext2D, view: View, desk: Desk, colors: DeskColors): void => {
  const { reach, paperMm } = desk;
  if (!reach) return;
  const { offsetX, offsetY, scale } = view;
  const width = reach.width * scale;
  const height = reach.height * scale;
  const isShort = reach.width < paperMm.width || reach.height < paperMm.height;
  context.save();
  context.strokeStyle = context.fillStyle = isShort ? colors.accent : colors["ruler-text"];
  if (isShort) shadeBeyond(context, view, desk.paperMm, reach);
  context.globalAlpha = isShort ? 1 : 0.5;
  context.lineWidth = isShort ? 1.5 : 1;
  context.setLineDash([2, 5]);
  context.strokeRect(offsetX, offsetY, width, height);
  context.setLineDash([]);
  context.globalAlpha = isShort ? 1 : 0.8;
  if (!isShort && width < MIN_LABEL_PX) return context.restore();
  context.font = REACH_FONT;
  context.textAlign = "right";
  // Below the lower edge, and not beyond the paper's right edge, so that it is visible.
  context.fillText(
    reach.label,
    offsetX + Math.min(reach.width, paperMm.width) * scale,
    offsetY + height + REACH_GAP_PX + 9,
  );
  context.restore();
};

const shadeBeyond = (
  context: CanvasRenderingContext2D,
  { offsetX, offsetY, scale }: View,
  paper: Size,
  reach: Size,
): void => {
  context.globalAlpha = 0.08;
  const [right, below] = [paper.width - reach.width, paper.height - reach.height];
  if (right > 0) {
    context.fillRect(offsetX + reach.width * scale, offsetY, right * scale, paper.height * scale);
  }
  if (below > 0) {
    const width = Math.min(paper.width, reach.width);
    context.fillRect(offsetX, offsetY + reach.height * scale, width * scale, below * scale);
  }
};
