/**
 * The preview's four stacked canvases (desk, strokes, the moving pen, rulers), and their view.
 *
 * The strokes are drawn elsewhere. Until they are drawn for a new view, the last picture is moved and scaled, so that
 * the paper follows the finger even if the drawing is large.
 */
import { compose, inverse, isSameJson, type Box } from "../../src/internal.js";
import {
  beginCanvas,
  deskColors,
  drawBackdrop,
  roomForHomePx,
  type Desk,
  type DeskColors,
} from "./backdrop.js";
import { markMoment } from "../worker/moments.js";
import { drawRulers, RULER_PX } from "./overlay.js";
import type { PenPlace } from "./pen/pen-glide.js";
import { PenLayer, type FreshInk } from "./pen/pen-layer.js";
import { LAYER_SHORT, PIECE_SHORTS } from "../scene/pieces.js";
import { piecesBefore } from "../scene/scene.js";
import type { Frame, Picture } from "../scene/renderer.js";
import { Strokes } from "./strokes.js";
import { fitView, screenMap, zoomAt, type Size, type View } from "../scene/view.js";

interface StageCanvases {
  readonly box: HTMLElement;
  readonly desk: HTMLCanvasElement;
  readonly strokes: HTMLCanvasElement;
  readonly pen: HTMLCanvasElement;
  readonly overlay: HTMLCanvasElement;
}

/** What is kept free above the paper for the words there, and below it for the controls, px. */
export interface KeptFree {
  readonly abovePx: number;
  readonly belowPx: number;
}

/** Paints over the strokes. */
export type OverlayPainter = (context: CanvasRenderingContext2D, view: View) => void;

/** The plotter's pen, or that of a simulated plot. */
export interface ShownPen {
  at(nowMs: number): PenPlace | null;
  /** Colours of the layers' pens. */
  readonly colors: readonly string[];
  /** It plots these strokes: they appear under its nib. */
  readonly isDrawing: boolean;
}

export type FrameLook = Omit<Frame, "view" | "width" | "height" | "ratio" | "ghostColor">;

/** Desk around the paper; less on a low screen, as a share of its height. */
const INSET_PX = 26;
const INSET_SHARE = 0.06;
/** On a low screen, what lies under the paper may lie over it: the share of the height that is kept free for it. */
const MOST_BELOW = 0.24;
const MAX_RATIO = 2;
/** The strokes are drawn again when the pen has drawn for so long, s of the plan: until then its ink is on the pen's canvas. */
const FRESH_S = 1.5;

export class Stage {
  private readonly observer: ResizeObserver;
  private readonly strokes: Strokes;
  private scene: Picture | null = null;
  private shownDesk: Desk;
  private readonly penLayer: PenLayer;
  private pen: ShownPen | null = null;
  private isPenStale = true;
  private paint: OverlayPainter | null = null;
  private rulerSpan: Box | null = null;
  private colors: DeskColors;
  private cssSize: Size = { width: 0, height: 0 };
  private currentView: View = { scale: 1, offsetX: 0, offsetY: 0 };
  /** The frame that the strokes canvas shows. */
  private drawn: Frame | null = null;
  /** Until the user pans or zooms, the whole paper stays visible. */
  private isFitted = true;
  private areStrokesStale = true;
  /** The scene is not visible yet. */
  private isSceneNew = true;
  /** The scene of each requested frame. */
  private readonly scenes = new WeakMap<Frame, Picture | null>();
  /** The 2D canvases are drawn only when something on them has changed. */
  private areSheetsStale = true;
  private request = 0;

  /** `onFault` is called if the strokes can't be drawn. */
  constructor(
    private readonly canvases: StageCanvases,
    desk: Desk,
    private look: FrameLook,
    private readonly keptFree: KeptFree,
    onFault: () => void,
  ) {
    this.shownDesk = desk;
    this.penLayer = new PenLayer(canvases.pen);
    this.colors = deskColors(canvases.box);
    const worker = new Worker(new URL("../worker/draw.worker.ts", import.meta.url), { type: "module" });
    const shown = canvases.strokes.getContext("bitmaprenderer");
    this.strokes = new Strokes(worker, {
      put: (bitmap) => shown?.transferFromImageBitmap(bitmap),
      onShown: (frame, isDone) => this.onShown(frame, isDone),
      onFault,
    });
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(canvases.box);
    this.resize();
    // The numbers of the rulers are in the page's font.
    void document.fonts.ready.then(() => this.refresh(false));
  }

