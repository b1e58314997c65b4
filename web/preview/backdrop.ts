/** The desk under the strokes: paper with its shadow, a quiet grid, the margins, the machine's reach. */
import type { FourMargins } from "../../src/internal.js";
import { rulerStepMm, type Size, type View } from "../scene/view.js";

export interface DeskColors {
  readonly paper: string;
  readonly shadow: string;
  readonly grid: string;
  readonly gridStrong: string;
  readonly margin: string;
  readonly ruler: string;
  readonly rulerText: string;
  readonly rulerLine: string;
  readonly accent: string;
  readonly halo: string;
}

export interface Desk {
  readonly paperMm: Size;
  readonly margins: FourMargins;
  /** How far the machine reaches from the paper's corner; null where it is not known. */
  readonly reachMm: Size | null;
}

/** The colours of the theme in use, from the style sheet's custom properties. */
export const deskColors = (element: Element): DeskColors => {
  const style = getComputedStyle(element);
  const value = (name: string): string => style.getPropertyValue(`--desk-${name}`).trim();
  return {
    paper: value("paper"),
    shadow: value("shadow"),
    grid: value("grid"),
    gridStrong: value("grid-strong"),
    margin: value("margin"),
    ruler: value("ruler"),
    rulerText: value("ruler-text"),
    rulerLine: value("ruler-line"),
    accent: value("accent"),
    halo: value("halo"),
  };
};

/** Sizes a canvas to its box and gives it cleared, in CSS px. */
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
  // Two shadows, as a sheet on a desk has: a tight one where it lies, a wide one from the room's light.
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
  drawGrid(context, view, desk.paperMm, colors);
  drawMargin(context, view, desk, colors);
  drawReach(context, view, desk, colors);
};

const drawGrid = (context: CanvasRenderingContext2D, view: View, paper: Size, colors: DeskColors): void => {
  const step = rulerStepMm(view.scale, 9);
  const strong = rulerStepMm(view.scale, 45);
  for (const [spacing, color] of [
    [step, colors.grid],
    [strong, colors.gridStrong],
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

const drawReach = (context: CanvasRenderingContext2D, view: View, desk: Desk, colors: DeskColors): void => {
  const { reachMm, paperMm } = desk;
  if (!reachMm || (reachMm.width >= paperMm.width && reachMm.height >= paperMm.height)) return;
  context.strokeStyle = colors.accent;
  context.lineWidth = 1.5;
  context.setLineDash([2, 5]);
  context.strokeRect(view.offsetX, view.offsetY, reachMm.width * view.scale, reachMm.height * view.scale);
  context.setLineDash([]);
};
