/**
 * The preview's three stacked canvases (desk, strokes, rulers with the pen), and their view.
 *
 * The strokes are drawn elsewhere. Until they are drawn for a new view, the last picture is moved and scaled, so that
 * the paper follows the finger even if the drawing is large.
 */
import { isSameJson, type Box } from "../../src/internal.js";
import { beginCanvas, deskColors, drawBackdrop, type Desk, type DeskColors } from "./backdrop.js";
import { markMoment } from "../worker/moments.js";
import { drawMarker, drawRulers, RULER_PX, type Marker } from "./overlay.js";
import type { Frame, Picture } from "../scene/renderer.js";
import { Strokes } from "./strokes.js";
import { fitView, zoomAt, type Size, type View } from "../scene/view.js";

interface StageCanvases {
  readonly box: HTMLElement;
  readonly desk: HTMLCanvasElement;
  readonly strokes: HTMLCanvasElement;
  readonly overlay: HTMLCanvasElement;
}

/** Paints over the strokes. */
export type Paint = (context: CanvasRenderingContext2D, view: View) => void;

export type FrameLook = Omit<Frame, "view" | "width" | "height" | "ratio">;

const INSET_PX = 26;
/** On a low screen, what lies under the paper may lie over it: the share of the height that is kept free for it. */
const MOST_BELOW = 0.24;
const MAX_RATIO = 2;

export class Stage {
  readonly #canvases: StageCanvases;
  readonly #belowPx: number;
  readonly #observer: ResizeObserver;
  readonly #strokes: Strokes;
  #scene: Picture | null = null;
  #look: FrameLook;
  #desk: Desk;
  #marker: Marker | null = null;
  #paint: Paint | null = null;
  #rulerSpan: Box | null = null;
  #colors: DeskColors;
  #size: Size = { width: 0, height: 0 };
  #view: View = { scale: 1, offsetX: 0, offsetY: 0 };
  /** The view that the strokes canvas shows. */
  #drawnView: View | null = null;
  /** Until the user pans or zooms, the whole paper stays visible. */
  #isFitted = true;
  #areStrokesStale = true;
  /** The scene is not visible yet. */
  #isSceneNew = true;
  /** The scene of each requested frame. */
  readonly #scenes = new WeakMap<Frame, Picture | null>();
  /** The 2D canvases are drawn only when something on them has changed. */
  #areSheetsStale = true;
  #request = 0;