  get view(): View {
    return this.currentView;
  }

  /** The preview's size, CSS px. */
  get size(): Size {
    return this.cssSize;
  }

  setView(view: View): void {
    this.currentView = view;
    this.isFitted = false;
    this.refresh(true);
  }

  fit(): void {
    this.isFitted = true;
    this.fitNow();
    this.refresh(true);
  }

  zoomBy(factor: number): void {
    this.setView(zoomAt(this.currentView, factor, this.cssSize.width / 2, this.cssSize.height / 2));
  }

  /** `copy` is passed to the code that draws, which may transfer it. */
  setScene(scene: Picture | null, copy: Picture | null): void {
    if (scene === this.scene) return;
    this.scene = scene;
    this.isSceneNew = true;
    this.strokes.setScene(scene, copy);
    this.refresh(true);
  }

  setLook(look: FrameLook): void {
    // While another drawing is plotted, the state changes several times a second, and these strokes do not.
    if (isSameJson(look, this.look) || this.isFresh(look)) return;
    this.look = look;
    this.refresh(true);
  }

  setDesk(desk: Desk): void {
    const { paperMm, turn } = this.shownDesk;
    const isOther = !isSameJson(desk.paperMm, paperMm) || desk.turn !== turn;
    this.shownDesk = desk;
    if (isOther) this.fit();
    else this.refresh(false);
  }

  setPen(pen: ShownPen | null): void {
    this.pen = pen;
    this.isPenStale = true;
    this.schedule();
  }

  get desk(): Desk {
    return this.shownDesk;
  }

  /** Sets what is painted over the strokes in every frame (highlights, handles), and the marked part of the rulers. */
  setPainter(paint: OverlayPainter, rulerSpan: Box | null): void {
    this.paint = paint;
    this.rulerSpan = rulerSpan;
    this.refresh(false);
  }

  /** Reads the colours again, after the theme has changed. */
  recolor(): void {
    this.colors = deskColors(this.canvases.box);
    this.refresh(true);
  }

  close(): void {
    cancelAnimationFrame(this.request);
    this.observer.disconnect();
    this.strokes.close();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvases.box;
    this.cssSize = { width, height };
    if (this.isFitted) this.fitNow();
    this.refresh(true);
    // Draws now, so that the browser does not show the new size with an old picture for one frame.
    cancelAnimationFrame(this.request);
    this.frame();
  }

  private fitNow(): void {
    const { abovePx, belowPx } = this.keptFree;
    const { height } = this.cssSize;
    const insetPx = Math.min(INSET_PX, INSET_SHARE * height);
    const insets = {
      top: RULER_PX + Math.max(insetPx, abovePx) + roomForHomePx(this.shownDesk.turn),
      left: RULER_PX + insetPx,
      right: insetPx,
      bottom: insetPx + Math.min(belowPx, MOST_BELOW * height),
    };
    this.currentView = fitView(this.shownDesk.paperMm, this.cssSize, insets, this.shownDesk.turn);
  }

  private refresh(areStrokesStale: boolean): void {
    this.areStrokesStale ||= areStrokesStale;
    if (areStrokesStale) this.canvases.strokes.ariaBusy = "true";
    this.areSheetsStale = this.isPenStale = true;
    this.schedule();
  }

  /** Only the time has changed, by so little that the pen's canvas shows what was drawn since. */
  private isFresh(look: FrameLook): boolean {
    const { untilS } = this.look;
    if (this.pen?.isDrawing !== true || untilS === null || look.untilS === null) return false;
    const freshS = look.untilS - untilS;
    return freshS >= 0 && freshS < FRESH_S && isSameJson({ ...look, untilS }, this.look);
  }

  private schedule(): void {
    if (this.request === 0) this.request = requestAnimationFrame(this.frame);
  }

  private readonly frame = (): void => {
    this.request = 0;
    if (this.cssSize.width === 0 || this.cssSize.height === 0) return;
    const ratio = Math.min(MAX_RATIO, window.devicePixelRatio || 1);
    if (this.areSheetsStale) this.drawSheets(ratio);
    if (this.areStrokesStale) this.askForStrokes(ratio);
    if (this.isPenStale) this.paintPen(ratio);
  };

  private paintPen(ratio: number): void {
    const { pen, currentView: view, cssSize } = this;
    const nowMs = performance.now();
    const place = pen?.at(nowMs) ?? null;
    const shown = pen && place && { place, color: this.penColor(pen, place) };
    const isLifting = this.penLayer.paint(shown, place && this.freshInk(place), view, cssSize, ratio, nowMs);
    this.isPenStale = isLifting || place?.isMoving === true;
    if (this.isPenStale) this.schedule();
  }

  /** The colour of the pen that draws, or that is on its way to what it draws next. */
  private penColor({ colors }: ShownPen, { planS, penDown }: PenPlace): string {
    const draw = this.scene?.draw;
    if (planS === null || !draw || draw.count === 0) return this.colors.accent;
    const next = piecesBefore(draw, planS) - (penDown ? 1 : 0);
    const piece = Math.min(draw.count - 1, Math.max(0, next));
    const layer = new Uint16Array(draw.bytes)[piece * PIECE_SHORTS + LAYER_SHORT];
    return colors[layer] ?? this.colors.accent;
  }

  private freshInk({ planS }: PenPlace): FreshInk | null {
    const { scene, drawn } = this;
    if (this.pen?.isDrawing !== true || !scene || !drawn || drawn.untilS === null || planS === null)
      return null;
    if (this.scenes.get(drawn) !== scene || planS <= drawn.untilS) return null;
    const frame = { ...drawn, view: this.currentView };
    return { pieces: scene.draw, totalS: scene.totalS, fromS: drawn.untilS, toS: planS, frame };
  }

  private drawSheets(ratio: number): void {
    const { desk, overlay } = this.canvases;
    this.areSheetsStale = false;
    const deskContext = beginCanvas(desk, this.cssSize, ratio);
    if (deskContext)
      drawBackdrop(deskContext, this.currentView, this.shownDesk, this.colors, this.cssSize.height);
    const overlayContext = beginCanvas(overlay, this.cssSize, ratio);
    if (overlayContext) {
      this.paint?.(overlayContext, this.currentView);
      drawRulers(
        overlayContext,
        this.currentView,
        this.cssSize,
        this.colors,
        this.shownDesk.unitMm,
        this.rulerSpan,
      );
    }
  }

  private askForStrokes(ratio: number): void {
    this.areStrokesStale = false;
    const { ghost: ghostColor } = this.colors;
    const frame: Frame = { ...this.look, ...this.cssSize, ratio, ghostColor, view: this.currentView };
    this.scenes.set(frame, this.scene);
    this.strokes.show(frame);
    this.moveStrokes();
  }

  private onShown(frame: Frame, isDone: boolean): void {
    const { strokes } = this.canvases;
    // The picture keeps the size that it was drawn for, because the box may have changed since.
    strokes.style.width = `${frame.width}px`;
    strokes.style.height = `${frame.height}px`;
    this.drawn = frame;
    this.moveStrokes();
    this.isPenStale = true;
    this.schedule();
    if (isDone && !this.areStrokesStale) strokes.ariaBusy = "false";
    if (!this.scene || this.scenes.get(frame) !== this.scene) return;
    if (this.isSceneNew) markMoment("plotwright-picture");
    if (isDone) markMoment("plotwright-whole-picture");
    this.isSceneNew = false;
  }

  private moveStrokes(): void {
    const { style } = this.canvases.strokes;
    const drawn = this.drawn?.view ?? this.currentView;
    style.transform = drawn === this.currentView ? "" : transformBetween(drawn, this.currentView);
  }
}

/** The CSS transform that shows a picture drawn for `from` in the view `to`. */
const transformBetween = (from: View, to: View): string => {
  const { a, b, c, d, e, f } = compose(screenMap(to), inverse(screenMap(from)));
  return `matrix(${[a, b, c, d, e, f].map((value) => value.toFixed(12)).join()})`;
};