  /** `onFault` is called if the strokes can't be drawn. */
  constructor(canvases: StageCanvases, desk: Desk, look: FrameLook, belowPx: number, onFault: () => void) {
    this.#canvases = canvases;
    this.#belowPx = belowPx;
    this.#desk = desk;
    this.#look = look;
    this.#colors = deskColors(canvases.box);
    const worker = new Worker(new URL("../worker/draw.worker.ts", import.meta.url), { type: "module" });
    const shown = canvases.strokes.getContext("bitmaprenderer");
    this.#strokes = new Strokes(worker, {
      put: (bitmap) => shown?.transferFromImageBitmap(bitmap),
      onShown: (frame, isDone) => this.#onShown(frame, isDone),
      onFault,
    });
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(canvases.box);
    this.#resize();
  }

  get view(): View {
    return this.#view;
  }

  /** The preview's size, CSS px. */
  get size(): Size {
    return this.#size;
  }

  setView(view: View): void {
    this.#view = view;
    this.#isFitted = false;
    this.#refresh(true);
  }

  fit(): void {
    this.#isFitted = true;
    this.#fitNow();
    this.#refresh(true);
  }

  zoomBy(factor: number): void {
    this.setView(zoomAt(this.#view, factor, this.#size.width / 2, this.#size.height / 2));
  }

  /** `copy` is passed to the code that draws, which may transfer it. */
  setScene(scene: Picture | null, copy: Picture | null): void {
    if (scene === this.#scene) return;
    this.#scene = scene;
    this.#isSceneNew = true;
    this.#strokes.setScene(scene, copy);
    this.#refresh(true);
  }

  setLook(look: FrameLook): void {
    // While another drawing is plotted, the state changes several times a second, and these strokes do not.
    if (isSameJson(look, this.#look)) return;
    this.#look = look;
    this.#refresh(true);
  }

  setDesk(desk: Desk): void {
    const { width, height } = this.#desk.paperMm;
    const isOther = desk.paperMm.width !== width || desk.paperMm.height !== height;
    this.#desk = desk;
    if (isOther) this.fit();
    else this.#refresh(false);
  }

  setMarker(marker: Marker | null): void {
    this.#marker = marker;
    this.#refresh(false);
  }

  get desk(): Desk {
    return this.#desk;
  }

  /** Sets what is painted over the strokes in every frame (highlights, handles), and the marked part of the rulers. */
  setPainter(paint: Paint, rulerSpan: Box | null): void {
    this.#paint = paint;
    this.#rulerSpan = rulerSpan;
    this.#refresh(false);
  }

  /** Reads the colours again, after the theme has changed. */
  recolor(): void {
    this.#colors = deskColors(this.#canvases.box);
    this.#refresh(false);
  }

  close(): void {
    cancelAnimationFrame(this.#request);
    this.#observer.disconnect();
    this.#strokes.close();
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.#canvases.box;
    this.#size = { width, height };
    if (this.#isFitted) this.#fitNow();
    this.#refresh(true);
    // Draws now, so that the browser does not show the new size with an old picture for one frame.
    cancelAnimationFrame(this.#request);
    this.#frame();
  }

  #fitNow(): void {
    const insets = {
      top: RULER_PX + INSET_PX,
      left: RULER_PX + INSET_PX,
      right: INSET_PX,
      bottom: INSET_PX + Math.min(this.#belowPx, MOST_BELOW * this.#size.height),
    };
    this.#view = fitView(this.#desk.paperMm, this.#size, insets);
  }

  #refresh(areStrokesStale: boolean): void {
    this.#areStrokesStale ||= areStrokesStale;
    if (areStrokesStale) this.#canvases.strokes.ariaBusy = "true";
    this.#areSheetsStale = true;
    this.#schedule();
  }

  #schedule(): void {
    if (this.#request === 0) this.#request = requestAnimationFrame(this.#frame);
  }

  readonly #frame = (): void => {
    this.#request = 0;
    if (this.#size.width === 0 || this.#size.height === 0) return;
    const ratio = Math.min(MAX_RATIO, window.devicePixelRatio || 1);
    if (this.#areSheetsStale) this.#drawSheets(ratio);
    if (this.#areStrokesStale) this.#askForStrokes(ratio);
  };

  #drawSheets(ratio: number): void {
    const { desk, overlay } = this.#canvases;
    this.#areSheetsStale = false;
    const deskContext = beginCanvas(desk, this.#size, ratio);
    if (deskContext) drawBackdrop(deskContext, this.#view, this.#desk, this.#colors);
    const overlayContext = beginCanvas(overlay, this.#size, ratio);
    if (overlayContext) {
      this.#paint?.(overlayContext, this.#view);
      if (this.#marker) drawMarker(overlayContext, this.#view, this.#marker, this.#colors);
      drawRulers(overlayContext, this.#view, this.#size, this.#colors, this.#desk.unitMm, this.#rulerSpan);
    }
  }

  #askForStrokes(ratio: number): void {
    this.#areStrokesStale = false;
    const frame: Frame = { ...this.#look, ...this.#size, ratio, view: this.#view };
    this.#scenes.set(frame, this.#scene);
    this.#strokes.show(frame);
    this.#moveStrokes();
  }

  #onShown(frame: Frame, isDone: boolean): void {
    const { strokes } = this.#canvases;
    // The picture keeps the size that it was drawn for, because the box may have changed since.
    strokes.style.width = `${frame.width}px`;
    strokes.style.height = `${frame.height}px`;
    this.#drawnView = frame.view;
    this.#moveStrokes();
    if (isDone && !this.#areStrokesStale) strokes.ariaBusy = "false";
    if (!this.#scene || this.#scenes.get(frame) !== this.#scene) return;
    if (this.#isSceneNew) markMoment("plotwright-picture");
    if (isDone) markMoment("plotwright-whole-picture");
    this.#isSceneNew = false;
  }

  #moveStrokes(): void {
    const { style } = this.#canvases.strokes;
    const drawn = this.#drawnView ?? this.#view;
    style.transform = drawn === this.#view ? "" : transformBetween(drawn, this.#view);
  }
}

/** The CSS transform that shows a picture drawn for `from` in the view `to`. */
const transformBetween = (from: View, to: View): string => {
  const f = to.scale / from.scale;
  return `translate(${to.offsetX - from.offsetX * f}px, ${to.offsetY - from.offsetY * f}px) scale(${f})`;
};
